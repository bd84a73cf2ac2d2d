//! Cuts in the order along the axes, and which of them are worth weighing.

use std::cmp::Ordering;

use accel_core::Aabb;
use accel_core::geometry::{Axis, GrowingBox};
use accel_core::reference::Reference;

/// A way to cut the references of a node in two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    /// The axis along which references are ordered.
    pub axis: Axis,
    /// How many come first.
    pub position: usize,
    /// The boxes of those that come first and of the others.
    pub bounds: [Aabb; 2],
    rank: Rank,
}

/// Areas of boxes times references, then how unequal the numbers of references are:
/// halves keep trees over coincident primitives shallow.
#[derive(Clone, Copy, Debug)]
struct Rank(f64, usize);

impl Rank {
    fn order(self, other: Self) -> Ordering {
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1))
    }
}

/// The cheapest cuts of each axis by the areas of boxes, for the costs of a
/// dual-split tree to choose from, the cheapest first. Sorts the references.
pub(super) fn cheapest_cuts(references: &mut [Reference], count: usize) -> Vec<Cut> {
    let mut boxes = Vec::with_capacity(references.len());
    let mut cheapest = Vec::with_capacity(3 * count);
    for axis in Axis::ALL {
        sort_along(references, axis);
        boxes_from_end(references, &mut boxes);
        keep_cheapest(references, axis, &boxes, count, &mut cheapest);
    }
    // The first plan that is weighed is the limit for all others.
    cheapest.sort_by(|a, b| a.rank.order(b.rank));
    cheapest
}

pub(super) fn sort_along(references: &mut [Reference], axis: Axis) {
    references.sort_unstable_by_key(|reference| reference.key(axis));
}

/// The box around each reference and all that come after it, the last one first.
fn boxes_from_end(references: &[Reference], boxes: &mut Vec<GrowingBox>) {
    boxes.clear();
    let mut bounds = GrowingBox::empty();
    boxes.extend(references.iter().rev().map(|reference| {
        bounds.add(&reference.bounds);
        bounds
    }));
}

/// Appends at most `count` cuts, the cheapest one first.
fn keep_cheapest(
    references: &[Reference],
    axis: Axis,
    boxes_from_end: &[GrowingBox],
    count: usize,
    kept: &mut Vec<Cut>,
) {
    let earlier = kept.len();
    let mut first = GrowingBox::empty();
    let rests = boxes_from_end.iter().rev().skip(1);
    for ((reference, rest), position) in references.iter().zip(rests).zip(1..) {
        first.add(&reference.bounds);
        let others = references.len() - position;
        let cost = first.half_area() * position as f64 + rest.half_area() * others as f64;
        let rank = Rank(cost, position.abs_diff(others));
        let own = &kept[earlier..];
        if own.len() == count {
            if own
                .last()
                .is_some_and(|worst| rank.order(worst.rank).is_ge())
            {
                continue;
            }
            kept.pop();
        }
        let place = kept[earlier..].partition_point(|other| other.rank.order(rank).is_le());
        let cut = Cut {
            axis,
            position,
            bounds: [first.bounds(), rest.bounds()],
            rank,
        };
        kept.insert(earlier + place, cut);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn references(xs: &[f32]) -> Vec<Reference> {
        let reference = |(&x, id)| Reference {
            bounds: Aabb::new([x, 0.0, 0.0], [x + 0.05, 1.0, 1.0]),
            id,
        };
        xs.iter().zip(0..).map(reference).collect()
    }

    #[test]
    fn the_cheapest_cut_comes_first() {
        let mut references = references(&[5.0, 0.0, 5.1, 0.1, 0.2]);
        let cuts = cheapest_cuts(&mut references, 2);
        assert_eq!(cuts.len(), 6);
        let best = cuts[0];
        assert_eq!((best.axis, best.position), (Axis::X, 3));
        assert_eq!(best.bounds[0].max.x, 0.25);
        assert_eq!(best.bounds[1].min.x, 5.0);
    }

    #[test]
    fn coincident_references_are_cut_in_the_middle_and_one_alone_is_not() {
        let cuts = cheapest_cuts(&mut references(&[1.0; 10]), 1);
        assert!(cuts.len() == 3 && cuts.iter().all(|cut| cut.position == 5));
        assert!(cheapest_cuts(&mut references(&[1.0]), 4).is_empty());
    }
}
