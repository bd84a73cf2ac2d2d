//! What a structure is built over.

mod mesh;
mod quad;
mod sphere;
mod surface;
mod triangle;
pub(crate) mod watertight;

use glam::Vec3;

use crate::geometry::{Aabb, Axis, DAabb, GrowingBox, Plane, Side};
use crate::layout::LeafStorage;
use crate::query::Hit;
use crate::ray::packet::lanes_of;
use crate::ray::{PacketVector, PreparedRay};
use crate::simd::Lanes;

pub use mesh::{MeshError, triangles_of_mesh};
pub use quad::Quad;
pub use sphere::Sphere;
pub use surface::{Face, SurfacePoint};
pub use triangle::Triangle;

/// Where a ray meets a primitive, before the shared leaf loop has gated it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// The ray parameter, in lengths of the ray's direction.
    pub t: f32,
    /// First surface coordinate.
    pub u: f32,
    /// Second surface coordinate.
    pub v: f32,
}

/// Where the rays of a vector meet a primitive.
#[derive(Clone, Copy, Debug)]
pub struct LaneIntersections<L> {
    /// The rays that meet it, a bit per lane, the first lane lowest.
    pub mask: u32,
    /// See [`Intersection::t`]; of no meaning outside `mask`.
    pub t: L,
    /// See [`Intersection::u`].
    pub u: L,
    /// See [`Intersection::v`].
    pub v: L,
}

impl<L: Lanes> LaneIntersections<L> {
    /// No ray meets it.
    #[inline(always)]
    pub fn none() -> Self {
        let zero = L::splat(0.0);
        Self {
            mask: 0,
            t: zero,
            u: zero,
            v: zero,
        }
    }

    /// That of one ray.
    #[inline]
    pub fn get(&self, lane: usize) -> Option<Intersection> {
        (self.mask >> lane & 1 == 1).then(|| Intersection {
            t: self.t.lanes()[lane],
            u: self.u.lanes()[lane],
            v: self.v.lanes()[lane],
        })
    }

    #[inline]
    fn set(&mut self, lane: usize, intersection: Intersection) {
        self.mask |= 1 << lane;
        self.t.lanes_mut()[lane] = intersection.t;
        self.u.lanes_mut()[lane] = intersection.u;
        self.v.lanes_mut()[lane] = intersection.v;
    }
}

/// What [`Primitive::intersect_packet`] does by default.
#[inline(always)]
pub(crate) fn intersect_one_by_one<P: Primitive, L: Lanes>(
    primitive: &P,
    rays: &PacketVector<'_, L>,
    mask: u32,
) -> LaneIntersections<L> {
    let mut found = LaneIntersections::none();
    for lane in lanes_of(mask) {
        let intersection = rays.ray(lane).and_then(|ray| primitive.intersect(ray));
        if let Some(intersection) = intersection {
            found.set(lane, intersection);
        }
    }
    found
}

/// Anything that a ray can hit: implement it to build every structure over a
/// type of your own.
///
/// Whether and where a ray hits must be a function of the ray and the primitive
/// alone, and the same at every call: then every structure gives the same
/// answers. See the [crate] documentation for an example.
pub trait Primitive: Clone + Send + Sync {
    /// How leaves hold primitives of this type. Copies in leaf order,
    /// [`LeafOrdered<Self>`](crate::layout::LeafOrdered), suit small types;
    /// [`Indexed<Self>`](crate::layout::Indexed) keeps one copy of each
    /// primitive and suits large ones.
    type Storage: LeafStorage<Self>;

    /// The smallest box around the primitive, or one that is not
    /// [valid](Aabb::is_valid) if it has none: such a primitive is invalid and
    /// is rejected or skipped, as the builder is told.
    fn bounds(&self) -> Aabb;

    /// The first intersection with `t >= ray.t_min()`, if there is any. A
    /// result with a NaN or infinite `t`, `u` or `v` counts as a miss.
    fn intersect(&self, ray: &PreparedRay) -> Option<Intersection>;

    /// [`intersect`](Self::intersect) for the rays of a vector that are in
    /// `mask`, with the same results bit for bit.
    ///
    /// The default takes ray by ray. An override makes packets fast; it must be
    /// `#[inline(always)]`, so that it uses the vectors of the machine.
    #[inline(always)]
    fn intersect_packet<L: Lanes>(
        &self,
        rays: &PacketVector<'_, L>,
        mask: u32,
    ) -> LaneIntersections<L> {
        intersect_one_by_one(self, rays, mask)
    }

    /// The unit vector orthogonal to the surface at `point`, where `hit` lies,
    /// towards its front; zero where there is none.
    fn geometric_normal(&self, hit: &Hit, point: Vec3) -> Vec3;

    /// The point of a hit and how far each coordinate may be off: the exact
    /// surface is within the error of the point.
    fn hit_point(&self, ray: &PreparedRay, hit: &Hit) -> (Vec3, Vec3) {
        surface::point_along(ray, hit.t, &self.bounds())
    }
}

/// A primitive whose part inside a box can be bounded: needed by structures
/// that split references (SBVH, kd-tree).
pub trait Clip: Primitive {
    /// Bounds, in double precision and without any pad, of the part of the
    /// primitive inside `cell`; `None` if no part is inside.
    ///
    /// The default, the common part of both boxes, is right for every type; a
    /// tighter answer makes better trees.
    fn clip(&self, cell: &Aabb) -> Option<DAabb> {
        let common = self.bounds().intersection(cell);
        (!common.is_empty()).then(|| common.into())
    }

    /// Grows each of `parts` to enclose the part of the primitive inside `cell`
    /// and between two planes orthogonal to `axis`: `parts[i]` lies between
    /// `planes[i]` and `planes[i + 1]`, and the planes ascend.
    ///
    /// Serves to estimate costs, so rounding may go either way. The default
    /// clips once a part; an override may share work between the parts.
    fn chop(&self, cell: &Aabb, axis: Axis, planes: &[f32], parts: &mut [GrowingBox]) {
        for (slab, part) in planes.windows(2).zip(parts) {
            let slab_cell = cell.with_range(axis, slab[0], slab[1]);
            if let Some(bounds) = self.clip(&slab_cell) {
                part.add(&bounds.rounded_outward());
            }
        }
    }
}

/// A primitive that planes of any orientation can classify: needed by the BSP
/// tree.
pub trait Polygonal: Primitive {
    /// The corners of a convex hull that contains the primitive: for a convex
    /// polygon its corners in order.
    fn vertices(&self) -> impl Iterator<Item = Vec3>;

    /// Whether the primitive is the convex polygon of its vertices, as far as
    /// single precision tells. Only then may a part of it be cut out by cutting
    /// the polygon, and a point of its plane between its edges be taken for a
    /// point of it.
    ///
    /// The default, no, is right for every type; a polygon that says yes makes
    /// better trees.
    fn is_convex_polygon(&self) -> bool {
        false
    }

    /// Planes worth splitting a cell by that follow from this primitive alone,
    /// besides those tangent to its box. For a triangle: its face plane and the
    /// three planes through its edges orthogonal to it (Ize, Wald and Parker
    /// 2008, section 3.4).
    fn candidate_planes(&self) -> impl Iterator<Item = Plane>;

    /// The smallest and largest signed distance of the primitive's points from
    /// `plane`.
    fn signed_range(&self, plane: &Plane) -> (f64, f64) {
        let unbounded = (f64::INFINITY, f64::NEG_INFINITY);
        self.vertices()
            .map(|vertex| plane.signed_distance(vertex))
            .fold(unbounded, |(low, high), s| (low.min(s), high.max(s)))
    }

    /// On which side of `plane` the primitive lies, within `epsilon`.
    fn side_of(&self, plane: &Plane, epsilon: f64) -> Side {
        let (smallest, largest) = self.signed_range(plane);
        Side::of_range(smallest, largest, epsilon)
    }
}
