//! The full sweep: every cut in the order along every axis, in O(n log n).
//!
//! ```text
//! once:  sort a copy of the references along each axis
//! node:  on each axis, sweep for the cheapest cut
//!        cut the winning axis' copy there; it is sorted already
//!        partition the two other copies by the same key, keeping their order
//! ```
//! Copies of whole references, not of indices, so that every pass reads memory
//! in order.

use std::marker::PhantomData;

use accel_core::Aabb;
use accel_core::build::{Division, TopDown, join};
use accel_core::geometry::Axis;
use accel_core::reference::{Reference, bounds_of};
use accel_core::split::{SplitCandidate, keep_better, partition, sweep};

use crate::ChildBounds;
use crate::node_rules::NodeRules;

/// Nodes of at least this many references sweep their axes in parallel.
const PARALLEL_SWEEP: usize = 1 << 15;

/// The memory that a build works in.
pub(crate) struct SweepMemory {
    sorted: [Vec<Reference>; 3],
    areas: [Vec<f64>; 3],
    scratch: Vec<Reference>,
}

/// The references of a node, sorted along each axis, with scratch of the same
/// length.
pub(crate) struct SweepTask<'a> {
    sorted: [&'a mut [Reference]; 3],
    areas: [&'a mut [f64]; 3],
    scratch: &'a mut [Reference],
    bounds: Aabb,
}

/// The strategy, over memory that lives for `'a`.
pub(crate) struct SweepSearch<'a> {
    rules: NodeRules,
    memory: PhantomData<fn(&'a ())>,
}

impl SweepSearch<'_> {
    pub(crate) fn new(rules: NodeRules) -> Self {
        Self {
            rules,
            memory: PhantomData,
        }
    }
}

impl SweepMemory {
    pub(crate) const BYTES_PER_REFERENCE: usize = 4 * size_of::<Reference>() + 3 * size_of::<f64>();

    pub(crate) fn new(references: Vec<Reference>) -> Self {
        let count = references.len();
        let scratch = references.clone();
        let mut sorted = [references.clone(), references.clone(), references];
        let [x, y, z] = &mut sorted;
        join(
            || sort_along(x, Axis::X),
            || join(|| sort_along(y, Axis::Y), || sort_along(z, Axis::Z)),
        );
        Self {
            sorted,
            areas: [(); 3].map(|()| vec![0.0; count]),
            scratch,
        }
    }

    pub(crate) fn task(&mut self, bounds: Aabb) -> SweepTask<'_> {
        SweepTask {
            sorted: self.sorted.each_mut().map(Vec::as_mut_slice),
            areas: self.areas.each_mut().map(Vec::as_mut_slice),
            scratch: &mut self.scratch,
            bounds,
        }
    }
}

fn sort_along(references: &mut [Reference], axis: Axis) {
    references.sort_unstable_by_key(|reference| reference.key(axis));
}

impl<'a> TopDown for SweepSearch<'a> {
    type Task = SweepTask<'a>;
    type Node = ChildBounds;

    fn size(&self, task: &SweepTask<'a>) -> usize {
        task.scratch.len()
    }

    fn divide(&self, mut task: SweepTask<'a>, depth: u32, leaf: &mut Vec<u32>) -> Division<Self> {
        let rules = &self.rules;
        let count = task.scratch.len();
        let cut = if rules.ends_before_search(count, depth) {
            None
        } else if rules.must_halve(depth) {
            Some(task.median())
        } else {
            task.cheapest_cut(rules)
                .filter(|cut| !rules.prefers_leaf(count, cut.cost))
                .map(|cut| (cut.axis, cut.position))
        };
        match cut {
            None => {
                leaf.extend(task.sorted[0].iter().map(|reference| reference.id));
                Division::Leaf
            }
            Some((axis, position)) => {
                let children = task.cut(axis, position);
                Division::Inner {
                    node: ChildBounds(children.each_ref().map(|child| child.bounds)),
                    children,
                }
            }
        }
    }
}

impl<'a> SweepTask<'a> {
    fn cheapest_cut(&mut self, rules: &NodeRules) -> Option<SplitCandidate<usize>> {
        let parent_area = self.bounds.half_area();
        let heuristic = &rules.heuristic;
        let [x, y, z] = &self.sorted;
        let [x_areas, y_areas, z_areas] = &mut self.areas;
        let cut = |sorted: &[Reference], axis, areas: &mut [f64]| {
            sweep::cheapest_cut(sorted, axis, parent_area, heuristic, areas)
        };
        let candidates = if self.scratch.len() >= PARALLEL_SWEEP {
            let (x, (y, z)) = join(
                || cut(x, Axis::X, x_areas),
                || join(|| cut(y, Axis::Y, y_areas), || cut(z, Axis::Z, z_areas)),
            );
            [x, y, z]
        } else {
            [
                cut(x, Axis::X, x_areas),
                cut(y, Axis::Y, y_areas),
                cut(z, Axis::Z, z_areas),
            ]
        };
        let mut best = None;
        for candidate in candidates.into_iter().flatten() {
            keep_better(&mut best, candidate);
        }
        best
    }

    /// The middle of the order along the axis on which the centres spread most.
    fn median(&self) -> (Axis, usize) {
        let spread = |axis: Axis| {
            let sorted = &self.sorted[axis.index()];
            let ends = [sorted.first(), sorted.last()];
            let [low, high] = ends.map(|end| end.map_or(0.0, |end| end.bounds.center_along(axis)));
            f64::from(high) - f64::from(low)
        };
        let [x, y, z] = Axis::ALL.map(spread);
        let axis = if x >= y && x >= z {
            Axis::X
        } else if y >= z {
            Axis::Y
        } else {
            Axis::Z
        };
        (axis, self.scratch.len() / 2)
    }

    /// Cuts the order along `axis` after `position` references.
    fn cut(self, axis: Axis, position: usize) -> [Self; 2] {
        let first_right = self.sorted[axis.index()][position].key(axis);
        for other in Axis::ALL.into_iter().filter(|&other| other != axis) {
            partition::stable(self.sorted[other.index()], self.scratch, |reference| {
                reference.key(axis) < first_right
            });
        }
        let [(x, x_right), (y, y_right), (z, z_right)] =
            self.sorted.map(|sorted| sorted.split_at_mut(position));
        let [
            (x_areas, x_areas_right),
            (y_areas, y_areas_right),
            (z_areas, z_areas_right),
        ] = self.areas.map(|areas| areas.split_at_mut(position));
        let (scratch, scratch_right) = self.scratch.split_at_mut(position);
        [
            Self::new([x, y, z], [x_areas, y_areas, z_areas], scratch),
            Self::new(
                [x_right, y_right, z_right],
                [x_areas_right, y_areas_right, z_areas_right],
                scratch_right,
            ),
        ]
    }

    fn new(
        sorted: [&'a mut [Reference]; 3],
        areas: [&'a mut [f64]; 3],
        scratch: &'a mut [Reference],
    ) -> Self {
        let bounds = bounds_of(sorted[0]);
        Self {
            sorted,
            areas,
            scratch,
            bounds,
        }
    }
}
