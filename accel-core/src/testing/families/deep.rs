//! Scenes whose trees are deep: the surface area heuristic peels a few
//! primitives off at every level.

use glam::Vec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::random::{sign, uniform};
use super::Family;
use super::shapes::{repeated, triangle_near};
use crate::Triangle;

pub(super) const FAMILIES: &[Family] = &[
    Family::new(
        "geometric-2",
        "Triangles away from the origin, each twice the size of the last, \
         over every exponent of f32.",
        20_000,
        |rng, count| geometric(rng, count, 2.0, 240),
    ),
    Family::new(
        "geometric-1.1",
        "The series with ratio 1.1: neighbours in size overlap.",
        20_000,
        |rng, count| geometric(rng, count, 1.1, 1750),
    ),
    Family::new(
        "geometric-nested",
        "Triangles that share one corner, in sizes of ratio 1.1: all overlap.",
        20_000,
        nested,
    ),
    Family::new(
        "geometric-spacing",
        "Triangles of one size at positions that double: centroids of which \
         half of any interval's bins are empty.",
        20_000,
        spacing,
    ),
    Family::new(
        "geometric-diagonal",
        "The series of ratio 2 along the diagonal: no axis is better.",
        20_000,
        diagonal,
    ),
];

/// The smallest size of a series; so near to the end of the normal numbers
/// that boxes of its triangles have areas of zero in f32.
const SMALLEST: f64 = 1e-36;

/// Where the series of one scene go, one after the other.
const ARMS: [Vec3; 6] = [
    Vec3::X,
    Vec3::Y,
    Vec3::Z,
    Vec3::NEG_X,
    Vec3::NEG_Y,
    Vec3::NEG_Z,
];

fn term(ratio: f64, index: usize) -> f32 {
    (SMALLEST * ratio.powi(index as i32)) as f32
}

/// A series has `period` terms, then starts again along another axis.
fn geometric(rng: &mut Pcg64Mcg, count: usize, ratio: f64, period: usize) -> Vec<Triangle> {
    let first = rng.random_range(0..6);
    let triangle = |index: usize| {
        let arm = first + index / period;
        let axis = ARMS[arm % 6];
        let size = term(ratio, index % period);
        triangle_near(rng, 2.0 * size * axis, 0.4 * size)
    };
    (0..count).map(triangle).collect()
}

fn nested(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let octant = Vec3::new(sign(rng), sign(rng), sign(rng));
    let triangle = |index: usize| {
        let size = term(1.1, index % 1750) * octant;
        let mut corner = || {
            let fractions = [(); 3].map(|()| uniform(rng, 0.5, 1.0));
            size * Vec3::from_array(fractions)
        };
        Triangle::new(Vec3::ZERO, corner(), corner())
    };
    (0..count).map(triangle).collect()
}

fn spacing(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let axis = Vec3::AXES[rng.random_range(0..3)] * sign(rng);
    let mut index = 0;
    repeated(count, || {
        let position = term(2.0, index % 240);
        index += 1;
        triangle_near(rng, position * axis, 1e-3)
    })
}

fn diagonal(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let octant = Vec3::new(sign(rng), sign(rng), sign(rng));
    let triangle = |index: usize| {
        let size = term(2.0, index % 240);
        triangle_near(rng, 2.0 * size * octant, 0.5 * size)
    };
    (0..count).map(triangle).collect()
}
