//! Sheets: everything in a plane.

use std::f32::consts::TAU;

use glam::Vec3;
use rand_pcg::Pcg64Mcg;

use super::shapes::{grid, grid_side, mapped, turned};
use super::{Family, family, sized};
use crate::Triangle;
use crate::testing::cube_point;

pub(super) const FAMILIES: &[Family] = &[
    family("sheet-x", "a grid in a plane of constant x", |_, count| {
        mapped(sheet(count), |p| Vec3::new(0.25, p.x, p.y))
    }),
    family("sheet-y", "a grid in a plane of constant y", |_, count| {
        mapped(sheet(count), |p| Vec3::new(p.x, -1.5, p.y))
    }),
    family("sheet-z", "a grid in a plane of constant z", |_, count| {
        sheet(count)
    }),
    family(
        "sheet-turned",
        "a grid in a plane turned by 45 degrees",
        |_, count| mapped(sheet(count), |p| turned() * p),
    ),
    family(
        "sheets-stacked",
        "parallel sheets, close together",
        |_, count| {
            let one = sheet((count / 8).max(2));
            (0..8)
                .flat_map(|level| mapped(one.clone(), move |p| p + Vec3::Z * level as f32 * 1e-3))
                .collect()
        },
    ),
    family(
        "sheet-random",
        "overlapping triangles in one plane",
        flat_soup,
    ),
    family("flat-x", "a scene without extent in x", |random, count| {
        mapped(flat_soup(random, count), |p| Vec3::new(0.0, p.x, p.y))
    }),
    sized(
        2000,
        family(
            "circle",
            "a triangulated circle in a coordinate plane",
            |_, count| circle(count),
        ),
    ),
    sized(
        2000,
        family(
            "circle-turned",
            "a triangulated circle, turned",
            |_, count| mapped(circle(count), |p| turned() * p),
        ),
    ),
];

fn sheet(count: usize) -> Vec<Triangle> {
    let side = grid_side(count);
    grid(side, side, |x, y| {
        Vec3::new(x as f32, y as f32, 0.0) / side as f32
    })
}

fn flat_soup(random: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    super::shapes::repeat(count, |_| {
        let center = cube_point(random);
        Triangle::from([(); 3].map(|()| (center + cube_point(random) * 0.1).with_z(0.0)))
    })
}

/// The circle of Ize 2008, section 3.2: a fan around its middle.
fn circle(count: usize) -> Vec<Triangle> {
    let rim = |i: usize| {
        let angle = (i % count) as f32 / count as f32 * TAU;
        Vec3::new(angle.cos(), angle.sin(), 0.0)
    };
    (0..count)
        .map(|i| Triangle::from([Vec3::ZERO, rim(i), rim(i + 1)]))
        .collect()
}
