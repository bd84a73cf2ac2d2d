//! Settings, and the way from primitives to a tree.

use accel_core::build::{BuildTree, build_top_down};
use accel_core::reference::{Reference, gather};
use accel_core::split::binning::MAX_BINS;
use accel_core::{
    Aabb, BuildBudget, BuildError, BuildObserver, InvalidPrimitives, Primitive,
    SurfaceAreaHeuristic,
};

use crate::binned::{BinnedSearch, BinnedTask};
use crate::node_rules::NodeRules;
use crate::reinsertion::Reinsertion;
use crate::sweep::{SweepMemory, SweepSearch};
use crate::{Bvh, ChildBounds, LeafRule};

/// Builds a [`Bvh`]. All settings have defaults:
///
/// ```
/// use accel_bvh::{BvhBuilder, LeafRule, ObjectSplit, Sphere};
/// # fn main() -> Result<(), accel_bvh::BuildError> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let builder = BvhBuilder {
///     object_split: ObjectSplit::FullSweep,
///     leaf_rule: LeafRule::StopAt(1),
///     ..BvhBuilder::default()
/// };
/// let bvh = builder.build(&spheres)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BvhBuilder {
    /// How the best split of a node is searched for.
    pub object_split: ObjectSplit,
    /// When a node becomes a leaf.
    pub leaf_rule: LeafRule,
    /// How long the tree is improved afterwards; `None` leaves it as it is.
    pub reinsertion: Option<Reinsertion>,
    /// The costs of visiting a node and of testing a primitive.
    pub heuristic: SurfaceAreaHeuristic,
    /// Whether primitives without finite bounds are refused or left out.
    pub invalid_primitives: InvalidPrimitives,
    /// Limits on memory and depth.
    pub budget: BuildBudget,
}

/// How the best split of a node is searched for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObjectSplit {
    /// Every cut in the order of the centres along every axis: the best trees
    /// (Stich 2009, section 2.1).
    FullSweep,
    /// Cuts between bins of equal width along every axis: nearly as good, and
    /// about twice as fast to build (Wald 2007).
    Binned {
        /// Bins per axis, 2 to 64. Small nodes use fewer.
        bins: usize,
    },
}

impl Default for ObjectSplit {
    /// Binned, with 32 bins.
    fn default() -> Self {
        Self::Binned { bins: 32 }
    }
}

impl BvhBuilder {
    /// Builds the tree of `primitives`; hits name them by their position there.
    ///
    /// # Errors
    /// Any [`BuildError`] but `Cancelled`.
    pub fn build<P: Primitive>(&self, primitives: &[P]) -> Result<Bvh<P>, BuildError> {
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
    ) -> Result<Bvh<P>, BuildError> {
        self.validate()?;
        self.budget
            .check_bytes(self.working_bytes(primitives.len()))?;
        let gathered = gather(primitives, self.invalid_primitives)?;
        let (bounds, skipped) = (gathered.bounds, gathered.skipped);
        if gathered.references.is_empty() {
            return Ok(Bvh::empty(primitives, skipped));
        }
        let rules = NodeRules::new(self, gathered.references.len());
        let tree = self.build_tree(&rules, gathered.references, bounds, observer)?;
        Bvh::from_build_tree(primitives, &tree, bounds, skipped, &self.budget)
    }

    /// Checks the settings.
    ///
    /// # Errors
    /// [`BuildError::InvalidSetting`] names the first that is out of its range.
    pub fn validate(&self) -> Result<(), BuildError> {
        self.heuristic.validate()?;
        self.leaf_rule.validate()?;
        self.budget.validate()?;
        self.reinsertion
            .map_or(Ok(()), |reinsertion| reinsertion.validate())?;
        match self.object_split {
            ObjectSplit::Binned { bins } if !(2..=MAX_BINS).contains(&bins) => {
                Err(BuildError::InvalidSetting {
                    setting: "bins",
                    value: bins.to_string(),
                    allowed: "2 to 64",
                })
            }
            _ => Ok(()),
        }
    }

    /// Bytes that references and scratch memory take while a tree is built over
    /// this many primitives.
    pub fn working_bytes(&self, primitives: usize) -> usize {
        let per_primitive = match self.object_split {
            ObjectSplit::FullSweep => SweepMemory::BYTES_PER_REFERENCE,
            ObjectSplit::Binned { .. } => BinnedTask::BYTES_PER_REFERENCE,
        };
        let improving = self
            .reinsertion
            .map_or(0, |_| Reinsertion::BYTES_PER_REFERENCE);
        primitives.saturating_mul(per_primitive.max(improving))
    }

    /// Builds the tree over references that someone else made, of boxes within
    /// `bounds`: for builders outside this crate. Of the settings,
    /// `object_split` and `reinsertion` alone are used.
    ///
    /// # Errors
    /// [`BuildError::Cancelled`] if `observer` asked for it.
    ///
    /// # Panics
    /// If `references` is empty.
    pub fn build_tree(
        &self,
        rules: &NodeRules,
        references: Vec<Reference>,
        bounds: Aabb,
        observer: &dyn BuildObserver,
    ) -> Result<BuildTree<ChildBounds>, BuildError> {
        let Some(reinsertion) = self.reinsertion else {
            return self.build_subtree(rules, references, bounds, 0, observer);
        };
        let fine = rules.with_fine_leaves();
        let tree = self.build_subtree(&fine, references, bounds, 0, observer)?;
        reinsertion.improve(tree, bounds, rules, observer)
    }

    /// As [`build_tree`](Self::build_tree), for a part of another tree whose
    /// root lies at `depth` there. Of the settings, `object_split` alone is
    /// used.
    ///
    /// # Errors
    /// As [`build_tree`](Self::build_tree).
    ///
    /// # Panics
    /// If `references` is empty.
    pub fn build_subtree(
        &self,
        rules: &NodeRules,
        mut references: Vec<Reference>,
        bounds: Aabb,
        depth: u32,
        observer: &dyn BuildObserver,
    ) -> Result<BuildTree<ChildBounds>, BuildError> {
        assert!(!references.is_empty(), "a tree has at least one reference");
        match self.object_split {
            ObjectSplit::FullSweep => {
                let mut memory = SweepMemory::new(references);
                let search = SweepSearch::new(*rules);
                build_top_down(&search, memory.task(bounds), depth, observer)
            }
            ObjectSplit::Binned { bins } => {
                let task = BinnedTask::new(&mut references, bounds);
                build_top_down(&BinnedSearch::new(*rules, bins), task, depth, observer)
            }
        }
    }
}
