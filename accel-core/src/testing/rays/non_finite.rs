//! Rays that are none.

use glam::Vec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use crate::RaySegment;

/// `ray` with one thing made wrong.
///
/// An infinite `t_max` is sound, and so is a `t_min` of minus infinity, which
/// counts as 0: neither is among them.
pub(super) fn spoiled(mut ray: RaySegment, rng: &mut Pcg64Mcg) -> RaySegment {
    const NON_FINITE: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    let axis = rng.random_range(0..3);
    let value = NON_FINITE[rng.random_range(0..3)];
    match rng.random_range(0..9) {
        0 => ray.origin[axis] = value,
        1 => ray.direction[axis] = value,
        2 => ray.origin = Vec3::splat(value),
        3 => ray.direction = Vec3::splat(value),
        4 => ray.direction = Vec3::ZERO,
        5 => ray.direction = -Vec3::ZERO,
        6 => {
            ray.t_min = if rng.random() {
                f32::NAN
            } else {
                f32::INFINITY
            }
        }
        7 => {
            ray.t_max = if rng.random() {
                f32::NAN
            } else {
                f32::NEG_INFINITY
            }
        }
        _ => (ray.t_min, ray.t_max) = (2.0, 1.0),
    }
    ray
}
