//! The part of a scene that rays can aim at.

use glam::{DVec3, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::random::{point_in_cube, unit_vector};
use crate::{RaySegment, Triangle};

/// The finite triangles of a scene and its extent.
pub(super) struct Targets {
    triangles: Vec<Triangle>,
    center: DVec3,
    half_extent: DVec3,
}

impl Targets {
    pub(super) fn of(scene: &[Triangle]) -> Self {
        let is_finite = |triangle: &&Triangle| triangle.vertices().iter().all(|v| v.is_finite());
        let mut triangles: Vec<_> = scene.iter().filter(is_finite).copied().collect();
        if triangles.is_empty() {
            triangles.push(Vec3::AXES.into());
        }
        let vertices = triangles.iter().flat_map(Triangle::vertices);
        let (low, high) = vertices.map(Vec3::as_dvec3).fold(
            (DVec3::INFINITY, DVec3::NEG_INFINITY),
            |(low, high), vertex| (low.min(vertex), high.max(vertex)),
        );
        Self {
            triangles,
            center: low.midpoint(high),
            half_extent: (high - low) / 2.0,
        }
    }

    /// Half the scene's largest extent; of a scene without any, a fraction of
    /// its coordinates that f32 can tell apart there. Never zero.
    pub(super) fn radius(&self) -> f64 {
        let radius = self.half_extent.max_element();
        let resolved = self.center.abs().max_element() * 2f64.powi(-10);
        match (radius > 0.0, resolved > 0.0) {
            (true, _) => radius,
            (false, true) => resolved.max(f64::from(f32::from_bits(16))),
            (false, false) => 1.0,
        }
    }

    pub(super) fn triangle(&self, rng: &mut Pcg64Mcg) -> &Triangle {
        &self.triangles[rng.random_range(0..self.triangles.len())]
    }

    /// The corners of a random triangle, starting with a random one.
    pub(super) fn corners(&self, rng: &mut Pcg64Mcg) -> [DVec3; 3] {
        let mut corners = self.triangle(rng).vertices().map(Vec3::as_dvec3);
        corners.rotate_left(rng.random_range(0..3));
        corners
    }

    pub(super) fn vertex(&self, rng: &mut Pcg64Mcg) -> DVec3 {
        self.corners(rng)[0]
    }

    /// A point of a triangle, uniform on it.
    pub(super) fn surface_point(&self, rng: &mut Pcg64Mcg) -> DVec3 {
        let [a, b, c] = self.corners(rng);
        let [mut u, mut v] = [rng.random::<f64>(), rng.random::<f64>()];
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        a * (1.0 - u - v) + b * u + c * v
    }

    /// A point of the scene's box.
    pub(super) fn box_point(&self, rng: &mut Pcg64Mcg) -> DVec3 {
        self.center + self.half_extent * point_in_cube(rng).as_dvec3()
    }

    /// A point in or around the scene: of its box, of the cube around it, or
    /// of a cube three times as large.
    pub(super) fn origin(&self, rng: &mut Pcg64Mcg) -> DVec3 {
        let reach = match rng.random_range(0..4) {
            0 => return self.box_point(rng),
            1 => self.radius(),
            _ => 3.0 * self.radius(),
        };
        self.center + reach * point_in_cube(rng).as_dvec3()
    }
}

/// `point` as f32 holds it; what exceeds the largest f32 becomes that.
pub(super) fn rounded(point: DVec3) -> Vec3 {
    const LIMIT: DVec3 = DVec3::splat(f32::MAX as f64);
    point.clamp(-LIMIT, LIMIT).as_vec3()
}

/// The ray from `origin` along `direction`, both rounded to f32 and finite. A
/// direction too long for f32 is shortened by a power of two, which keeps its
/// bits; one that vanishes is replaced by a random one.
pub(super) fn ray(origin: DVec3, direction: DVec3, rng: &mut Pcg64Mcg) -> RaySegment {
    let longest = direction.abs().max_element();
    let shortening = if longest > f64::from(f32::MAX) {
        2f64.powi(-((longest.log2() - 127.0).ceil() as i32))
    } else {
        1.0
    };
    let direction = rounded(direction * shortening);
    let usable = direction.is_finite() && direction != Vec3::ZERO;
    let direction = if usable { direction } else { unit_vector(rng) };
    RaySegment::new(rounded(origin), direction)
}

/// The ray from `origin` towards `target`. The direction is the difference of
/// both as f32 holds them, rounded once, so `t` is about 1 at the target.
pub(super) fn towards(origin: DVec3, target: DVec3, rng: &mut Pcg64Mcg) -> RaySegment {
    let origin = rounded(origin).as_dvec3();
    ray(origin, target - origin, rng)
}
