//! The surface at a hit, and where the next ray may start.

use glam::Vec3;

use crate::geometry::{Aabb, rounding};
use crate::ray::PreparedRay;

/// Which face of a surface a ray struck.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// The face that the geometric normal points away from: the ray came
    /// against the normal.
    Front,
    /// The other one. Also the answer where there is no normal.
    Back,
}

impl Face {
    /// The face that `ray` strikes where the surface has this normal.
    pub fn towards(ray: &PreparedRay, normal: Vec3) -> Self {
        let along = ray.direction().as_dvec3().dot(normal.as_dvec3());
        if along < 0.0 { Self::Front } else { Self::Back }
    }
}

/// The surface at a hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The point of the hit, in scene units.
    pub point: Vec3,
    /// How far each coordinate of `point` may be from the exact surface.
    pub error: Vec3,
    /// The unit normal towards the front; zero where there is none.
    pub normal: Vec3,
    /// The face that was struck.
    pub face: Face,
}

impl SurfacePoint {
    /// Where a ray that leaves the surface towards `direction` should start:
    /// off the surface by just more than the error, on the side that
    /// `direction` points to, so that it neither meets the surface again nor
    /// passes anything in between. No epsilon to choose, at any scale.
    pub fn origin_towards(&self, direction: Vec3) -> Vec3 {
        // Pharr, Jakob and Humphreys, Physically Based Rendering, section 6.8.6.
        let (normal, error) = (self.normal.as_dvec3(), self.error.as_dvec3());
        let reach = normal.abs().dot(error);
        let leaves_front = direction.as_dvec3().dot(normal) >= 0.0;
        let offset = if leaves_front {
            normal * reach
        } else {
            normal * -reach
        };
        let exact = self.point.as_dvec3() + offset;
        let away = |exact: f64, offset: f64| {
            if offset > 0.0 {
                rounding::up(exact)
            } else if offset < 0.0 {
                rounding::down(exact)
            } else {
                exact as f32
            }
        };
        Vec3::new(
            away(exact.x, offset.x),
            away(exact.y, offset.y),
            away(exact.z, offset.z),
        )
    }
}

/// The point at `t` with an error that covers the evaluation, the rounding of
/// `t`, and the clamp to the gate box of `bounds`.
pub(super) fn point_along(ray: &PreparedRay, t: f32, bounds: &Aabb) -> (Vec3, Vec3) {
    let (origin, step) = (
        ray.origin().as_dvec3(),
        ray.direction().as_dvec3() * f64::from(t),
    );
    let gate = bounds.largest_extent() / f64::from(1 << 20);
    let error = (origin.abs() + step.abs() * 8.0) * f64::from(rounding::gamma(1)) + gate;
    ((origin + step).as_vec3(), rounding::vec3_up(error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_origin_lies_on_the_side_that_the_ray_leaves_to() {
        let surface = SurfacePoint {
            point: Vec3::new(1.0, 2.0, 3.0),
            error: Vec3::splat(1e-6),
            normal: Vec3::Y,
            face: Face::Front,
        };
        let above = surface.origin_towards(Vec3::new(1.0, 1.0, 0.0));
        let below = surface.origin_towards(Vec3::new(1.0, -1.0, 0.0));
        assert!(above.y > 2.0 && above.y < 2.000_01 && below.y < 2.0 && below.y > 1.999_99);
        assert_eq!((above.x, above.z), (1.0, 3.0));
    }
}
