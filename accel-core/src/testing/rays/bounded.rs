//! Rays whose interval or origin is at a surface.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::edge::point_on_edge;
use super::super::random::unit_vector;
use super::targets::{Targets, ray, rounded, towards};
use crate::RaySegment;

/// The target lies at a `t` of 1, give or take rounding.
pub(super) fn short_segment(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    const NEARLY_ONE: [f32; 2] = [1.0 - f32::EPSILON, 1.0 + f32::EPSILON];
    let origin = targets.origin(rng);
    let target = targets.surface_point(rng);
    let (t_min, t_max) = match rng.random_range(0..8) {
        0 => (0.0, 1.0),
        1 => (1.0, 1.0),
        2 => (1.0, f32::INFINITY),
        3 => (NEARLY_ONE[0], NEARLY_ONE[1]),
        4 => (0.0, NEARLY_ONE[0]),
        5 => (NEARLY_ONE[1], 4.0),
        6 => (0.0, 0.0),
        _ => {
            let start = 2.0 * rng.random::<f32>();
            (start, start + rng.random::<f32>())
        }
    };
    towards(origin, target, rng).with_interval(t_min, t_max)
}

/// Half of the rays start at `t` 0, where they leave a surface; the others
/// leave it out with a small `t_min`, as renderers do.
pub(super) fn on_surface(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    let point = match rng.random_range(0..4) {
        0 => targets.vertex(rng),
        1 => point_on_edge(targets.corners(rng), rng),
        _ => targets.surface_point(rng),
    };
    let leaving = if rng.random() {
        ray(point, unit_vector(rng).as_dvec3(), rng)
    } else {
        let target = rounded(targets.surface_point(rng)).as_dvec3();
        towards(point, target, rng)
    };
    let t_min = if rng.random() { 0.0 } else { 1e-4 };
    leaving.with_interval(t_min, f32::INFINITY)
}
