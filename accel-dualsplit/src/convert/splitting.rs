//! The splitting axis (Lin 2019, section 4.2): the one whose carving nodes cost
//! least by equation 1.

use accel_core::Aabb;
use accel_core::geometry::Axis;

use super::carving::{CarvingChoices, CarvingPlan};

/// A child to be, of which equation 1 wants to know one thing.
pub(crate) trait Weighed: Copy {
    /// References below it: T of equation 1.
    fn references(&self) -> u32;
}

/// A splitting node to be.
pub(crate) struct SplittingPlan<C> {
    pub axis: Axis,
    /// The high bound of the first child and the low bound of the second.
    pub positions: [f32; 2],
    /// The first child and the second, and how each is carved.
    pub children: [(C, CarvingPlan); 2],
}

impl<C: Weighed> SplittingPlan<C> {
    /// Splits what is left of space, `region`, between two children with these
    /// boxes.
    pub(crate) fn cheapest(
        choices: &CarvingChoices,
        region: Aabb,
        bounds: [Aabb; 2],
        children: [C; 2],
    ) -> Self {
        let best = Self::below(choices, region, bounds, children, f64::INFINITY);
        best.expect("costs are finite, so the first axis has a plan")
    }

    /// As [`cheapest`](Self::cheapest); `None` unless it costs less than `limit`.
    pub(crate) fn below(
        choices: &CarvingChoices,
        region: Aabb,
        bounds: [Aabb; 2],
        children: [C; 2],
        limit: f64,
    ) -> Option<Self> {
        let mut best: Option<Self> = None;
        for axis in Axis::ALL {
            let limit = best.as_ref().map_or(limit, Self::cost);
            let along = Self::along(choices, axis, region, bounds, children, limit);
            best = along.or(best);
        }
        best
    }

    /// The children are ordered by their centres, so that each inherits the bound
    /// of the region on its own side. `None` unless this costs less than `limit`.
    fn along(
        choices: &CarvingChoices,
        axis: Axis,
        region: Aabb,
        bounds: [Aabb; 2],
        children: [C; 2],
        limit: f64,
    ) -> Option<Self> {
        let is_swapped = bounds[1].center_along(axis) < bounds[0].center_along(axis);
        let order = if is_swapped { [1, 0] } else { [0, 1] };
        let positions = [axis.of(bounds[order[0]].max), axis.of(bounds[order[1]].min)];
        let regions = [
            region.with_range(axis, f32::NEG_INFINITY, positions[0]),
            region.with_range(axis, positions[1], f32::INFINITY),
        ];
        let plan = |side: usize, limit: f64| {
            let child = children[order[side]];
            let plan = CarvingPlan::cheapest(
                choices,
                regions[side],
                bounds[order[side]],
                child.references(),
                limit,
            )?;
            Some((child, plan))
        };
        let first = plan(0, limit)?;
        let second = plan(1, limit - first.1.cost)?;
        Some(Self {
            axis,
            positions,
            children: [first, second],
        })
    }

    /// Equation 1 for both children, times the area of the region.
    pub(crate) fn cost(&self) -> f64 {
        self.children.iter().map(|(_, plan)| plan.cost).sum()
    }
}
