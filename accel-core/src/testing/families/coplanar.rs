//! Scenes that lie in a plane, or in planes that all but coincide.

use std::f32::consts::{FRAC_PI_4, TAU};

use glam::{Quat, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::random::{point_in_cube, rotation, uniform};
use super::Family;
use super::shapes::{moved, quad, soup, square_side, surface};
use crate::Triangle;

pub(super) const FAMILIES: &[Family] = &[
    Family::new(
        "sheet-x",
        "A tessellated sheet of constant x.",
        20_000,
        sheet::<0>,
    ),
    Family::new(
        "sheet-y",
        "A tessellated sheet of constant y.",
        20_000,
        sheet::<1>,
    ),
    Family::new(
        "sheet-z",
        "A tessellated sheet of constant z.",
        20_000,
        sheet::<2>,
    ),
    Family::new(
        "sheet-rotated-45",
        "A sheet on x = y: the worst fit of axis-aligned boxes.",
        20_000,
        sheet_rotated_45,
    ),
    Family::new(
        "sheet-rotated",
        "A sheet in a random plane that its vertices meet only nearly.",
        20_000,
        sheet_rotated,
    ),
    Family::new(
        "circle-axis-aligned",
        "A disc of small triangles of constant y (Ize 2008, section 3.2).",
        20_000,
        circle,
    ),
    Family::new(
        "circle-rotated-45",
        "The disc turned onto x = y: one triangle's plane misses those \
         across the disc (Ize 2008, section 3.2).",
        20_000,
        circle_rotated_45,
    ),
    Family::new(
        "coplanar-overlapping",
        "Random triangles that overlap within one tilted plane.",
        20_000,
        coplanar_overlapping,
    ),
    Family::new(
        "flat-x",
        "Random triangles without extent in x.",
        20_000,
        flat::<0>,
    ),
    Family::new(
        "flat-y",
        "Random triangles without extent in y.",
        20_000,
        flat::<1>,
    ),
    Family::new(
        "flat-z",
        "Random triangles without extent in z.",
        20_000,
        flat::<2>,
    ),
    Family::new(
        "layers-one-ulp-apart",
        "Sheets at neighbouring f32 heights: hits whose t nearly tie.",
        20_000,
        layers,
    ),
    Family::new(
        "t-junction-wall",
        "A wall whose rows are cut in different numbers of columns.",
        20_000,
        t_junction_wall,
    ),
];

/// A square from -1 to 1 with `axis` constant, and its vertices moved within
/// the plane so that seeds differ.
fn square_sheet(rng: &mut Pcg64Mcg, count: usize, axis: usize) -> Vec<Triangle> {
    let side = square_side(count);
    let height = uniform(rng, -2.0, 2.0);
    let skew = uniform(rng, -0.5, 0.5);
    surface(side, side, |column, row| {
        let u = 2.0 * column as f32 / side as f32 - 1.0;
        let v = 2.0 * row as f32 / side as f32 - 1.0;
        let mut point = [0.0; 3];
        point[axis] = height;
        point[(axis + 1) % 3] = u;
        point[(axis + 2) % 3] = v + skew * u;
        Vec3::from_array(point)
    })
}

fn sheet<const AXIS: usize>(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    square_sheet(rng, count, AXIS)
}

fn sheet_rotated_45(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let turn = Quat::from_rotation_z(FRAC_PI_4);
    moved(&square_sheet(rng, count, 1), |vertex| turn * vertex)
}

fn sheet_rotated(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let turn = rotation(rng);
    moved(&square_sheet(rng, count, 2), |vertex| turn * vertex)
}

/// Rings around a center: outer triangles are as small as inner ones, and far
/// apart from those on the other side.
fn circle(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let rings = square_side(count / 4);
    let segments = (count / (2 * rings)).max(3);
    let height = uniform(rng, -1.0, 1.0);
    let phase = uniform(rng, 0.0, TAU);
    surface(segments, rings, |column, row| {
        let angle = phase + (column % segments) as f32 / segments as f32 * TAU;
        let radius = row as f32 / rings as f32;
        Vec3::new(radius * angle.cos(), height, radius * angle.sin())
    })
}

fn circle_rotated_45(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let turn = Quat::from_rotation_z(FRAC_PI_4);
    moved(&circle(rng, count), |vertex| turn * vertex)
}

fn coplanar_overlapping(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let turn = rotation(rng);
    moved(&flat::<2>(rng, count), |vertex| turn * vertex)
}

fn flat<const AXIS: usize>(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let height = uniform(rng, -2.0, 2.0);
    let scene = soup(rng, count, 0.2);
    moved(&scene, |mut vertex| {
        vertex[AXIS] = height;
        vertex
    })
}

fn layers(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let corner = point_in_cube(rng);
    let mut height = uniform(rng, 0.5, 1.0);
    let mut scene = Vec::with_capacity(count);
    while scene.len() < count {
        let [a, b] = [corner.with_z(height), (corner + 1.0).with_z(height)];
        scene.extend(quad([a, a.with_x(b.x), b, b.with_x(a.x)]));
        height = height.next_up();
    }
    scene
}

/// Vertices of one row lie on the edges of the next, rarely representable
/// there: what looks closed has cracks and overlaps of a last bit.
fn t_junction_wall(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let rows = square_side(count);
    let turn = rotation(rng);
    let mut wall = Vec::with_capacity(count);
    for row in 0..rows {
        let columns = (rows - 1).max(1) + rng.random_range(0..=1);
        let point = |column, level: usize| {
            let x = column as f32 / columns as f32;
            turn * Vec3::new(x, (row + level) as f32 / rows as f32, 0.0)
        };
        wall.extend(surface(columns, 1, point));
    }
    wall
}
