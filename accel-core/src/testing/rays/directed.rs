//! Rays told apart by where they come from and what they are aimed at.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::edge::{point_beside_edge, point_on_edge};
use super::super::random::{log_uniform, unit_vector};
use super::targets::{Targets, ray, rounded, towards};
use crate::RaySegment;

pub(super) fn random(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    let origin = targets.origin(rng);
    let direction = unit_vector(rng).as_dvec3();
    ray(origin, direction, rng)
}

pub(super) fn inside(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    let [origin, target] = [targets.box_point(rng), targets.box_point(rng)];
    towards(origin, target, rng)
}

pub(super) fn through_vertex(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    let [origin, target] = [targets.origin(rng), targets.vertex(rng)];
    towards(origin, target, rng)
}

pub(super) fn through_edge(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    let point = rounded(point_on_edge(targets.corners(rng), rng)).as_dvec3();
    let origin = targets.origin(rng);
    towards(origin, point, rng)
}

/// The target is not rounded to f32: the direction resolves it better.
pub(super) fn beside_edge(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    let target = point_beside_edge(targets.corners(rng), rng);
    let origin = targets.origin(rng);
    towards(origin, target, rng)
}

pub(super) fn far_origin(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    let target = targets.surface_point(rng);
    let distance = targets.radius() * log_uniform(rng, 1e3, 1e6);
    let origin = target + distance * unit_vector(rng).as_dvec3();
    towards(origin, target, rng)
}

pub(super) fn scaled(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    let origin = rounded(targets.origin(rng)).as_dvec3();
    let target = targets.surface_point(rng);
    let factor = log_uniform(rng, 1e-20, 1e20);
    ray(origin, (target - origin) * factor, rng)
}

/// The origin lies on the extension of a triangle or a little off its plane.
pub(super) fn grazing(targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
    let [a, b, c] = targets.corners(rng);
    let within = |rng: &mut Pcg64Mcg, low: f64, high: f64| {
        let mut weight = || low + (high - low) * rng.random::<f64>();
        a + (b - a) * weight() + (c - a) * weight()
    };
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let lift = if rng.random() {
        log_uniform(rng, 1e-9, 1e-3)
    } else {
        0.0
    };
    let origin = within(rng, -3.0, 3.0) + normal * (a.distance(b) * lift);
    let target = within(rng, 0.0, 0.5);
    towards(origin, target, rng)
}
