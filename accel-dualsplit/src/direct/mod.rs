//! The direct builder: what Lin 2019, section 6, leaves to future work.
//!
//! A conversion takes the partition of a BVH, which was chosen for the boxes of that
//! BVH. This builder chooses the partition by what the dual-split tree will have: by
//! equation 1, for the region that is left of space at a node and the carving nodes
//! that its children would get.
//!
//! ```text
//! build(references, region that is left of space):
//!     for each axis: sort the references along it; keep the cuts that are cheapest
//!         by the areas of boxes
//!     for each kept cut: the cheapest splitting node and carving nodes, as in a
//!         conversion; the cheapest cut by these costs wins
//!     leaf if none is cheaper, else build both children, each in the region that
//!         its carving has left
//! ```
//!
//! All regions are boxes, nested two by two, so boxes of a BVH could be given the same
//! extents. A BVH of bounding boxes, though, has the box of what a node holds and no
//! other: a region that is deliberately larger, and the partition that is only
//! cheapest because it is, are not among its choices.

mod cuts;
mod search;

use accel_bvh::{Bvh, BvhBuilder, LeafRule, NodeRules, ObjectSplit};
use accel_core::build::build_top_down;
use accel_core::reference::{Reference, gather};
use accel_core::{
    BuildBudget, BuildError, BuildObserver, InvalidPrimitives, Primitive, SurfaceAreaHeuristic,
};

use crate::convert::{CarvingCosts, CarvingRules, DualSplitConverter, NodeCosts, Partitioning};
use crate::tree::DualSplitTree;
use search::{DirectSearch, DirectTask};

/// The most cuts of an axis that can be weighed.
const MAX_CANDIDATES: usize = 64;

/// Builds a [`DualSplitTree`] by its own costs, not by those of a BVH.
///
/// ```
/// use accel_dualsplit::{AccelerationStructure, DualSplitBuilder, RaySegment, Sphere};
/// # fn main() -> Result<(), accel_dualsplit::BuildError> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let tree = DualSplitBuilder::default().build(&spheres)?;
/// let hit = tree.closest_hit(&RaySegment::new([4.0, 0.0, -3.0], [0.0, 0.0, 1.0])).unwrap();
/// assert_eq!((hit.id, hit.t), (1, 2.0));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DualSplitBuilder {
    /// Cuts of each axis that are weighed by equation 1, 1 to 64. More find cheaper
    /// trees and take longer.
    pub candidates: usize,
    /// What visiting a carving node costs.
    pub carving_costs: CarvingCosts,
    /// The costs of visiting a splitting node and of testing a primitive.
    pub heuristic: SurfaceAreaHeuristic,
    /// When a node becomes a leaf.
    pub leaf_rule: LeafRule,
    /// Whether primitives without finite bounds are refused or left out.
    pub invalid_primitives: InvalidPrimitives,
    /// Limits on memory and depth.
    pub budget: BuildBudget,
}

impl Default for DualSplitBuilder {
    /// Eight candidates; all else as [`BvhBuilder`] and [`DualSplitConverter`] have it.
    fn default() -> Self {
        let BvhBuilder {
            heuristic,
            leaf_rule,
            invalid_primitives,
            budget,
            ..
        } = BvhBuilder::default();
        Self {
            candidates: 8,
            carving_costs: CarvingCosts::default(),
            heuristic,
            leaf_rule,
            invalid_primitives,
            budget,
        }
    }
}

impl DualSplitBuilder {
    /// Builds the tree of `primitives`; hits name them by their position there.
    ///
    /// # Errors
    /// Any [`BuildError`] but `Cancelled`.
    pub fn build<P: Primitive>(&self, primitives: &[P]) -> Result<DualSplitTree<P>, BuildError> {
        self.build_with(primitives, &())
    }

    /// As [`build`](Self::build), telling `observer` how far it is and stopping
    /// when told to.
    ///
    /// # Errors
    /// Any [`BuildError`].
    pub fn build_with<P: Primitive>(
        &self,
        primitives: &[P],
        observer: &dyn BuildObserver,
    ) -> Result<DualSplitTree<P>, BuildError> {
        let converter = DualSplitConverter {
            partitioning: Partitioning::Similar,
            carving_costs: self.carving_costs,
            budget: self.budget,
        };
        // The converter carves the chosen partition by the rules that chose it: it
        // comes to the same nodes.
        converter.convert(&self.partition(primitives, observer)?)
    }

    /// The chosen partition, as a BVH.
    fn partition<P: Primitive>(
        &self,
        primitives: &[P],
        observer: &dyn BuildObserver,
    ) -> Result<Bvh<P>, BuildError> {
        let settings = self.validated()?;
        let working_bytes = primitives.len() * search::BYTES_PER_REFERENCE;
        self.budget.check_bytes(working_bytes)?;
        let mut gathered = gather(primitives, self.invalid_primitives)?;
        let references: &mut [Reference] = &mut gathered.references;
        if references.is_empty() {
            return settings.build_with(primitives, observer);
        }
        let rules = NodeRules::new(&settings, references.len());
        let carving = CarvingRules {
            partitioning: Partitioning::Similar,
            costs: self.carving_costs.into(),
        };
        let search = DirectSearch::new(rules, &carving, self.candidates);
        let root = DirectTask::new(references, gathered.bounds);
        let tree = build_top_down(&search, root, 0, observer)?;
        Bvh::from_build_tree(
            primitives,
            &tree,
            gathered.bounds,
            gathered.skipped,
            &self.budget,
        )
    }

    /// Checks the settings and gives those that a BVH has, too.
    fn validated(&self) -> Result<BvhBuilder, BuildError> {
        NodeCosts::check_carving(&self.carving_costs)?;
        if !(1..=MAX_CANDIDATES).contains(&self.candidates) {
            return Err(BuildError::InvalidSetting {
                setting: "candidates",
                value: self.candidates.to_string(),
                allowed: "1 to 64",
            });
        }
        let settings = BvhBuilder {
            object_split: ObjectSplit::FullSweep,
            leaf_rule: self.leaf_rule,
            heuristic: self.heuristic,
            invalid_primitives: self.invalid_primitives,
            budget: self.budget,
            ..BvhBuilder::default()
        };
        settings.validate()?;
        Ok(settings)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use accel_core::glam::Vec3;
    use accel_core::statistics::{NodeKind, TreeOutline};
    use accel_core::testing::families;
    use accel_core::{AccelerationStructure, Triangle};

    use super::*;

    fn scene() -> Vec<Triangle> {
        families::find("soup-mixed-sizes").unwrap().scene(7, 1500)
    }

    #[test]
    fn own_costs_choose_partitions_that_areas_of_boxes_do_not() {
        let scene = scene();
        let build = |candidates| {
            let builder = DualSplitBuilder {
                candidates,
                ..DualSplitBuilder::default()
            };
            builder.build(&scene).unwrap()
        };
        let (one, many) = (build(1), build(8));
        assert_ne!(one.node_words(), many.node_words());
        for tree in [one, many] {
            tree.validate().unwrap();
        }
    }

    /// A BVH of bounding boxes over the same subsets has, at each of them, the box of
    /// what it holds. Some regions of the tree are larger, deliberately.
    #[test]
    fn some_regions_are_in_no_bvh_of_bounding_boxes_over_the_same_subsets() {
        let builder = DualSplitBuilder::default();
        let tree = builder.build(&scene()).unwrap();
        let bvh = builder.partition(&scene(), &()).unwrap();
        let identical = DualSplitConverter {
            partitioning: Partitioning::Identical,
            ..DualSplitConverter::default()
        };
        let boxes = regions(&bvh.outline(), NodeKind::Inner);
        let of_identical = identical.convert(&bvh).unwrap().outline();
        assert!(regions(&of_identical, NodeKind::Splitting) == boxes);
        let own = regions(&tree.outline(), NodeKind::Splitting);
        let others = own.difference(&boxes).count();
        assert!(others > own.len() / 4, "{others} of {}", own.len());
    }

    /// Of nodes of one kind.
    fn regions(outline: &TreeOutline, kind: NodeKind) -> BTreeSet<[[u32; 3]; 2]> {
        let bits = |point: Vec3| point.to_array().map(f32::to_bits);
        let nodes = outline.nodes.iter().filter(|node| node.kind == kind);
        nodes
            .map(|node| [node.bounds.min, node.bounds.max].map(bits))
            .collect()
    }

    #[test]
    fn settings_out_of_range_are_named() {
        for (builder, setting) in [
            (
                DualSplitBuilder {
                    candidates: 0,
                    ..DualSplitBuilder::default()
                },
                "candidates",
            ),
            (
                DualSplitBuilder {
                    carving_costs: CarvingCosts {
                        single_axis: 0.3,
                        dual_axis: f64::NAN,
                    },
                    ..DualSplitBuilder::default()
                },
                "carving_costs.dual_axis",
            ),
        ] {
            let message = builder.build(&scene()).unwrap_err().to_string();
            assert!(message.contains(setting), "{message}");
        }
        let empty = DualSplitBuilder::default().build::<Triangle>(&[]).unwrap();
        assert!(empty.bounds().is_none());
    }
}
