//! The parts of primitives inside a cell, and how a plane divides them.
//!
//! What keeps hits: let `p` be an accepted hit and `q` the exact point of the
//! primitive that it stands for, so that `p` is off by the ray's rounding and by
//! at most the primitive's *pad*. At every node a child holds a piece with `q` in
//! it, and `p` lies within the plane's slack of that child, rounding aside, which
//! the traversal adds. So errors do not accumulate from level to level.

use accel_core::Polygonal;
use accel_core::geometry::Side;
use accel_core::glam::{DVec3, Vec3};
use accel_core::reference::Reference;

use crate::cells::Ancestor;
use crate::split_plane::SplitPlane;

/// How far the kernel may move a hit off the primitive, relative to the
/// primitive's extent.
const RELATIVE_PAD: f64 = 1.0 / (1 << 20) as f64;

/// Convex polygons, each the part of a primitive inside a cell, and hulls of
/// primitives that are not polygons.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pieces {
    ids: Vec<u32>,
    pads: Vec<f64>,
    /// Whether the corners are those of a polygon in order, which can be
    /// clipped; a hull of anything else stays whole.
    are_polygons: Vec<bool>,
    /// Where the corners of each piece begin; one more at the end.
    starts: Vec<u32>,
    corners: Vec<DVec3>,
}

/// How many pieces lie where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    pub behind: usize,
    pub in_front: usize,
    pub planar: usize,
    pub straddling: usize,
}

impl Pieces {
    /// The whole primitives.
    pub(crate) fn new<P: Polygonal>(primitives: &[P], references: &[Reference]) -> Self {
        let mut pieces = Self::with_capacity(references.len());
        for reference in references {
            let primitive = &primitives[reference.id as usize];
            pieces
                .corners
                .extend(primitive.vertices().map(Vec3::as_dvec3));
            let is_polygon = primitive.is_convex_polygon();
            pieces.finish(reference.id, pad_of(primitive), is_polygon);
        }
        pieces
    }

    /// The part of one primitive in the cell below these planes, if any is left.
    pub(crate) fn part_of<P: Polygonal>(primitive: &P, ancestors: &[Ancestor]) -> Option<Self> {
        let bounds = primitive.bounds();
        let whole = Self::new(
            std::slice::from_ref(primitive),
            &[Reference { bounds, id: 0 }],
        );
        ancestors.iter().try_fold(whole, |part, ancestor| {
            let side = ancestor.is_in_front;
            let [behind, in_front] = part.divide(&ancestor.plane, side);
            let part = if side { in_front } else { behind };
            (part.len() > 0).then_some(part)
        })
    }

    fn with_capacity(count: usize) -> Self {
        let mut starts = Vec::with_capacity(count + 1);
        starts.push(0);
        Self {
            ids: Vec::with_capacity(count),
            pads: Vec::with_capacity(count),
            are_polygons: Vec::with_capacity(count),
            starts,
            corners: Vec::with_capacity(4 * count),
        }
    }

    /// Makes the corners added last a piece.
    fn finish(&mut self, id: u32, pad: f64, is_polygon: bool) {
        self.ids.push(id);
        self.pads.push(pad);
        self.are_polygons.push(is_polygon);
        self.starts.push(self.corners.len() as u32);
    }

    pub(crate) fn len(&self) -> usize {
        self.ids.len()
    }

    pub(crate) fn ids(&self) -> &[u32] {
        &self.ids
    }

    #[inline]
    pub(crate) fn pad(&self, piece: usize) -> f64 {
        self.pads[piece]
    }

    pub(crate) fn largest_pad(&self) -> f64 {
        self.pads.iter().copied().fold(0.0, f64::max)
    }

    #[inline]
    pub(crate) fn corners(&self, piece: usize) -> &[DVec3] {
        &self.corners[self.starts[piece] as usize..self.starts[piece + 1] as usize]
    }

    /// The smallest box around all pieces.
    pub(crate) fn bounds(&self) -> [DVec3; 2] {
        bounds_of(&self.corners)
    }

    /// On which side of `plane` a piece lies, and at what distance over the
    /// plane a piece that straddles is cut.
    #[inline]
    pub(crate) fn side(&self, piece: usize, plane: &SplitPlane) -> Side {
        let unbounded = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = self
            .corners(piece)
            .iter()
            .map(|&corner| plane.signed_distance(corner))
            .fold(unbounded, |(low, high), s| (low.min(s), high.max(s)));
        Side::of_range(low, high, -margin(self.pads[piece], plane))
    }

    /// The pieces behind `plane` and in front of it; planar ones go in front if
    /// `planar_in_front`.
    pub(crate) fn divide(&self, plane: &SplitPlane, planar_in_front: bool) -> [Self; 2] {
        let mut parts = [(); 2].map(|()| Self::with_capacity(self.len() / 2));
        for piece in 0..self.len() {
            match self.side(piece, plane) {
                Side::Back => parts[0].copy(self, piece),
                Side::Front => parts[1].copy(self, piece),
                Side::Planar => parts[usize::from(planar_in_front)].copy(self, piece),
                Side::Straddling if !self.are_polygons[piece] => {
                    parts.iter_mut().for_each(|part| part.copy(self, piece));
                }
                Side::Straddling => {
                    let overlap = margin(self.pads[piece], plane).max(0.0);
                    parts[0].clip(self, piece, |corner| {
                        plane.signed_distance(corner) - overlap
                    });
                    parts[1].clip(self, piece, |corner| {
                        -plane.signed_distance(corner) - overlap
                    });
                }
            }
        }
        parts.iter_mut().for_each(Self::shrink_to_fit);
        parts
    }

    /// Gives back what was kept ready in vain: many wait to be divided.
    fn shrink_to_fit(&mut self) {
        self.ids.shrink_to_fit();
        self.pads.shrink_to_fit();
        self.are_polygons.shrink_to_fit();
        self.starts.shrink_to_fit();
        self.corners.shrink_to_fit();
    }

    fn copy(&mut self, from: &Self, piece: usize) {
        self.corners.extend_from_slice(from.corners(piece));
        self.finish_as(from, piece);
    }

    /// Adds the part of a piece where `distance` is at most 0 (Sutherland and
    /// Hodgman 1974).
    fn clip(&mut self, from: &Self, piece: usize, distance: impl Fn(DVec3) -> f64) {
        let polygon = from.corners(piece);
        let mut previous = polygon[polygon.len() - 1];
        let mut s_previous = distance(previous);
        for &corner in polygon {
            let s = distance(corner);
            if s * s_previous < 0.0 {
                self.corners
                    .push(previous + (corner - previous) * (s_previous / (s_previous - s)));
            }
            if s <= 0.0 {
                self.corners.push(corner);
            }
            (previous, s_previous) = (corner, s);
        }
        self.finish_as(from, piece);
    }

    /// Makes the corners added last a part of that piece.
    fn finish_as(&mut self, from: &Self, piece: usize) {
        self.finish(from.ids[piece], from.pads[piece], from.are_polygons[piece]);
    }
}

/// How far a piece must stay away from a plane, in units of its signed
/// distance, to be on one side of it alone; negative where it may reach over.
#[inline]
pub(crate) fn margin(pad: f64, plane: &SplitPlane) -> f64 {
    pad * plane.normal().abs().element_sum() - plane.slack()
}

/// How far an accepted hit may lie off the primitive, in scene units.
pub(crate) fn pad_of<P: Polygonal>(primitive: &P) -> f64 {
    RELATIVE_PAD * primitive.bounds().largest_extent() + f64::from(f32::MIN_POSITIVE)
}

/// The smallest box around points.
pub(crate) fn bounds_of(points: &[DVec3]) -> [DVec3; 2] {
    let unbounded = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let grow = |[low, high]: [DVec3; 2], &point: &DVec3| [low.min(point), high.max(point)];
    points.iter().fold(unbounded, grow)
}

#[cfg(test)]
mod tests {
    use super::*;
    use accel_core::Triangle;
    use accel_core::geometry::Axis;

    #[test]
    fn parts_take_no_more_than_they_hold() {
        let triangle = |x: f32| Triangle::new([x, 0.0, 0.0], [x, 1.0, 0.0], [x, 0.0, 1.0]);
        let triangles: Vec<Triangle> = (0..100).map(|x| triangle(x as f32)).collect();
        let references: Vec<Reference> = (0..)
            .zip(&triangles)
            .map(|(id, triangle)| Reference {
                bounds: accel_core::Primitive::bounds(triangle),
                id,
            })
            .collect();
        let pieces = Pieces::new(&triangles, &references);
        let plane = SplitPlane::axis_aligned(Axis::X, 0.5, 1e-3);
        let parts = pieces.divide(&plane, false);
        assert_eq!(parts.each_ref().map(Pieces::len), [1, 99]);
        for part in parts {
            assert!(part.ids.capacity() <= part.len() + 4, "{part:?}");
            assert!(part.corners.capacity() <= 3 * part.len() + 4, "{part:?}");
        }
    }
}
