//! Settings, and the way from primitives to a tree.

use accel_bvh::{Bvh, BvhBuilder, LeafRule, NodeRules, ObjectSplit, Reinsertion};
use accel_core::reference::{Reference, gather};
use accel_core::{
    BuildBudget, BuildError, BuildObserver, Clip, InvalidPrimitives, SurfaceAreaHeuristic,
};

use crate::fragment::Fragment;
use crate::growth::Growth;
use crate::node::{Fragments, Node};
use crate::partitioning::Partitioning;
use crate::spatial_split::{Divisor, SpatialSearch};
use crate::waiting::WaitingList;
use crate::{CandidateClipping, ReferenceLimit, Spending, SplitStatistics};

/// Builds a [`Bvh`] with spatial splits. All settings have defaults: those of
/// Stich 2009, but for `leaf_rule`, `bins_per_reference` and `limit`. The paper's
/// own are `LeafRule::StopAt(8)`, `usize::MAX` and `ReferenceLimit::Unlimited`.
///
/// ```
/// use accel_sbvh::{LeafRule, ReferenceLimit, SbvhBuilder, Sphere};
/// # fn main() -> Result<(), accel_sbvh::BuildError> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let builder = SbvhBuilder {
///     leaf_rule: LeafRule::StopAt(8),
///     limit: ReferenceLimit::Factor(1.25),
///     ..SbvhBuilder::default()
/// };
/// let bvh = builder.build(&spheres)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SbvhBuilder {
    /// How object split candidates are searched for.
    pub object_split: ObjectSplit,
    /// Bins per axis in the search for spatial splits, 2 to 65536. References are
    /// chopped at all planes between bins where a split may pay: time grows with
    /// the product.
    pub spatial_bins: usize,
    /// Nodes of few references have no more bins than so many for each, at least
    /// 1; `usize::MAX` makes it `spatial_bins` in every node, as in the paper.
    pub bins_per_reference: usize,
    /// How references are clipped in that search.
    pub clipping: CandidateClipping,
    /// Whether a reference that a spatial split's plane cuts may go to one side
    /// whole, where that is cheaper (section 4.4).
    pub unsplitting: bool,
    /// Alpha, the overlap of an object split, relative to the area of the root,
    /// up to which no spatial split is attempted (section 4.5): 0 attempts one
    /// wherever there is overlap, 1 never does and builds a plain BVH. Overlap is
    /// a volume: where all primitives lie in one axis-aligned plane there is none,
    /// and no spatial split is attempted.
    pub alpha: f64,
    /// The most references that the tree may have.
    pub limit: ReferenceLimit,
    /// Where they are spent if the limit does not allow all.
    pub spending: Spending,
    /// When a node becomes a leaf.
    pub leaf_rule: LeafRule,
    /// How long the tree is improved afterwards; `None`, as in the paper, leaves
    /// it as it is.
    pub reinsertion: Option<Reinsertion>,
    /// The costs of visiting a node and of testing a primitive.
    pub heuristic: SurfaceAreaHeuristic,
    /// Whether primitives without finite bounds are refused or left out.
    pub invalid_primitives: InvalidPrimitives,
    /// Limits on memory and depth. A search for spatial splits takes some 50 KB of
    /// bins beside, on each thread.
    pub budget: BuildBudget,
}

impl Default for SbvhBuilder {
    fn default() -> Self {
        Self {
            object_split: ObjectSplit::FullSweep,
            spatial_bins: 256,
            bins_per_reference: 8,
            clipping: CandidateClipping::default(),
            unsplitting: true,
            alpha: 1e-5,
            limit: ReferenceLimit::default(),
            spending: Spending::default(),
            leaf_rule: LeafRule::default(),
            reinsertion: None,
            heuristic: SurfaceAreaHeuristic::default(),
            invalid_primitives: InvalidPrimitives::default(),
            budget: BuildBudget::default(),
        }
    }
}

impl SbvhBuilder {
    /// Builds the tree of `primitives`; hits name them by their position there.
    ///
    /// # Errors
    /// Any [`BuildError`] but `Cancelled`.
    pub fn build<P: Clip>(&self, primitives: &[P]) -> Result<Bvh<P>, BuildError> {
        Ok(self.build_with(primitives, &())?.0)
    }

    /// As [`build`](Self::build), telling `observer` how far it is and stopping
    /// when told to, and returning what was done as well.
    ///
    /// # Errors
    /// Any [`BuildError`].
    pub fn build_with<P: Clip>(
        &self,
        primitives: &[P],
        observer: &dyn BuildObserver,
    ) -> Result<(Bvh<P>, SplitStatistics), BuildError> {
        let objects = self.object_builder();
        objects.validate()?;
        self.validate()?;
        self.budget
            .check_bytes(primitives.len().saturating_mul(size_of::<Reference>()))?;
        let gathered = gather(primitives, self.invalid_primitives)?;
        let (bounds, skipped) = (gathered.bounds, gathered.skipped);
        let count = gathered.references.len();
        let spare = self.most_references::<P>(count)? - count;
        if count == 0 {
            let bvh = objects.build(primitives)?;
            return Ok((bvh, SplitStatistics::default()));
        }
        let root = self.root(gathered.references, primitives, spare);
        let rules = NodeRules::new(&objects, count);
        let growth = Growth {
            partitioning: self.partitioning(primitives, &root, rules),
            objects,
            observer,
        };
        let (mut tree, statistics) = growth.grow(root, WaitingList::new(self.spending, spare))?;
        if let Some(reinsertion) = self.reinsertion {
            tree = reinsertion.improve(tree, bounds, &rules, observer)?;
            // Parts of a primitive may have come together.
            tree.remove_duplicates_in_leaves();
        }
        let bvh = Bvh::from_build_tree(primitives, &tree, bounds, skipped, &self.budget)?;
        Ok((bvh, statistics))
    }

    fn validate(&self) -> Result<(), BuildError> {
        self.limit.validate()?;
        let reject = |setting, value: String, allowed| {
            Err(BuildError::InvalidSetting {
                setting,
                value,
                allowed,
            })
        };
        if !(2..=1 << 16).contains(&self.spatial_bins) {
            return reject("spatial_bins", self.spatial_bins.to_string(), "2 to 65536");
        }
        if self.bins_per_reference == 0 {
            return reject("bins_per_reference", "0".into(), "1 or more");
        }
        // The negated range rejects NaN as well.
        if !(0.0..=1.0).contains(&self.alpha) {
            return reject("alpha", self.alpha.to_string(), "a number from 0 to 1");
        }
        Ok(())
    }

    /// The builder of subtrees without spatial splits.
    fn object_builder(&self) -> BvhBuilder {
        BvhBuilder {
            object_split: self.object_split,
            leaf_rule: self.leaf_rule,
            reinsertion: self.reinsertion,
            heuristic: self.heuristic,
            invalid_primitives: self.invalid_primitives,
            budget: self.budget,
        }
    }

    /// The limit on references for a tree over so many valid primitives, and as
    /// many as the budget has memory for while the tree is built, known before
    /// any is taken.
    fn most_references<P: Clip>(&self, primitives: usize) -> Result<usize, BuildError> {
        let limit = self.limit.references(primitives, size_of::<P>())?;
        let Some(bytes) = self.budget.max_bytes else {
            return Ok(limit);
        };
        let each = Fragments::bytes_per_fragment(self.object_split)
            + self.object_builder().working_bytes(1);
        self.budget.check_bytes(primitives.saturating_mul(each))?;
        Ok(limit.min(bytes / each))
    }

    fn root<P: Clip>(&self, references: Vec<Reference>, primitives: &[P], spare: usize) -> Node {
        let fragments = references
            .into_iter()
            .map(|gate| Fragment::whole(gate, primitives))
            .collect();
        let fragments = match self.object_split {
            ObjectSplit::FullSweep => Fragments::sorted(fragments),
            ObjectSplit::Binned { .. } => Fragments::unsorted(fragments),
        };
        let allowance = (self.spending == Spending::Shares).then_some(spare);
        Node::new(fragments, 0, allowance)
    }

    fn partitioning<'a, P: Clip>(
        &self,
        primitives: &'a [P],
        root: &Node,
        rules: NodeRules,
    ) -> Partitioning<'a, P> {
        Partitioning {
            rules,
            object_split: self.object_split,
            spatial: SpatialSearch {
                primitives,
                clipping: self.clipping,
                bins: self.spatial_bins,
                bins_per_reference: self.bins_per_reference,
            },
            divisor: Divisor {
                primitives,
                unsplitting: self.unsplitting,
            },
            tolerated_overlap: self.alpha * root.tight.half_area(),
        }
    }
}
