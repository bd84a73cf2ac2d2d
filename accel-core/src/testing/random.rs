//! The few distributions that scenes and rays are drawn from.

use glam::{Quat, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

pub(super) fn uniform(rng: &mut Pcg64Mcg, low: f32, high: f32) -> f32 {
    low + (high - low) * rng.random::<f32>()
}

/// Every order of magnitude between `low` and `high` is equally likely.
pub(super) fn log_uniform(rng: &mut Pcg64Mcg, low: f64, high: f64) -> f64 {
    let exponent = low.ln() + (high.ln() - low.ln()) * rng.random::<f64>();
    exponent.exp().clamp(low, high)
}

/// A point of the cube from -1 to 1 in every axis.
pub(super) fn point_in_cube(rng: &mut Pcg64Mcg) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| uniform(rng, -1.0, 1.0)))
}

/// A direction, uniform on the unit sphere.
pub(super) fn unit_vector(rng: &mut Pcg64Mcg) -> Vec3 {
    let z = uniform(rng, -1.0, 1.0);
    let (sine, cosine) = uniform(rng, 0.0, std::f32::consts::TAU).sin_cos();
    let radius = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(radius * cosine, radius * sine, z)
}

pub(super) fn rotation(rng: &mut Pcg64Mcg) -> Quat {
    let angle = uniform(rng, 0.0, std::f32::consts::TAU);
    Quat::from_axis_angle(unit_vector(rng).normalize(), angle)
}

/// One or minus one.
pub(super) fn sign(rng: &mut Pcg64Mcg) -> f32 {
    if rng.random() { 1.0 } else { -1.0 }
}
