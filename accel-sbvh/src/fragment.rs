//! References that know the bounds of their part without the pad.

use accel_core::geometry::{Axis, GrowingBox};
use accel_core::reference::{ClippedReference, Reference};
use accel_core::{Aabb, Clip};

/// A reference (Stich 2009, section 4.1) to a primitive or to a part of one,
/// twice bounded: by the padded box that the tree must enclose, and by the tight
/// one that costs and overlaps are computed from. In the pads alone every two
/// neighbours would overlap.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fragment {
    pub reference: Reference,
    pub tight: Aabb,
}

impl AsRef<Reference> for Fragment {
    #[inline(always)]
    fn as_ref(&self) -> &Reference {
        &self.reference
    }
}

impl Fragment {
    /// The reference to all of a primitive that `gate` refers to.
    pub(crate) fn whole<P: Clip>(gate: Reference, primitives: &[P]) -> Self {
        Self {
            reference: gate,
            tight: primitives[gate.id as usize].bounds(),
        }
    }

    /// Where the part begins and ends along `axis`.
    #[inline]
    pub(crate) fn range(&self, axis: Axis) -> [f32; 2] {
        [axis.of(self.tight.min), axis.of(self.tight.max)]
    }

    /// On which side of a plane the part lies.
    #[inline]
    pub(crate) fn side(&self, axis: Axis, position: f32) -> FragmentSide {
        let [low, high] = self.range(axis);
        if low >= position {
            FragmentSide::Right
        } else if high > position {
            FragmentSide::Straddling
        } else {
            FragmentSide::Left
        }
    }

    /// The two parts of a straddling fragment; `None` where, within rounding,
    /// nothing of the primitive lies on that side.
    ///
    /// The original primitive is clipped, never an already clipped part of it.
    /// The pad of a part may reach out of the fragment's own box, where no hit
    /// is: that is cut off, so that children stay inside their parents.
    pub(crate) fn split<P: Clip>(
        &self,
        primitives: &[P],
        axis: Axis,
        position: f32,
    ) -> [Option<Self>; 2] {
        let id = self.reference.id;
        let [low, high] = self.range(axis);
        [(low, position), (position, high)].map(|(low, high)| {
            let cell = self.tight.with_range(axis, low, high);
            let part = Reference::clipped(&primitives[id as usize], id, &cell)?;
            Some(self.narrowed_to(&part))
        })
    }

    fn narrowed_to(&self, part: &ClippedReference) -> Self {
        Self {
            reference: Reference {
                bounds: part.reference.bounds.intersection(&self.reference.bounds),
                id: self.reference.id,
            },
            tight: part.tight.rounded_outward().intersection(&self.tight),
        }
    }
}

/// On which side of a plane a fragment lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FragmentSide {
    Left,
    /// On both.
    Straddling,
    /// Flat fragments in the plane included.
    Right,
}

/// The smallest box around the tight boxes of all of `fragments`.
pub(crate) fn tight_bounds_of<'a>(fragments: impl IntoIterator<Item = &'a Fragment>) -> Aabb {
    let mut bounds = GrowingBox::empty();
    for fragment in fragments {
        bounds.add(&fragment.tight);
    }
    bounds.bounds()
}

/// Half the area that two boxes have in common, lambda (section 4.5); none where
/// the common part has no extent in some axis, as that of neighbours that touch.
pub(crate) fn overlap(boxes: &[Aabb; 2]) -> f64 {
    let common = boxes[0].intersection(&boxes[1]);
    if common.min.cmplt(common.max).all() {
        common.half_area()
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use accel_core::{Primitive, Triangle};

    #[test]
    fn touching_boxes_do_not_overlap() {
        let unit = |x: f32| Aabb::new([x, 0.0, 0.0], [x + 1.0, 1.0, 1.0]);
        assert_eq!(overlap(&[unit(0.0), unit(1.0)]), 0.0);
        assert_eq!(overlap(&[unit(0.0), unit(3.0)]), 0.0);
        assert_eq!(overlap(&[unit(0.0), unit(0.5)]), 0.5 + 0.5 + 1.0);
    }

    #[test]
    fn a_split_divides_the_tight_box_and_stays_inside_the_padded_one() {
        let triangle = Triangle::new([0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 4.0]);
        let gate = Reference {
            bounds: triangle.bounds().gate(),
            id: 0,
        };
        let whole = Fragment::whole(gate, &[triangle]);
        assert_eq!(whole.side(Axis::X, 1.0), FragmentSide::Straddling);
        let [left, right] = whole
            .split(&[triangle], Axis::X, 1.0)
            .map(|part| part.unwrap());
        assert_eq!(left.tight, Aabb::new([0.0; 3], [1.0, 4.0, 4.0]));
        assert_eq!(right.tight, Aabb::new([1.0, 0.0, 0.0], [4.0, 3.0, 3.0]));
        for part in [left, right] {
            assert!(gate.bounds.contains(&part.reference.bounds));
            assert!(part.reference.bounds.contains(&part.tight));
        }
        assert_eq!(left.side(Axis::X, 1.0), FragmentSide::Left);
        assert_eq!(right.side(Axis::X, 1.0), FragmentSide::Right);
    }
}
