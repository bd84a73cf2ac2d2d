//! The one kernel that decides whether a ray hits a triangle.
//!
//! Source: Woop, Benthin and Wald, *Watertight Ray/Triangle Intersection*,
//! JCGT 2013. The vertices are moved to the ray's origin and sheared until the
//! ray runs along its main axis; then three two-dimensional edge functions say
//! on which side of each edge it passes.
//!
//! Three things differ from the paper:
//! - An edge function that comes out zero or not finite in single precision is
//!   decided in double precision *from the same sheared coordinates*, so that
//!   the neighbour across the edge, which sees the same numbers, agrees.
//! - `t`, `u` and `v` are computed in double precision and rounded once: in
//!   single precision `t` is wrong by whole percents on slivers.
//! - No fused multiply-add: it would break the antisymmetry between the two
//!   triangles at an edge.

use glam::Vec3;

use super::{Intersection, LaneIntersections};
use crate::geometry::Axis;
use crate::ray::packet::{RayLanes, SharedFacts};
use crate::ray::{PreparedRay, Shear};
use crate::simd::{Doubles, Lanes};

/// Where `ray` meets the triangle, edges and corners included.
#[inline]
pub(crate) fn intersect(ray: &PreparedRay, vertices: [Vec3; 3]) -> Option<Intersection> {
    let shear = ray.shear();
    let vertices = vertices.map(|vertex| Sheared::new(vertex - ray.origin(), shear));
    let edges = edge_functions(vertices.map(|vertex| (vertex.x, vertex.y)));
    if has_both_signs(edges) {
        return None;
    }
    finish(vertices, shear.along)
}

/// A vertex relative to the ray's origin, sheared onto the ray's main axis.
#[derive(Clone, Copy)]
struct Sheared {
    x: f32,
    y: f32,
    /// Along the main axis, not scaled.
    z: f32,
}

impl Sheared {
    #[inline]
    fn new(relative: Vec3, shear: &Shear) -> Self {
        let rotated = shear.axis.rotate_last(relative);
        Self {
            x: rotated.x - shear.x * rotated.z,
            y: rotated.y - shear.y * rotated.z,
            z: rotated.z,
        }
    }
}

/// Twice the signed areas of the triangles that the ray makes with the edges
/// opposite to the first, second and third vertex.
#[inline(always)]
fn edge_functions<T>([a, b, c]: [(T, T); 3]) -> [T; 3]
where
    T: Copy + std::ops::Mul<Output = T> + std::ops::Sub<Output = T>,
{
    [
        c.0 * b.1 - c.1 * b.0,
        a.0 * c.1 - a.1 * c.0,
        b.0 * a.1 - b.1 * a.0,
    ]
}

/// Whether the ray certainly passes outside. Rounding can make an edge function
/// zero but never flips its sign, so this needs no second look.
#[inline]
fn has_both_signs(edges: [f32; 3]) -> bool {
    let negative = edges[0] < 0.0 || edges[1] < 0.0 || edges[2] < 0.0;
    let positive = edges[0] > 0.0 || edges[1] > 0.0 || edges[2] > 0.0;
    negative && positive
}

/// Decides in double precision and computes the hit. Products of two `f32` are
/// exact in `f64`, so the signs here are the signs of exact arithmetic on the
/// sheared coordinates.
fn finish(vertices: [Sheared; 3], along: f32) -> Option<Intersection> {
    let edges = edge_functions(vertices.map(|vertex| (f64::from(vertex.x), f64::from(vertex.y))));
    let [u, v, w] = edges;
    // Without branches, since triangles face either way.
    let front = (u >= 0.0) & (v >= 0.0) & (w >= 0.0);
    let back = (u <= 0.0) & (v <= 0.0) & (w <= 0.0);
    let determinant = u + v + w;
    if !(front | back) || determinant == 0.0 {
        return None;
    }
    let [a, b, c] = vertices.map(|vertex| f64::from(vertex.z));
    // One division; what it costs in accuracy is far below a rounding to f32.
    let along = f64::from(along);
    let reciprocal = 1.0 / (determinant * along);
    Some(Intersection {
        t: ((u * a + v * b + w * c) * reciprocal) as f32,
        u: (v * along * reciprocal) as f32,
        v: (w * along * reciprocal) as f32,
    })
}

/// The kernel's test of one ray against many triangles at once, as far as it
/// can reject: lanes that it keeps are decided by [`intersect`].
#[derive(Clone, Copy)]
pub(crate) struct LaneTest {
    origin: [f32; 3],
    shear: [f32; 2],
    /// Which coordinate plays x, y and z after the shear.
    axes: [usize; 3],
}

/// Triangles side by side, sheared as the kernel does it.
pub(crate) struct ShearedLanes<L> {
    /// Corner; x, y and along the main axis.
    corners: [[L; 3]; 3],
}

impl<L: Lanes> ShearedLanes<L> {
    /// Decides one lane, as [`intersect`] does.
    #[inline]
    pub(crate) fn decide(&self, lane: usize, ray: &PreparedRay) -> Option<Intersection> {
        let corner = |corner: &[L; 3]| Sheared {
            x: corner[0].lanes()[lane],
            y: corner[1].lanes()[lane],
            z: corner[2].lanes()[lane],
        };
        let [a, b, c] = &self.corners;
        finish([corner(a), corner(b), corner(c)], ray.shear().along)
    }
}

impl LaneTest {
    /// The constants of `ray`.
    #[inline]
    pub(crate) fn new(ray: &PreparedRay) -> Self {
        let shear = ray.shear();
        let last = shear.axis.index();
        let axes = [(last + 1) % 3, (last + 2) % 3, last];
        let origin = ray.origin().to_array();
        Self {
            origin: axes.map(|axis| origin[axis]),
            shear: [shear.x, shear.y],
            axes,
        }
    }

    /// A bit per lane: clear where the ray certainly misses. `vertices` holds
    /// corner, coordinate, lane.
    #[inline(always)]
    pub(crate) fn candidates<const LANES: usize>(&self, vertices: &[[[f32; LANES]; 3]; 3]) -> u32 {
        let [ax, ay] = self.sheared(&vertices[0]);
        let [bx, by] = self.sheared(&vertices[1]);
        let [cx, cy] = self.sheared(&vertices[2]);
        let mut mask = 0;
        for lane in 0..LANES {
            let edges = edge_functions([
                (ax[lane], ay[lane]),
                (bx[lane], by[lane]),
                (cx[lane], cy[lane]),
            ]);
            // Without short circuits, so that all lanes go at once.
            let negative = (edges[0] < 0.0) | (edges[1] < 0.0) | (edges[2] < 0.0);
            let positive = (edges[0] > 0.0) | (edges[1] > 0.0) | (edges[2] > 0.0);
            mask |= u32::from(!(negative & positive)) << lane;
        }
        mask
    }

    /// As [`candidates`](Self::candidates), in a vector; yields what
    /// [`ShearedLanes::decide`] wants to know of the lanes as well.
    #[inline(always)]
    pub(crate) fn sheared_lanes<L: Lanes, const LANES: usize>(
        &self,
        vertices: &[[[f32; LANES]; 3]; 3],
    ) -> (u32, ShearedLanes<L>) {
        let [x, y, z] = self.axes;
        let origin = [
            L::splat(self.origin[0]),
            L::splat(self.origin[1]),
            L::splat(self.origin[2]),
        ];
        let shear = [L::splat(self.shear[0]), L::splat(self.shear[1])];
        let zero = L::splat(0.0);
        let mut corners = [[zero; 3]; 3];
        for (corner, vertex) in corners.iter_mut().zip(vertices) {
            let along = L::from_slice(&vertex[z]) - origin[2];
            *corner = [
                (L::from_slice(&vertex[x]) - origin[0]) - shear[0] * along,
                (L::from_slice(&vertex[y]) - origin[1]) - shear[1] * along,
                along,
            ];
        }
        let [a, b, c] = corners;
        let edges = edge_functions([(a[0], a[1]), (b[0], b[1]), (c[0], c[1])]);
        (L::ALL & !both_signs_mask(edges), ShearedLanes { corners })
    }

    #[inline(always)]
    fn sheared<const LANES: usize>(&self, vertex: &[[f32; LANES]; 3]) -> [[f32; LANES]; 2] {
        let [x, y, z] = self.axes.map(|axis| &vertex[axis]);
        let mut sheared = [[0.0; LANES]; 2];
        for lane in 0..LANES {
            let z = z[lane] - self.origin[2];
            sheared[0][lane] = (x[lane] - self.origin[0]) - self.shear[0] * z;
            sheared[1][lane] = (y[lane] - self.origin[1]) - self.shear[1] * z;
        }
        sheared
    }
}

/// [`intersect`] for the rays of a vector that are in `mask`: the same
/// operations in the same order, lane by lane, so the same bits. None where rays
/// differ in their main axis.
#[inline(always)]
pub(crate) fn intersect_lanes<L: Lanes>(
    rays: &RayLanes<L>,
    shared: &SharedFacts,
    mask: u32,
    vertices: [Vec3; 3],
) -> Option<LaneIntersections<L>> {
    match shared.shear_axis? {
        Axis::X => Some(intersect_along::<L, 0>(rays, mask, vertices)),
        Axis::Y => Some(intersect_along::<L, 1>(rays, mask, vertices)),
        Axis::Z => Some(intersect_along::<L, 2>(rays, mask, vertices)),
    }
}

#[inline(always)]
fn intersect_along<L: Lanes, const MAIN: usize>(
    rays: &RayLanes<L>,
    mask: u32,
    [a, b, c]: [Vec3; 3],
) -> LaneIntersections<L> {
    let vertices = [
        sheared_lanes::<L, MAIN>(rays, a),
        sheared_lanes::<L, MAIN>(rays, b),
        sheared_lanes::<L, MAIN>(rays, c),
    ];
    let mask = mask & !both_signs_mask(edge_functions(vertices));
    if mask == 0 {
        return LaneIntersections::none();
    }
    let along = [
        L::splat(a[MAIN]) - rays.origin[MAIN],
        L::splat(b[MAIN]) - rays.origin[MAIN],
        L::splat(c[MAIN]) - rays.origin[MAIN],
    ];
    finish_lanes(vertices, along, rays.along, mask)
}

/// [`has_both_signs`] lane by lane.
#[inline(always)]
fn both_signs_mask<L: Lanes>([u, v, w]: [L; 3]) -> u32 {
    // An edge function that is NaN has no sign.
    let zero = L::splat(0.0);
    let smallest = zero.min_or_keep(u).min_or_keep(v).min_or_keep(w);
    let largest = zero.max_or_keep(u).max_or_keep(v).max_or_keep(w);
    smallest.lt_mask(zero) & zero.lt_mask(largest)
}

/// [`finish`] lane by lane.
#[inline(always)]
fn finish_lanes<L: Lanes>(
    [a, b, c]: [(L, L); 3],
    [a_along, b_along, c_along]: [L; 3],
    along: L,
    mask: u32,
) -> LaneIntersections<L> {
    let [u, v, w] = edge_functions([
        (a.0.to_doubles(), a.1.to_doubles()),
        (b.0.to_doubles(), b.1.to_doubles()),
        (c.0.to_doubles(), c.1.to_doubles()),
    ]);
    let zero = L::Doubles::splat(0.0);
    let positive = zero.le_mask(u) & zero.le_mask(v) & zero.le_mask(w);
    let negative = u.le_mask(zero) & v.le_mask(zero) & w.le_mask(zero);
    let determinant = u + v + w;
    let is_zero = determinant.le_mask(zero) & zero.le_mask(determinant);
    let along = along.to_doubles();
    let reciprocal = L::Doubles::splat(1.0) / (determinant * along);
    let t = u * a_along.to_doubles() + v * b_along.to_doubles() + w * c_along.to_doubles();
    LaneIntersections {
        mask: mask & (positive | negative) & !is_zero,
        t: L::from_doubles(t * reciprocal),
        u: L::from_doubles(v * along * reciprocal),
        v: L::from_doubles(w * along * reciprocal),
    }
}

/// What [`Sheared::new`] computes, across the main axis.
#[inline(always)]
fn sheared_lanes<L: Lanes, const MAIN: usize>(rays: &RayLanes<L>, vertex: Vec3) -> (L, L) {
    let (x, y) = ((MAIN + 1) % 3, (MAIN + 2) % 3);
    let along = L::splat(vertex[MAIN]) - rays.origin[MAIN];
    (
        (L::splat(vertex[x]) - rays.origin[x]) - rays.shear[0] * along,
        (L::splat(vertex[y]) - rays.origin[y]) - rays.shear[1] * along,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triangle;
    use crate::ray::{PacketRay, RayPacket, RaySegment};
    use crate::simd::F32x4;
    use crate::testing::{families, rays};

    fn hit(origin: [f32; 3], direction: [f32; 3], vertices: [[f32; 3]; 3]) -> Option<Intersection> {
        let ray = PreparedRay::new(&RaySegment::new(origin, direction))?;
        intersect(&ray, vertices.map(Vec3::from))
    }

    const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]];

    #[test]
    fn coordinates_are_those_of_the_second_and_third_corner() {
        let found = hit([0.25, 0.5, 0.0], [0.0, 0.0, 1.0], TRIANGLE).unwrap();
        assert_eq!((found.t, found.u, found.v), (2.0, 0.25, 0.5));
        let behind = hit([0.25, 0.5, 4.0], [0.0, 0.0, 1.0], TRIANGLE).unwrap();
        assert_eq!(behind.t, -2.0);
    }

    #[test]
    fn corners_and_edges_belong_to_the_triangle() {
        for [x, y] in [
            [0.0, 0.0],
            [1.0, 0.0],
            [0.0, 1.0],
            [0.5, 0.5],
            [0.5, 0.0],
            [0.0, 0.5],
        ] {
            assert!(
                hit([x, y, 0.0], [0.0, 0.0, 1.0], TRIANGLE).is_some(),
                "{x} {y}"
            );
        }
        assert!(hit([0.5, 0.500_001, 0.0], [0.0, 0.0, 1.0], TRIANGLE).is_none());
    }

    #[test]
    fn a_triangle_seen_edge_on_or_without_area_is_missed() {
        assert!(hit([-1.0, 0.2, 2.0], [1.0, 0.0, 0.0], TRIANGLE).is_none());
        let line = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [2.0, 0.0, 1.0]];
        assert!(hit([1.0, 0.0, 0.0], [0.0, 0.0, 1.0], line).is_none());
    }

    #[test]
    fn a_nan_corner_is_a_miss() {
        let mut vertices = TRIANGLE;
        vertices[1][2] = f32::NAN;
        vertices[1][0] = f32::NAN;
        assert!(hit([0.25, 0.25, 0.0], [0.0, 0.0, 1.0], vertices).is_none());
    }

    #[test]
    fn the_lane_test_keeps_every_hit_and_rejects_plain_misses() {
        let ray = RaySegment::new([0.25, 0.25, 0.0], [0.0, 0.0, 1.0]);
        let test = LaneTest::new(&PreparedRay::new(&ray).unwrap());
        let mut vertices = [[[0.0_f32; 8]; 3]; 3];
        for (corner, position) in TRIANGLE.iter().enumerate() {
            for (coordinate, lanes) in vertices[corner].iter_mut().enumerate() {
                for (lane, value) in lanes.iter_mut().enumerate() {
                    let shift = if coordinate == 0 {
                        lane as f32 * 10.0
                    } else {
                        0.0
                    };
                    *value = position[coordinate] + shift;
                }
            }
        }
        vertices[1][0][5] = f32::NAN;
        assert_eq!(test.candidates(&vertices) & 0b1101_1111, 1);
    }

    #[test]
    fn lanes_meet_triangles_as_single_rays_do_bit_for_bit() {
        let scene = families::find("axis-grid").unwrap().scene(1, 300);
        let rays: Vec<_> = rays::mixed(&scene, 7, 400)
            .iter()
            .map(PacketRay::new)
            .collect();
        let mut met = 0;
        for rays in rays.chunks(4) {
            let packet = RayPacket::<F32x4, 1>::new(rays, |_| 1.0).unwrap();
            for vertices in scene.iter().map(Triangle::vertices) {
                let found = intersect_lanes(packet.lanes(0), packet.shared(), 0b1111, vertices);
                let Some(found) = found else { continue };
                for (lane, ray) in rays.iter().enumerate() {
                    let expected = intersect(ray.prepared().unwrap(), vertices);
                    let bits = |found: Intersection| [found.t, found.u, found.v].map(f32::to_bits);
                    assert_eq!(found.get(lane).map(bits), expected.map(bits), "{ray:?}");
                    met += usize::from(expected.is_some());
                }
            }
        }
        assert!(met > 100, "{met}");
    }
}
