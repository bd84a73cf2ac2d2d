//! What builders sort and split: boxes with the ids of primitives.

mod chopping;
mod clipping;
mod gather;

use crate::geometry::{Aabb, Axis, DAabb, GrowingBox};
use crate::primitive::{Clip, Primitive};

pub use chopping::chop_polygon;
pub use clipping::{clip_polygon, clip_polygon_corners};
pub use gather::{Gathered, gather};

/// A reference to a primitive: its id, and a box around it or around the part of
/// it that this reference stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// Conservative bounds: the gate box, or a padded clip within it.
    pub bounds: Aabb,
    /// The primitive's position in the builder's input.
    pub id: u32,
}

impl AsRef<Self> for Reference {
    #[inline(always)]
    fn as_ref(&self) -> &Self {
        self
    }
}

/// A reference to the part of a primitive inside a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClippedReference {
    /// The reference with padded bounds: what the tree must enclose.
    pub reference: Reference,
    /// Bounds of the part without any pad, for costs and overlaps.
    pub tight: DAabb,
}

impl Reference {
    /// The order by centre of the box along `axis`, then by id: total, so that
    /// sorting and partitioning never depend on chance.
    #[inline]
    pub fn key(&self, axis: Axis) -> SortKey {
        SortKey {
            center: self.bounds.center_along(axis),
            id: self.id,
        }
    }

    /// The reference to the part of `primitive` inside `cell`, or `None` if no
    /// part is inside.
    ///
    /// The *original* primitive is clipped, in double precision, and the result
    /// is padded as by [`to_part`](Self::to_part). The pad stays within the cell
    /// enlarged by as much.
    pub fn clipped<P: Clip>(primitive: &P, id: u32, cell: &Aabb) -> Option<ClippedReference> {
        let tight = primitive.clip(cell)?;
        let pad = clip_pad(&primitive.bounds());
        let bounds = tight.padded(pad).intersection(&cell.padded(pad));
        Some(ClippedReference {
            reference: Self { bounds, id },
            tight,
        })
    }

    /// The reference to a part of `primitive` that `tight` bounds.
    ///
    /// The box is padded by a distance local to the primitive: 2^-20 of its
    /// largest extent and one unit in the last place of its largest coordinate,
    /// and no less than its gate box is.
    pub fn to_part<P: Primitive>(primitive: &P, id: u32, tight: &DAabb) -> Self {
        let bounds = tight.padded(clip_pad(&primitive.bounds()));
        Self { bounds, id }
    }
}

/// How far the bounds of clipped parts of a primitive with these bounds are
/// padded.
fn clip_pad(bounds: &Aabb) -> f64 {
    const RELATIVE_PAD: f64 = 1.0 / (1 << 20) as f64;
    let largest = bounds.min.abs().max(bounds.max.abs()).max_element();
    let ulp = f64::from(largest.next_up()) - f64::from(largest);
    let ulp = if ulp.is_finite() { ulp } else { 0.0 };
    let gate = bounds.gate();
    let below = bounds.min.as_dvec3() - gate.min.as_dvec3();
    let above = gate.max.as_dvec3() - bounds.max.as_dvec3();
    // Parts that make up the whole enclose the gate box of the whole.
    let gate_pad = below.max(above).max_element();
    (bounds.largest_extent() * RELATIVE_PAD + ulp).max(gate_pad)
}

/// Where a reference stands in the order along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SortKey {
    center: f32,
    id: u32,
}

impl Eq for SortKey {}

impl Ord for SortKey {
    #[inline]
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.center
            .total_cmp(&other.center)
            .then(self.id.cmp(&other.id))
    }
}

impl PartialOrd for SortKey {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// The smallest box around all of `references`.
pub fn bounds_of<R: AsRef<Reference>>(references: &[R]) -> Aabb {
    let mut bounds = GrowingBox::empty();
    for reference in references {
        bounds.add(&reference.as_ref().bounds);
    }
    bounds.bounds()
}

/// The smallest box around the centres of the boxes of all of `references`.
pub fn centers_of<R: AsRef<Reference>>(references: &[R]) -> Aabb {
    let mut centers = GrowingBox::empty();
    for reference in references {
        centers.add_point(reference.as_ref().bounds.center());
    }
    centers.bounds()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitive::{Sphere, Triangle};

    #[test]
    fn clipped_references_enclose_the_part_but_not_much_more() {
        let triangle = Triangle::new([0.0; 3], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0]);
        let cell = Aabb::new([0.0, 0.0, -1.0], [2.0, 2.0, 1.0]);
        let clipped = Reference::clipped(&triangle, 3, &cell).unwrap();
        assert_eq!(clipped.reference.id, 3);
        assert_eq!(
            clipped.tight.rounded_outward(),
            Aabb::new([0.0; 3], [2.0, 2.0, 0.0])
        );
        let bounds = clipped.reference.bounds;
        assert!(bounds.min.max_element() < 0.0 && bounds.max.x > 2.0 && bounds.max.x < 2.001);
        assert!(bounds.max.z > 0.0);
    }

    #[test]
    fn a_part_outside_the_cell_has_no_reference() {
        let triangle = Triangle::new([0.0; 3], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0]);
        // Inside the triangle's box, but beyond its diagonal edge.
        let cell = Aabb::new([7.0, 7.0, -1.0], [8.0, 8.0, 1.0]);
        assert_eq!(Reference::clipped(&triangle, 0, &cell), None);
        let sphere = Sphere::new([0.0; 3], 1.0);
        assert!(Reference::clipped(&sphere, 0, &Aabb::new([0.5; 3], [2.0; 3])).is_some());
    }

    #[test]
    fn the_order_is_total() {
        let at = |x: f32, id| Reference {
            bounds: Aabb::new([x, 0.0, 0.0], [x, 0.0, 0.0]),
            id,
        };
        assert!(at(1.0, 9).key(Axis::X) < at(2.0, 0).key(Axis::X));
        assert!(at(1.0, 0).key(Axis::X) < at(1.0, 1).key(Axis::X));
    }
}
