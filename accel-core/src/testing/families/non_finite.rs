//! Triangles that are not numbers among sound ones, whose answers they must
//! not change.

use glam::Vec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::Family;
use super::shapes::soup;
use crate::Triangle;

pub(super) const FAMILIES: &[Family] = &[
    Family::new(
        "nan-mixed",
        "Every eighth triangle or so has a NaN coordinate.",
        20_000,
        |rng, count| spoiled(rng, count, 8, &[f32::NAN]),
    )
    .with_invalid(),
    Family::new(
        "infinity-mixed",
        "Every eighth triangle or so has an infinite coordinate.",
        20_000,
        |rng, count| spoiled(rng, count, 8, &[f32::INFINITY, f32::NEG_INFINITY]),
    )
    .with_invalid(),
    Family::new(
        "non-finite-mixed",
        "Half of the triangles have NaN or infinite coordinates.",
        20_000,
        |rng, count| spoiled(rng, count, 2, &NON_FINITE),
    )
    .with_invalid(),
    Family::new(
        "non-finite-corners",
        "Whole corners are NaN or infinite, so that no axis is left to go by.",
        20_000,
        spoiled_corners,
    )
    .with_invalid(),
    Family::new(
        "non-finite-all",
        "Not one sound triangle: as good as an empty scene.",
        2_000,
        |rng, count| spoiled(rng, count, 1, &NON_FINITE),
    )
    .with_invalid(),
];

const NON_FINITE: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

/// A soup of which one triangle in `every` gets one of `values` somewhere; at
/// least the first does.
fn spoiled(rng: &mut Pcg64Mcg, count: usize, every: u32, values: &[f32]) -> Vec<Triangle> {
    let mut scene = soup(rng, count, 0.2);
    for (index, triangle) in scene.iter_mut().enumerate() {
        if index == 0 || rng.random_ratio(1, every) {
            let value = values[rng.random_range(0..values.len())];
            let corner = random_corner(rng, triangle);
            corner[rng.random_range(0..3)] = value;
        }
    }
    scene
}

fn spoiled_corners(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let mut scene = soup(rng, count, 0.2);
    for (index, triangle) in scene.iter_mut().enumerate() {
        if index == 0 || rng.random_ratio(1, 8) {
            let value = NON_FINITE[rng.random_range(0..3)];
            *random_corner(rng, triangle) = Vec3::splat(value);
        }
    }
    scene
}

fn random_corner<'a>(rng: &mut Pcg64Mcg, triangle: &'a mut Triangle) -> &'a mut Vec3 {
    match rng.random_range(0..3) {
        0 => &mut triangle.a,
        1 => &mut triangle.b,
        _ => &mut triangle.c,
    }
}
