//! Long and thin.

use std::f32::consts::TAU;

use glam::{Quat, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::shapes::{grid, mapped, repeat, strip, turned};
use super::{Family, family};
use crate::Triangle;
use crate::testing::{cube_point, direction};

pub(super) const FAMILIES: &[Family] = &[
    family(
        "slivers-1e-3",
        "width 1e-3 of the length",
        |random, count| slivers(random, count, 1e-3),
    ),
    family(
        "slivers-1e-7",
        "width 1e-7 of the length",
        |random, count| slivers(random, count, 1e-7),
    ),
    family(
        "slivers-1e-15",
        "width 1e-15 of the length",
        |random, count| slivers(random, count, 1e-15),
    ),
    family(
        "slivers-1e-30",
        "width 1e-30 of the length",
        |random, count| slivers(random, count, 1e-30),
    ),
    family(
        "cylinder",
        "a cylinder of skinny triangles, tilted",
        |random, count| {
            let tilt = Quat::from_rotation_arc(Vec3::Y, direction(random));
            mapped(cylinder(count), |p| tilt * p)
        },
    ),
    family(
        "cylinder-upright",
        "a cylinder of skinny triangles, upright",
        |_, count| cylinder(count),
    ),
    family("diagonals", "long diagonal triangles", |random, count| {
        let strips = (0..count.div_ceil(2)).flat_map(|_| {
            let from = cube_point(random) - Vec3::ONE;
            strip(random, from, from + Vec3::splat(2.0), 0.02)
        });
        strips.collect()
    }),
    family("pipes", "long strips on a turned grid", |random, count| {
        let strips = (0..count.div_ceil(2)).flat_map(|i| {
            let along = [Vec3::X, Vec3::Y, Vec3::Z][i % 3];
            let cell = (cube_point(random) * 8.0).round() / 8.0;
            let from = cell - along * cell.dot(along) - along;
            strip(
                random,
                turned() * from,
                turned() * (from + along * 2.0),
                0.01,
            )
        });
        strips.collect()
    }),
    family(
        "t-junctions",
        "walls of strips whose corners meet edges",
        |_, count| {
            let columns = (count / 4).max(1);
            let lower = grid(columns, 1, |x, y| {
                Vec3::new(x as f32 / columns as f32, y as f32, 0.0)
            });
            let others = columns.div_ceil(2) + 1;
            let upper = grid(others, 1, |x, y| {
                Vec3::new(x as f32 / others as f32, 1.0 + y as f32, 0.0)
            });
            lower.into_iter().chain(upper).collect()
        },
    ),
];

fn slivers(random: &mut Pcg64Mcg, count: usize, width: f32) -> Vec<Triangle> {
    repeat(count, |_| {
        let [from, to] = [(); 2].map(|()| cube_point(random));
        let middle = from.lerp(to, random.random());
        Triangle::from([from, to, middle + direction(random) * width])
    })
}

fn cylinder(count: usize) -> Vec<Triangle> {
    let sides = (count / 2).max(3);
    grid(sides, 1, |x, y| {
        let angle = (x % sides) as f32 / sides as f32 * TAU;
        Vec3::new(angle.cos() * 0.2, y as f32 * 4.0 - 2.0, angle.sin() * 0.2)
    })
}
