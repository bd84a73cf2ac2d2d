//! The splitting axis (Lin 2019, section 4.2): the one whose carving nodes cost
//! least by equation 1.

use accel_core::Aabb;
use accel_core::geometry::Axis;

use super::CarvingRules;
use super::carving::CarvingPlan;
use super::sizes::SizedNode;

/// A splitting node to be.
pub(super) struct SplittingPlan {
    pub axis: Axis,
    /// The high bound of the first child and the low bound of the second.
    pub positions: [f32; 2],
    /// The first child and the second, and how each is carved.
    pub children: [(SizedNode, CarvingPlan); 2],
}

impl SplittingPlan {
    /// Splits what is left of space, `region`, between two children with these
    /// boxes.
    pub(super) fn cheapest(
        rules: &CarvingRules,
        region: Aabb,
        bounds: [Aabb; 2],
        children: [SizedNode; 2],
    ) -> Self {
        let mut best: Option<Self> = None;
        for axis in Axis::ALL {
            let limit = best.as_ref().map_or(f64::INFINITY, Self::cost);
            let along = Self::along(rules, axis, region, bounds, children, limit);
            best = along.or(best);
        }
        best.expect("costs are finite, so the first axis has a plan")
    }

    /// The children are ordered by their centres, so that each inherits the bound
    /// of the region on its own side. `None` unless this costs less than `limit`.
    fn along(
        rules: &CarvingRules,
        axis: Axis,
        region: Aabb,
        bounds: [Aabb; 2],
        children: [SizedNode; 2],
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
                rules,
                regions[side],
                bounds[order[side]],
                child.references,
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

    fn cost(&self) -> f64 {
        self.children.iter().map(|(_, plan)| plan.cost).sum()
    }
}
