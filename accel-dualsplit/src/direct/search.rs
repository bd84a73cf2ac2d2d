//! The strategy of the direct builder: dividing one node by equation 1.

use std::marker::PhantomData;

use accel_bvh::{ChildBounds, NodeRules};
use accel_core::Aabb;
use accel_core::build::{Division, TopDown};
use accel_core::geometry::GrowingBox;
use accel_core::reference::{Reference, bounds_of, centers_of};
use accel_core::split::partition;

use super::cuts::{cheapest_cuts, sort_along};
use crate::convert::{CarvingChoices, CarvingRules, SplittingPlan, Weighed};

/// Bytes that a build takes for each reference besides the tree.
pub(super) const BYTES_PER_REFERENCE: usize = size_of::<Reference>() + 2 * size_of::<GrowingBox>();

/// The references of a node, and what is left of space there.
pub(super) struct DirectTask<'a> {
    references: &'a mut [Reference],
    region: Aabb,
}

/// The strategy, over references that live for `'a`.
pub(super) struct DirectSearch<'a> {
    rules: NodeRules,
    choices: CarvingChoices,
    candidates: usize,
    memory: PhantomData<fn(&'a ())>,
}

/// One of two children: its place among them, and its references.
#[derive(Clone, Copy)]
struct Side {
    index: usize,
    references: u32,
}

impl Weighed for Side {
    fn references(&self) -> u32 {
        self.references
    }
}

/// References cut in two, `position` of them first, by the cheapest plan.
struct Chosen {
    position: usize,
    bounds: [Aabb; 2],
    regions: [Aabb; 2],
}

impl<'a> DirectTask<'a> {
    pub(super) fn new(references: &'a mut [Reference], region: Aabb) -> Self {
        Self { references, region }
    }
}

impl DirectSearch<'_> {
    pub(super) fn new(rules: NodeRules, carving: &CarvingRules, candidates: usize) -> Self {
        Self {
            rules,
            choices: CarvingChoices::new(carving),
            candidates,
            memory: PhantomData,
        }
    }

    /// Cuts the references, or none if the node is a leaf.
    fn cut(&self, task: &mut DirectTask<'_>, depth: u32) -> Option<Chosen> {
        let count = task.references.len();
        if self.rules.ends_before_search(count, depth) {
            return None;
        }
        if self.rules.must_halve(depth) {
            return Some(self.halve(task));
        }
        let mut best: Option<(_, SplittingPlan<Side>)> = None;
        for cut in cheapest_cuts(task.references, self.candidates) {
            let limit = best.as_ref().map_or(f64::INFINITY, |(_, plan)| plan.cost());
            let children = sides(cut.position, count);
            let plan =
                SplittingPlan::below(&self.choices, task.region, cut.bounds, children, limit);
            best = plan.map(|plan| (cut, plan)).or(best);
        }
        let (cut, plan) = best?;
        if self
            .rules
            .prefers_leaf(count, self.split_cost(task, plan.cost()))
        {
            return None;
        }
        sort_along(task.references, cut.axis);
        Some(Chosen::new(cut.position, cut.bounds, &plan))
    }

    /// In tests of a primitive, a ray that meets the region.
    fn split_cost(&self, task: &DirectTask<'_>, plan_cost: f64) -> f64 {
        let heuristic = &self.rules.heuristic;
        let area = task.region.half_area();
        let tests = if area > 0.0 {
            heuristic.intersection_cost * plan_cost / area
        } else {
            heuristic.leaf_cost(task.references.len())
        };
        heuristic.traversal_cost + tests
    }

    fn halve(&self, task: &mut DirectTask<'_>) -> Chosen {
        let centers = centers_of(task.references);
        let (_, position) = partition::at_median(task.references, &centers);
        let (first, second) = task.references.split_at(position);
        let bounds = [bounds_of(first), bounds_of(second)];
        let children = sides(position, task.references.len());
        let plan = SplittingPlan::cheapest(&self.choices, task.region, bounds, children);
        Chosen::new(position, bounds, &plan)
    }
}

fn sides(position: usize, count: usize) -> [Side; 2] {
    let side = |index, references: usize| Side {
        index,
        references: references as u32,
    };
    [side(0, position), side(1, count - position)]
}

impl Chosen {
    fn new(position: usize, bounds: [Aabb; 2], plan: &SplittingPlan<Side>) -> Self {
        let mut regions = bounds;
        for (side, carving) in &plan.children {
            regions[side.index] = carving.region;
        }
        Self {
            position,
            bounds,
            regions,
        }
    }
}

impl<'a> TopDown for DirectSearch<'a> {
    type Task = DirectTask<'a>;
    type Node = ChildBounds;

    fn size(&self, task: &DirectTask<'a>) -> usize {
        task.references.len()
    }

    fn divide(&self, mut task: DirectTask<'a>, depth: u32, leaf: &mut Vec<u32>) -> Division<Self> {
        let Some(chosen) = self.cut(&mut task, depth) else {
            leaf.extend(task.references.iter().map(|reference| reference.id));
            return Division::Leaf;
        };
        let (first, second) = task.references.split_at_mut(chosen.position);
        let [first_region, second_region] = chosen.regions;
        Division::Inner {
            node: ChildBounds(chosen.bounds),
            children: [
                DirectTask::new(first, first_region),
                DirectTask::new(second, second_region),
            ],
        }
    }
}
