//! Coordinates at the ends of what f32 holds, and scenes of several scales.

use glam::Vec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::random::{log_uniform, point_in_cube, sign, unit_vector};
use super::Family;
use super::shapes::{moved, repeated, soup};
use crate::Triangle;

pub(super) const FAMILIES: &[Family] = &[
    Family::new(
        "scale-1e30",
        "A soup at 1e30: areas and products overflow in f32.",
        20_000,
        |rng, count| scaled_soup(rng, count, 1e30),
    ),
    Family::new(
        "scale-1e-30",
        "A soup at 1e-30: areas and products underflow in f32.",
        20_000,
        |rng, count| scaled_soup(rng, count, 1e-30),
    ),
    Family::new(
        "scale-near-max",
        "Coordinates up to a quarter of the largest f32: extents just hold.",
        20_000,
        |rng, count| scaled_soup(rng, count, f32::MAX / 8.0),
    ),
    Family::new(
        "scale-max",
        "Corners at plus and minus the largest f32: extents overflow.",
        20_000,
        at_max,
    ),
    Family::new(
        "subnormal",
        "Subnormal coordinates, of which few bits are left.",
        20_000,
        |rng, count| scaled_soup(rng, count, 1e-41),
    ),
    Family::new(
        "negative-zero",
        "Corners at +0, -0 and +-1: equal positions with different bits.",
        20_000,
        negative_zero,
    ),
    Family::new(
        "far-offset",
        "A soup of extent 2 at 200,000 from the origin, 64 steps of f32 a unit.",
        20_000,
        far_offset,
    ),
    Family::new(
        "mixed-exponents",
        "Each coordinate of its own magnitude from 1e-30 to 1e30.",
        20_000,
        mixed_exponents,
    ),
    Family::new(
        "mixed-magnitudes",
        "Triangles from 1e-12 to 1e12 around one center.",
        20_000,
        mixed_magnitudes,
    ),
    Family::new(
        "anisotropic",
        "A soup stretched to 1e6 in one axis and to 1e-6 in another.",
        20_000,
        anisotropic,
    ),
];

/// Triangles of a fifth of the scene's extent, so that queries have hits.
fn scaled_soup(rng: &mut Pcg64Mcg, count: usize, scale: f32) -> Vec<Triangle> {
    moved(&soup(rng, count, 0.4), |vertex| vertex * scale)
}

fn at_max(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let mut coordinate = || match rng.random_range(0..4) {
        0 => f32::MAX,
        1 => -f32::MAX,
        _ => f32::MAX * (2.0 * rng.random::<f32>() - 1.0),
    };
    let mut corner = || Vec3::from_array([(); 3].map(|()| coordinate()));
    repeated(count, || [(); 3].map(|()| corner()).into())
}

fn negative_zero(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    const COORDINATES: [f32; 4] = [0.0, -0.0, 1.0, -1.0];
    let mut coordinate = || COORDINATES[rng.random_range(0..4)];
    let mut corner = || Vec3::from_array([(); 3].map(|()| coordinate()));
    repeated(count, || [(); 3].map(|()| corner()).into())
}

fn far_offset(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let offset = 2e5 * Vec3::new(sign(rng), sign(rng), sign(rng));
    moved(&soup(rng, count, 0.3), |vertex| vertex + offset)
}

fn mixed_exponents(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let mut coordinate = || sign(rng) * log_uniform(rng, 1e-30, 1e30) as f32;
    let mut corner = || Vec3::from_array([(); 3].map(|()| coordinate()));
    repeated(count, || [(); 3].map(|()| corner()).into())
}

fn mixed_magnitudes(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    repeated(count, || {
        let size = log_uniform(rng, 1e-12, 1e12) as f32;
        let center = size * unit_vector(rng);
        [(); 3].map(|()| center + size * point_in_cube(rng)).into()
    })
}

fn anisotropic(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let mut stretch = [1e6, 1.0, 1e-6];
    stretch.rotate_left(rng.random_range(0..3));
    let stretch = Vec3::from_array(stretch);
    moved(&soup(rng, count, 0.3), |vertex| vertex * stretch)
}
