//! The sphere: proof that nothing here knows triangles only.

use glam::{DVec3, Vec3};

use super::{Clip, Intersection, Polygonal, Primitive};
use crate::geometry::{Aabb, Plane, rounding};
use crate::layout::LeafOrdered;
use crate::query::Hit;
use crate::ray::PreparedRay;

/// A sphere. Hits carry `u = v = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// The middle, in scene units.
    pub center: Vec3,
    /// The radius in scene units; a negative or non-finite one makes the
    /// sphere invalid.
    pub radius: f32,
}

impl Sphere {
    /// The sphere of `radius` around `center`.
    pub fn new(center: impl Into<Vec3>, radius: f32) -> Self {
        Self {
            center: center.into(),
            radius,
        }
    }
}

impl Primitive for Sphere {
    type Storage = LeafOrdered<Self>;

    fn bounds(&self) -> Aabb {
        // The negated comparison also catches a NaN radius.
        let is_sphere = self.radius >= 0.0 && self.radius.is_finite() && self.center.is_finite();
        if !is_sphere {
            return Aabb::INVALID;
        }
        let (center, radius) = (self.center.as_dvec3(), f64::from(self.radius));
        Aabb {
            min: rounding::vec3_down(center - radius),
            max: rounding::vec3_up(center + radius),
        }
    }

    /// Solved in double precision with the discriminant taken from the distance
    /// between centre and ray, which does not cancel (Haines, Guenther and
    /// Akenine-Moeller, *Precision Improvements for Ray/Sphere Intersection*,
    /// Ray Tracing Gems 2019, chapter 7).
    fn intersect(&self, ray: &PreparedRay) -> Option<Intersection> {
        let direction = ray.direction().as_dvec3();
        let to_center = self.center.as_dvec3() - ray.origin().as_dvec3();
        let radius = f64::from(self.radius);
        let length_squared = direction.length_squared();
        let closest = to_center.dot(direction) / length_squared;
        let offset = to_center - direction * closest;
        let discriminant = radius * radius - offset.length_squared();
        // False for NaN as well.
        if !(discriminant >= 0.0 && length_squared > 0.0) {
            return None;
        }
        let half_chord = (discriminant / length_squared).sqrt();
        [closest - half_chord, closest + half_chord]
            .map(|t| t as f32)
            .into_iter()
            .find(|&t| t >= ray.t_min())
            .map(|t| Intersection { t, u: 0.0, v: 0.0 })
    }

    fn geometric_normal(&self, _: &Hit, point: Vec3) -> Vec3 {
        let outward: DVec3 = point.as_dvec3() - self.center.as_dvec3();
        outward.normalize_or_zero().as_vec3()
    }
}

impl Clip for Sphere {}

impl Polygonal for Sphere {
    /// The corners of the sphere's box.
    fn vertices(&self) -> impl Iterator<Item = Vec3> {
        let bounds = self.bounds();
        (0..8).map(move |corner| bounds.corner([0, 1, 2].map(|axis| corner >> axis & 1 == 1)))
    }

    /// None of its own: the planes tangent to its box are as good as any.
    fn candidate_planes(&self) -> impl Iterator<Item = Plane> {
        std::iter::empty()
    }

    fn signed_range(&self, plane: &Plane) -> (f64, f64) {
        let middle = plane.signed_distance(self.center);
        let reach = f64::from(self.radius) * plane.normal.as_dvec3().length();
        (middle - reach, middle + reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ray::RaySegment;

    fn hit(origin: [f32; 3], t_min: f32) -> Option<f32> {
        let ray = RaySegment::new(origin, [0.0, 0.0, 2.0]).with_interval(t_min, f32::INFINITY);
        let ray = PreparedRay::new(&ray).unwrap();
        let found = Sphere::new([0.0; 3], 1.0).intersect(&ray);
        found.map(|intersection| intersection.t)
    }

    #[test]
    fn the_first_crossing_past_t_min_is_the_hit() {
        assert_eq!(hit([0.0, 0.0, -3.0], 0.0), Some(1.0));
        assert_eq!(hit([0.0, 0.0, -3.0], 1.5), Some(2.0));
        assert_eq!(hit([0.0; 3], 0.0), Some(0.5));
        assert_eq!(hit([0.0, 0.0, 3.0], 0.0), None);
        assert_eq!(hit([2.0, 0.0, -3.0], 0.0), None);
    }

    #[test]
    fn negative_and_non_finite_radii_are_invalid() {
        for radius in [-1.0, f32::NAN, f32::INFINITY] {
            assert!(!Sphere::new([0.0; 3], radius).bounds().is_valid());
        }
    }
}
