//! Rays along axes and planes of axes, and nearly so.

use glam::{DVec3, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::random::{sign, unit_vector};
use super::targets::{Targets, ray, rounded};
use crate::RaySegment;

/// The plane holds a vertex; some of the rays lie in two such planes at once,
/// along what may be the edge of a box.
pub(super) fn box_plane(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    let first = rng.random_range(0..3);
    let axes = [first, (first + 1) % 3];
    let fixed = &axes[..if rng.random_ratio(1, 4) { 2 } else { 1 }];
    let mut origin = targets.origin(rng);
    for &axis in fixed {
        origin[axis] = targets.vertex(rng)[axis];
    }
    within_planes(targets, origin, fixed, rng)
}

/// A ray from `origin` that stays at its coordinates in the one or two axes
/// `fixed`, of which the second follows the first.
pub(super) fn within_planes(
    targets: &Targets,
    origin: DVec3,
    fixed: &[usize],
    rng: &mut Pcg64Mcg,
) -> RaySegment {
    let mut direction = targets.surface_point(rng) - rounded(origin).as_dvec3();
    for &axis in fixed {
        direction[axis] = 0.0;
    }
    if rounded(direction) == Vec3::ZERO {
        let free = (fixed[0] + 2) % 3;
        direction[free] = targets.radius() * f64::from(sign(rng));
    }
    with_signed_zeros(ray(origin, direction, rng), rng)
}

pub(super) fn axis_parallel(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    let axis = rng.random_range(0..3);
    let mut origin = if rng.random() {
        targets.vertex(rng)
    } else {
        targets.surface_point(rng)
    };
    let away = targets.radius() * rng.random_range(0.1..4.0) * f64::from(sign(rng));
    origin[axis] -= away;
    // Now and then backwards, or so that t is 1 at the target.
    let length = match rng.random_range(0..4) {
        0 => -away.signum(),
        1 => away,
        _ => away.signum(),
    };
    let along = ray(origin, DVec3::AXES[axis] * length, rng);
    with_signed_zeros(along, rng)
}

/// Towards a surface, but with one or two components of the direction set to
/// tiny values of either sign.
pub(super) fn tiny_component(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    const TINY: [f32; 6] = [
        1e-7,
        1e-15,
        1e-30,
        f32::MIN_POSITIVE,
        1e-41,
        f32::from_bits(1),
    ];
    let axis = rng.random_range(0..3);
    let mut origin = targets.surface_point(rng);
    origin[axis] -= targets.radius() * rng.random_range(0.0..2.0);
    let mut tiny = ray(origin, unit_vector(rng).as_dvec3(), rng);
    tiny.direction[axis] = sign(rng);
    for other in [(axis + 1) % 3, (axis + 2) % 3] {
        if rng.random_ratio(2, 3) {
            tiny.direction[other] = TINY[rng.random_range(0..TINY.len())] * sign(rng);
        }
    }
    tiny
}

/// Towards a surface from so far along an axis that the ratio of the other components of
/// the direction to that one is a number below all normal ones, which is rounded by a
/// good part of itself.
pub(super) fn subnormal_ratio(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    let power =
        |range: std::ops::Range<i32>, rng: &mut Pcg64Mcg| 2.0_f64.powi(rng.random_range(range));
    let axis = rng.random_range(0..3);
    let mut origin = targets.surface_point(rng);
    let along = power(24..60, rng);
    let way = power(95..126, rng);
    let mut direction = DVec3::ZERO;
    direction[axis] = along;
    for other in [(axis + 1) % 3, (axis + 2) % 3] {
        direction[other] = along * power(-150..-130, rng) * rng.random_range(-1.0..1.0);
    }
    let direction = rounded(direction);
    origin -= direction.as_dvec3() * (way / along);
    RaySegment::new(rounded(origin), direction)
}

/// Gives every zero of the direction a random sign.
fn with_signed_zeros(mut ray: RaySegment, rng: &mut Pcg64Mcg) -> RaySegment {
    for axis in 0..3 {
        if ray.direction[axis] == 0.0 {
            ray.direction[axis] *= sign(rng);
        }
    }
    ray
}
