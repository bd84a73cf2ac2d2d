//! The sphere: proof that nothing here knows triangles only.

use glam::{DVec3, Vec3};

use super::{Clip, Intersection, Polygonal, Primitive};
use crate::geometry::{Aabb, Plane, rounding};
use crate::layout::LeafOrdered;
use crate::query::Hit;
use crate::ray::PreparedRay;

/// Single precision places a point of coordinate 1 within this.
const PLACEMENT: f64 = 1.0 / (1 << 22) as f64;

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
    /// The 24 corners of the solid around the sphere whose faces are tangent to it
    /// along the axes and the diagonals: a truncated octahedron.
    fn vertices(&self) -> impl Iterator<Item = Vec3> {
        let center = self.center.as_dvec3();
        // Covers what rounding the corners takes off the solid.
        let margin = PLACEMENT * (f64::from(self.radius) + center.abs().max_element());
        let long = f64::from(self.radius) + margin;
        let short = long * (3.0_f64.sqrt() - 1.0);
        let corner = move |axis: usize, other: usize, signs: usize| {
            let sign = |bit: usize| if signs >> bit & 1 == 1 { -1.0 } else { 1.0 };
            let mut offset = DVec3::ZERO;
            offset[axis] = sign(0) * long;
            offset[other] = sign(1) * short;
            (center + offset).as_vec3().clamp(Vec3::MIN, Vec3::MAX)
        };
        (0..24).map(move |index| {
            let (axis, other, signs) = (index % 3, (index + 1 + index / 3 % 2) % 3, index / 6);
            corner(axis, other, signs)
        })
    }

    /// Tangent along the diagonals (Ize, Wald and Parker 2008, section 6.1, take
    /// random ones).
    fn candidate_planes(&self) -> impl Iterator<Item = Plane> {
        let Self { center, radius } = *self;
        (0..8).map(move |octant: u32| {
            let sign = |bit: u32| if octant >> bit & 1 == 1 { -1.0 } else { 1.0 };
            let normal = Vec3::new(sign(0), sign(1), sign(2)).normalize();
            Plane::through(center + radius * normal, normal)
        })
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

    #[test]
    fn the_hull_is_outside_the_sphere_and_its_faces_are_tangent() {
        for (center, radius) in [([0.0; 3], 1.0), ([1e3, -7.0, 0.5], 0.01), ([1e8; 3], 2e6)] {
            let sphere = Sphere::new(center, radius);
            let corners: Vec<Vec3> = sphere.vertices().collect();
            let distinct = corners
                .iter()
                .enumerate()
                .all(|(index, corner)| corners[index + 1..].iter().all(|other| other != corner));
            assert!(corners.len() == 24 && distinct);
            let faces = Vec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
            let faces = faces.chain(sphere.candidate_planes().map(|plane| plane.normal));
            let tolerance = 1e-6 * (f64::from(radius) + sphere.center.abs().max_element() as f64);
            for normal in faces {
                let normal = normal.as_dvec3().normalize();
                let heights = corners.iter().map(|corner| {
                    normal.dot(corner.as_dvec3() - sphere.center.as_dvec3()) - f64::from(radius)
                });
                let highest = heights.fold(f64::NEG_INFINITY, f64::max);
                assert!(
                    (0.0..=tolerance).contains(&highest),
                    "{highest} {tolerance}"
                );
            }
        }
    }
}
