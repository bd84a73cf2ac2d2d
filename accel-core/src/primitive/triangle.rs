//! The triangle.

use glam::Vec3;

use super::{
    Clip, Intersection, LaneIntersections, Polygonal, Primitive, intersect_one_by_one, watertight,
};
use crate::geometry::{Aabb, Axis, DAabb, GrowingBox, Plane, rounding};
use crate::layout::LeafOrdered;
use crate::query::Hit;
use crate::ray::{PacketVector, PreparedRay};
use crate::reference::{chop_polygon, clip_polygon, clip_polygon_corners};
use crate::simd::Lanes;

/// A triangle with corners `a`, `b`, `c`. The point of a hit with barycentric
/// coordinates `u`, `v` is `(1 - u - v) a + u b + v c`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// First corner.
    pub a: Vec3,
    /// Second corner, where `u` is 1.
    pub b: Vec3,
    /// Third corner, where `v` is 1.
    pub c: Vec3,
}

impl Triangle {
    /// A triangle of three corners; counter-clockwise seen from its front.
    pub fn new(a: impl Into<Vec3>, b: impl Into<Vec3>, c: impl Into<Vec3>) -> Self {
        Self {
            a: a.into(),
            b: b.into(),
            c: c.into(),
        }
    }

    /// The corners in order.
    pub fn vertices(&self) -> [Vec3; 3] {
        [self.a, self.b, self.c]
    }

    /// The unit normal towards the front; zero if the triangle has no area.
    pub fn normal(&self) -> Vec3 {
        // In double precision no finite triangle overflows or vanishes.
        let (a, b, c) = (self.a.as_dvec3(), self.b.as_dvec3(), self.c.as_dvec3());
        (b - a).cross(c - a).normalize_or_zero().as_vec3()
    }

    /// The area in square scene units.
    pub fn area(&self) -> f64 {
        let (a, b, c) = (self.a.as_dvec3(), self.b.as_dvec3(), self.c.as_dvec3());
        0.5 * (b - a).cross(c - a).length()
    }
}

impl From<[Vec3; 3]> for Triangle {
    fn from([a, b, c]: [Vec3; 3]) -> Self {
        Self { a, b, c }
    }
}

impl Primitive for Triangle {
    type Storage = LeafOrdered<Self>;

    #[inline]
    fn bounds(&self) -> Aabb {
        Aabb::around(&self.vertices())
    }

    #[inline]
    fn intersect(&self, ray: &PreparedRay) -> Option<Intersection> {
        watertight::intersect(ray, self.vertices())
    }

    #[inline(always)]
    fn intersect_packet<L: Lanes>(
        &self,
        rays: &PacketVector<'_, L>,
        mask: u32,
    ) -> LaneIntersections<L> {
        let vertices = self.vertices();
        match watertight::intersect_lanes(rays.lanes, rays.shared, mask, vertices) {
            Some(found) => found,
            None => intersect_one_by_one(self, rays, mask),
        }
    }

    fn geometric_normal(&self, _: &Hit, _: Vec3) -> Vec3 {
        self.normal()
    }

    /// From the barycentric coordinates, far more exact than from `t` (Pharr,
    /// Jakob and Humphreys, *Physically Based Rendering*, section 6.8.5), with
    /// the kernel's own displacement added to the error.
    fn hit_point(&self, _: &PreparedRay, hit: &Hit) -> (Vec3, Vec3) {
        let (u, v) = (f64::from(hit.u), f64::from(hit.v));
        let corners = self.vertices().map(Vec3::as_dvec3);
        let [a, b, c] = [corners[0] * (1.0 - u - v), corners[1] * u, corners[2] * v];
        let kernel = 8.0 * f64::from(rounding::UNIT_ROUNDOFF) * self.bounds().largest_extent();
        let evaluation = (a.abs() + b.abs() + c.abs()) * f64::from(rounding::gamma(2));
        (
            (a + b + c).as_vec3(),
            rounding::vec3_up(evaluation + kernel),
        )
    }
}

impl Clip for Triangle {
    fn clip(&self, cell: &Aabb) -> Option<DAabb> {
        clip_polygon(&self.vertices(), cell)
    }

    fn chop(&self, cell: &Aabb, axis: Axis, planes: &[f32], parts: &mut [GrowingBox]) {
        if cell.contains(&self.bounds()) {
            return chop_polygon(self.vertices(), axis, planes, parts);
        }
        let corners = clip_polygon_corners(&self.vertices(), &DAabb::from(*cell));
        chop_polygon(
            corners.iter().map(|corner| corner.as_vec3()),
            axis,
            planes,
            parts,
        );
    }
}

impl Polygonal for Triangle {
    fn vertices(&self) -> impl Iterator<Item = Vec3> {
        Self::vertices(self).into_iter()
    }

    fn is_convex_polygon(&self) -> bool {
        true
    }

    fn candidate_planes(&self) -> impl Iterator<Item = Plane> {
        let normal = self.normal();
        let edges = [(self.a, self.b), (self.b, self.c), (self.c, self.a)];
        let edge_planes = edges.map(|(from, to)| (from, edge_normal(from, to, normal)));
        std::iter::once((self.a, normal))
            .chain(edge_planes)
            .filter(|(_, normal)| *normal != Vec3::ZERO)
            .map(|(point, normal)| Plane::through(point, normal))
    }
}

/// The unit normal of the plane through an edge, orthogonal to the face; zero
/// where the edge has no length.
pub(super) fn edge_normal(from: Vec3, to: Vec3, face_normal: Vec3) -> Vec3 {
    let edge = to.as_dvec3() - from.as_dvec3();
    edge.cross(face_normal.as_dvec3())
        .normalize_or_zero()
        .as_vec3()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn right_triangle() -> Triangle {
        Triangle::new([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    }

    #[test]
    fn the_front_is_where_corners_run_counter_clockwise() {
        assert_eq!(right_triangle().normal(), Vec3::Z);
        assert_eq!(right_triangle().area(), 0.5);
    }

    #[test]
    fn a_triangle_without_area_has_no_normal_and_no_candidate_planes() {
        let line = Triangle::new([0.0; 3], [1.0; 3], [2.0; 3]);
        assert_eq!(line.normal(), Vec3::ZERO);
        assert_eq!(line.candidate_planes().count(), 0);
    }

    #[test]
    fn candidate_planes_are_the_face_and_three_edges_with_the_triangle_on_one_side() {
        let triangle = right_triangle();
        let planes: Vec<Plane> = triangle.candidate_planes().collect();
        assert_eq!(planes.len(), 4);
        assert_eq!(triangle.side_of(&planes[0], 1e-6), Side::Planar);
        for edge in &planes[1..] {
            assert_eq!(triangle.side_of(edge, 1e-6), Side::Back);
        }
    }

    #[test]
    fn normals_and_areas_survive_extreme_scales() {
        for scale in [1e-30_f32, 1e30] {
            let triangle = Triangle::new([0.0; 3], [scale, 0.0, 0.0], [0.0, scale, 0.0]);
            assert_eq!(triangle.normal(), Vec3::Z);
            assert!(triangle.area() > 0.0 && triangle.area().is_finite());
        }
    }

    use crate::geometry::Side;
}
