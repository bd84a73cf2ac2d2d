//! The quad: a polygon that structures need not know from a triangle.

use glam::{DVec3, Vec3};

use super::triangle::edge_normal;
use super::{Clip, Intersection, Polygonal, Primitive, Triangle, watertight};
use crate::geometry::{Aabb, Axis, DAabb, GrowingBox, Plane};
use crate::layout::LeafOrdered;
use crate::query::Hit;
use crate::ray::PreparedRay;

/// Corners further than this from a plane, relative to the extent, are not on it:
/// a fourth of what structures allow the kernel to move a hit.
const PLANARITY: f64 = 1.0 / (1 << 22) as f64;

/// A quad with corners `a`, `b`, `c`, `d` in order, convex and flat as a rule. Any
/// other is the two triangles `a`, `b`, `c` and `a`, `c`, `d`, and so is this one
/// for rays.
///
/// Coordinates `u`, `v` are (0, 0) at `a`, (1, 0) at `b`, (1, 1) at `c` and (0, 1)
/// at `d`, linear in each triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quad {
    /// First corner.
    pub a: Vec3,
    /// Second corner, where `u` is 1 and `v` is 0.
    pub b: Vec3,
    /// Third corner, where both are 1.
    pub c: Vec3,
    /// Fourth corner, where `u` is 0 and `v` is 1.
    pub d: Vec3,
}

impl Quad {
    /// A quad of four corners; counter-clockwise seen from its front.
    pub fn new(
        a: impl Into<Vec3>,
        b: impl Into<Vec3>,
        c: impl Into<Vec3>,
        d: impl Into<Vec3>,
    ) -> Self {
        Self {
            a: a.into(),
            b: b.into(),
            c: c.into(),
            d: d.into(),
        }
    }

    /// The corners in order.
    pub fn vertices(&self) -> [Vec3; 4] {
        [self.a, self.b, self.c, self.d]
    }

    /// The triangles that it consists of.
    pub fn triangles(&self) -> [Triangle; 2] {
        let [a, b, c, d] = self.vertices();
        [Triangle { a, b, c }, Triangle { a, b: c, c: d }]
    }

    /// The unit normal towards the front, the mean of the triangles' by area; zero
    /// if there is none.
    pub fn normal(&self) -> Vec3 {
        self.normal_in_double().as_vec3()
    }

    fn normal_in_double(&self) -> DVec3 {
        let [a, b, c, d] = self.vertices().map(Vec3::as_dvec3);
        (c - a).cross(d - b).normalize_or_zero()
    }

    fn is_flat(&self) -> bool {
        let normal = self.normal_in_double();
        let limit = PLANARITY * self.bounds().largest_extent();
        let height = |corner: Vec3| normal.dot(corner.as_dvec3() - self.a.as_dvec3());
        self.vertices()
            .into_iter()
            .all(|corner| height(corner).abs() <= limit)
    }

    fn turns_one_way(&self) -> bool {
        let normal = self.normal_in_double();
        let corners = self.vertices().map(Vec3::as_dvec3);
        let edge = |index: usize| corners[(index + 1) % 4] - corners[index % 4];
        normal != DVec3::ZERO
            && (0..4).all(|index| edge(index).cross(edge(index + 1)).dot(normal) >= 0.0)
    }

    /// The triangle that a hit with these coordinates lies in, and the hit's
    /// coordinates there.
    fn triangle_of(&self, hit: &Hit) -> (Triangle, Hit) {
        let [first, second] = self.triangles();
        let of = |u, v| Hit { u, v, ..*hit };
        if hit.u >= hit.v {
            (first, of(hit.u - hit.v, hit.v))
        } else {
            (second, of(hit.u, hit.v - hit.u))
        }
    }
}

impl Primitive for Quad {
    type Storage = LeafOrdered<Self>;

    #[inline]
    fn bounds(&self) -> Aabb {
        Aabb::around(&self.vertices())
    }

    /// Of both triangles' intersections, on the common edge or where the quad is
    /// not flat, the first past `t_min`; of those before it the last, which the
    /// clamp to the quad's box may move there.
    #[inline]
    fn intersect(&self, ray: &PreparedRay) -> Option<Intersection> {
        let Self { a, b, c, d } = *self;
        let first = watertight::intersect(ray, [a, b, c]).map(|found| Intersection {
            u: (found.u + found.v).min(1.0),
            ..found
        });
        let second = watertight::intersect(ray, [a, c, d]).map(|found| Intersection {
            v: (found.u + found.v).min(1.0),
            ..found
        });
        let (Some(first), Some(second)) = (first, second) else {
            return first.or(second);
        };
        let (nearer, farther) = if first.t <= second.t {
            (first, second)
        } else {
            (second, first)
        };
        Some(if nearer.t >= ray.t_min() {
            nearer
        } else {
            farther
        })
    }

    fn geometric_normal(&self, hit: &Hit, _: Vec3) -> Vec3 {
        self.triangle_of(hit).0.normal()
    }

    fn hit_point(&self, ray: &PreparedRay, hit: &Hit) -> (Vec3, Vec3) {
        let (triangle, hit) = self.triangle_of(hit);
        triangle.hit_point(ray, &hit)
    }
}

impl Clip for Quad {
    fn clip(&self, cell: &Aabb) -> Option<DAabb> {
        let clipped = self.triangles().map(|triangle| triangle.clip(cell));
        let corners = clipped
            .iter()
            .flatten()
            .flat_map(|part| [part.min, part.max]);
        DAabb::around(&Vec::from_iter(corners))
    }

    fn chop(&self, cell: &Aabb, axis: Axis, planes: &[f32], parts: &mut [GrowingBox]) {
        for triangle in self.triangles() {
            triangle.chop(cell, axis, planes, parts);
        }
    }
}

impl Polygonal for Quad {
    fn vertices(&self) -> impl Iterator<Item = Vec3> {
        Self::vertices(self).into_iter()
    }

    fn is_convex_polygon(&self) -> bool {
        self.is_flat() && self.turns_one_way()
    }

    /// The face and the planes through the four edges orthogonal to it.
    fn candidate_planes(&self) -> impl Iterator<Item = Plane> {
        let normal = self.normal();
        let [a, b, c, d] = Self::vertices(self);
        let edges = [(a, b), (b, c), (c, d), (d, a)];
        let edge_planes = edges.map(|(from, to)| (from, edge_normal(from, to, normal)));
        std::iter::once((a, normal))
            .chain(edge_planes)
            .filter(|(_, normal)| *normal != Vec3::ZERO)
            .map(|(point, normal)| Plane::through(point, normal))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Side;
    use crate::ray::RaySegment;

    fn unit_square() -> Quad {
        Quad::new([0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0])
    }

    fn hit(quad: &Quad, [x, y]: [f32; 2], t_min: f32) -> Option<Intersection> {
        let ray = RaySegment::new([x, y, -2.0], [0.0, 0.0, 1.0]);
        let ray = ray.with_interval(t_min, f32::INFINITY);
        quad.intersect(&PreparedRay::new(&ray).unwrap())
    }

    #[test]
    fn coordinates_are_those_of_the_square() {
        for [x, y] in [[0.25, 0.5], [0.5, 0.25], [0.5, 0.5], [1.0, 0.0], [0.0, 1.0]] {
            let found = hit(&unit_square(), [x, y], 0.0).unwrap();
            assert_eq!((found.t, found.u, found.v), (2.0, x, y));
        }
        assert_eq!(hit(&unit_square(), [1.5, 0.5], 0.0), None);
    }

    #[test]
    fn the_surface_point_of_a_hit_is_where_the_ray_was() {
        let quad = Quad::new([0.0; 3], [2.0, 0.0, 0.0], [3.0, 1.0, 0.0], [0.0, 2.0, 0.0]);
        for [x, y] in [[0.5, 0.25], [1.5, 0.25], [0.25, 1.5], [1.0, 1.0]] {
            let ray = PreparedRay::new(&RaySegment::new([x, y, -2.0], [0.0, 0.0, 1.0])).unwrap();
            let Intersection { t, u, v } = quad.intersect(&ray).unwrap();
            let (point, error) = quad.hit_point(&ray, &Hit { t, u, v, id: 0 });
            let off = (point - Vec3::new(x, y, 0.0)).abs();
            assert!(off.cmple(error).all(), "{off} {error}");
        }
    }

    #[test]
    fn the_first_of_two_hits_past_t_min_counts() {
        let folded = Quad::new([0.0; 3], [1.0, 0.0, 1.0], [1.0, 1.0, 0.0], [1.0, 0.0, 3.0]);
        let ts = [0.0, 2.6, 9.0].map(|t_min| hit(&folded, [0.75, 0.25], t_min).map(|hit| hit.t));
        assert_eq!(ts, [Some(2.5), Some(3.5), Some(3.5)]);
    }

    #[test]
    fn only_flat_quads_that_turn_one_way_are_polygons() {
        assert!(unit_square().is_convex_polygon());
        let with_last = |d: [f32; 3]| Quad {
            d: d.into(),
            ..unit_square()
        };
        assert!(!with_last([0.0, 1.0, 0.01]).is_convex_polygon());
        assert!(!with_last([0.9, 0.2, 0.0]).is_convex_polygon());
        assert!(!with_last([2.0, 0.5, 0.0]).is_convex_polygon());
        let line = Quad::new([0.0; 3], [1.0; 3], [2.0; 3], [3.0; 3]);
        assert!(!line.is_convex_polygon());
    }

    #[test]
    fn candidate_planes_are_the_face_and_four_edges_with_the_quad_on_one_side() {
        let planes: Vec<Plane> = unit_square().candidate_planes().collect();
        let sides = planes
            .iter()
            .map(|plane| unit_square().side_of(plane, 1e-6));
        let sides: Vec<Side> = sides.collect();
        assert_eq!(sides[0], Side::Planar);
        assert_eq!(sides[1..], [Side::Back; 4]);
    }

    #[test]
    fn clipping_and_chopping_cover_both_triangles() {
        let cell = Aabb::new([0.5, 0.25, -1.0], [2.0, 2.0, 1.0]);
        let clipped = unit_square().clip(&cell).unwrap();
        assert_eq!((clipped.min.x, clipped.min.y), (0.5, 0.25));
        assert_eq!((clipped.max.x, clipped.max.y), (1.0, 1.0));
        assert!(unit_square().clip(&Aabb::new([2.0; 3], [3.0; 3])).is_none());
    }
}
