//! Early split clipping.

use accel_bvh::{Bvh, BvhBuilder};
use accel_core::geometry::DAabb;
use accel_core::{Aabb, BuildError, BuildObserver, Clip};

use super::{Pipeline, PresplitStatistics, Subdivision, Threshold};
use crate::ReferenceLimit;

/// Early split clipping (Ernst and Greiner, *Early Split Clipping for Bounding
/// Volume Hierarchies*, 2007): the box of each primitive is halved at the middle
/// of its longest axis, again and again, until the area of each part is below
/// the threshold SA_max, and a plain BVH is built over the parts. After each
/// halving the box is tightened to the part of the primitive inside, and empty
/// halves are dropped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EarlySplitClipping {
    /// SA_max: the surface area of a box, in square scene units.
    pub threshold: Threshold,
    /// The most references; [`BuildError::BudgetExceeded`] if a given threshold
    /// makes more.
    pub limit: ReferenceLimit,
    /// Whether a leaf that holds several parts of a primitive references it only
    /// once. The published method does not.
    pub remove_duplicates: bool,
    /// Builds the tree over the parts.
    pub bvh: BvhBuilder,
}

impl Default for EarlySplitClipping {
    /// A quarter more references than primitives, by the full sweep.
    fn default() -> Self {
        Self {
            threshold: Threshold::Factor(1.25),
            limit: super::DEFAULT_LIMIT,
            remove_duplicates: false,
            bvh: BvhBuilder {
                object_split: accel_bvh::ObjectSplit::FullSweep,
                ..BvhBuilder::default()
            },
        }
    }
}

impl EarlySplitClipping {
    /// Builds the tree of `primitives`.
    ///
    /// # Errors
    /// Any [`BuildError`] but `Cancelled`.
    pub fn build<P: Clip>(&self, primitives: &[P]) -> Result<Bvh<P>, BuildError> {
        Ok(self.build_with(primitives, &())?.0)
    }

    /// As [`build`](Self::build), watched by `observer`, with what was done.
    ///
    /// # Errors
    /// Any [`BuildError`].
    pub fn build_with<P: Clip>(
        &self,
        primitives: &[P],
        observer: &dyn BuildObserver,
    ) -> Result<(Bvh<P>, PresplitStatistics), BuildError> {
        let pipeline = Pipeline {
            subdivision: Halving,
            threshold: self.threshold,
            limit: self.limit,
            remove_duplicates: self.remove_duplicates,
            bvh: &self.bvh,
        };
        pipeline.build(primitives, observer)
    }
}

/// Recursive halving of a primitive's box.
struct Halving;

impl<P: Clip> Subdivision<P> for Halving {
    fn divide(&self, primitive: &P, threshold: f64, part: &mut dyn FnMut(DAabb) -> bool) {
        let mut pending = vec![primitive.bounds()];
        while let Some(bounds) = pending.pop() {
            match halves(primitive, &bounds).filter(|_| 2.0 * bounds.half_area() >= threshold) {
                Some(halves) => pending.extend(halves.into_iter().rev().flatten()),
                None if !part(bounds.into()) => return,
                None => {}
            }
        }
    }

    fn largest_threshold(&self, scene: &Aabb) -> f64 {
        4.0 * scene.half_area()
    }
}

/// Both halves of a box, each tightened to the primitive's part in it; `None` if
/// the box is too small to be halved.
fn halves<P: Clip>(primitive: &P, bounds: &Aabb) -> Option<[Option<Aabb>; 2]> {
    let axis = bounds.widest_axis();
    let (low, high) = (axis.of(bounds.min), axis.of(bounds.max));
    let middle = bounds.center_along(axis);
    if middle <= low || middle >= high {
        return None;
    }
    let halves = [(low, middle), (middle, high)].map(|(low, high)| {
        let half = primitive.clip(&bounds.with_range(axis, low, high))?;
        Some(half.rounded_outward().intersection(bounds))
    });
    // Should rounding lose both, the box stays as it is.
    halves.iter().any(Option::is_some).then_some(halves)
}

#[cfg(test)]
mod tests {
    use super::*;
    use accel_core::Triangle;

    fn parts(triangle: &Triangle, threshold: f64) -> Vec<DAabb> {
        let mut parts = Vec::new();
        Halving.divide(triangle, threshold, &mut |part| {
            parts.push(part);
            parts.len() < 1000
        });
        parts
    }

    #[test]
    fn boxes_are_halved_along_the_longest_axis_and_tightened() {
        // The half of a rectangle of 8 by 2 under its diagonal.
        let triangle = Triangle::new([0.0; 3], [8.0, 0.0, 0.0], [8.0, 2.0, 0.0]);
        assert_eq!(parts(&triangle, 32.1).len(), 1);
        let halves = parts(&triangle, 32.0);
        let expected = [
            Aabb::new([0.0; 3], [4.0, 1.0, 0.0]),
            Aabb::new([4.0, 0.0, 0.0], [8.0, 2.0, 0.0]),
        ];
        assert_eq!(halves, expected.map(DAabb::from));
    }

    #[test]
    fn a_threshold_of_nothing_ends_when_there_are_too_many_parts() {
        let triangle = Triangle::new([0.0; 3], [8.0, 0.0, 0.0], [8.0, 2.0, 0.0]);
        assert_eq!(parts(&triangle, 0.0).len(), 1000);
    }
}
