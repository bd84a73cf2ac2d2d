//! From a BVH to a dual-split tree (Lin 2019, section 4.2).
//!
//! ```text
//! convert(BVH node with children L and R, region S that is left of space):
//!     for each axis k: order the children along k, split S between them,
//!         find the cheapest nested carving nodes for both (equation 1)
//!     write the splitting node of the cheapest axis, and its carving nodes
//!     convert both children, each in the region that its carving has left
//! ```
//!
//! *Identical* carves until the region is the child's box; *similar* only as far
//! as it pays, and goes on with the larger region.

mod carving;
mod packing;
mod sizes;
mod splitting;

use std::marker::PhantomData;

use accel_bvh::Bvh;
use accel_core::{AccelerationStructure, BuildBudget, BuildError, Primitive};

use crate::codec::{CarvingPlanes, MAX_WORDS, NodeWords};
use crate::node_set::NodeSet;
use crate::tree::{DualSplitTree, PlaneTree};
use packing::Packing;
use sizes::SubtreeSizes;

pub(crate) use carving::CarvingChoices;
pub(crate) use splitting::{SplittingPlan, Weighed};

/// Converts a [`Bvh`], whoever built it, to a [`DualSplitTree`].
///
/// ```
/// use accel_dualsplit::{BvhBuilder, CarvingCosts, DualSplitConverter, Partitioning, Sphere};
/// # fn main() -> Result<(), accel_dualsplit::BuildError> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let bvh = BvhBuilder::default().build(&spheres)?;
/// let converter = DualSplitConverter {
///     partitioning: Partitioning::Identical,
///     carving_costs: CarvingCosts { single_axis: 0.3, dual_axis: 0.5 },
///     ..DualSplitConverter::default()
/// };
/// let tree = converter.convert(&bvh)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DualSplitConverter {
    /// How closely the tree follows the boxes of the BVH.
    pub partitioning: Partitioning,
    /// What visiting a carving node costs.
    pub carving_costs: CarvingCosts,
    /// Limits on memory. The depth is that of the BVH.
    pub budget: BuildBudget,
}

/// How closely a dual-split tree follows the boxes of its BVH.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Partitioning {
    /// Every box, exactly: the leaves that a ray can reach are those of the BVH
    /// (section 4.2.1).
    Identical,
    /// Carving is put off where it costs more than it saves; smaller, and about
    /// as fast (section 4.2.2).
    #[default]
    Similar,
}

/// What visiting a carving node costs, in tests of a primitive: sigma of
/// equation 1. Positive and finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarvingCosts {
    /// Both planes on one axis.
    pub single_axis: f64,
    /// A plane on each of two axes.
    pub dual_axis: f64,
}

impl Default for CarvingCosts {
    /// The paper's: 0.3 and 0.5.
    fn default() -> Self {
        Self {
            single_axis: 0.3,
            dual_axis: 0.5,
        }
    }
}

impl DualSplitConverter {
    /// Converts `bvh`. The primitives in their leaves are copied; hits name them
    /// as before.
    ///
    /// # Errors
    /// [`BuildError::OffsetOverflow`] if an offset or the number of a leaf takes
    /// more than 26 bits, [`BuildError::BudgetExceeded`],
    /// [`BuildError::InvalidSetting`].
    pub fn convert<P: Primitive>(&self, bvh: &Bvh<P>) -> Result<DualSplitTree<P>, BuildError> {
        NodeCosts::check_carving(&self.carving_costs)?;
        let rules = CarvingRules {
            partitioning: self.partitioning,
            costs: self.carving_costs.into(),
        };
        rules.convert(bvh, &self.budget)
    }
}

/// How a conversion carves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CarvingRules {
    pub partitioning: Partitioning,
    pub costs: NodeCosts,
}

/// What carving nodes cost, in tests of a primitive; `None` for those that a tree
/// does not have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NodeCosts {
    pub single_axis: f64,
    pub dual_axis: Option<f64>,
    /// Bounding nodes on two axes and on three.
    pub bounding: Option<[f64; 2]>,
}

impl From<CarvingCosts> for NodeCosts {
    fn from(costs: CarvingCosts) -> Self {
        Self {
            single_axis: costs.single_axis,
            dual_axis: Some(costs.dual_axis),
            bounding: None,
        }
    }
}

impl NodeCosts {
    /// Checks the costs of a dual-split tree.
    pub(crate) fn check_carving(costs: &CarvingCosts) -> Result<(), BuildError> {
        Self::check(&[
            ("carving_costs.single_axis", costs.single_axis),
            ("carving_costs.dual_axis", costs.dual_axis),
        ])
    }

    /// Checks costs, each with the name of its setting.
    pub(crate) fn check(costs: &[(&'static str, f64)]) -> Result<(), BuildError> {
        for &(setting, cost) in costs {
            if !(cost > 0.0 && cost.is_finite()) {
                return Err(BuildError::InvalidSetting {
                    setting,
                    value: cost.to_string(),
                    allowed: "positive and finite",
                });
            }
        }
        Ok(())
    }

    /// Sigma of equation 1; infinite for a node that the tree does not have.
    fn sigma(&self, planes: CarvingPlanes) -> f64 {
        let cost = match planes {
            CarvingPlanes::Single(_) => Some(self.single_axis),
            CarvingPlanes::Dual(..) => self.dual_axis,
            CarvingPlanes::Bounding(bounded) => {
                let is_box = bounded.axes().len() == 3;
                self.bounding.map(|costs| costs[usize::from(is_box)])
            }
        };
        cost.unwrap_or(f64::INFINITY)
    }
}

impl CarvingRules {
    pub(crate) fn convert<P: Primitive, N: NodeSet>(
        &self,
        bvh: &Bvh<P>,
        budget: &BuildBudget,
    ) -> Result<PlaneTree<P, N>, BuildError> {
        budget.validate()?;
        let words = match bvh.root() {
            None => Vec::new(),
            Some((root, bounds)) => {
                budget.check_bytes(packing::most_bytes(bvh))?;
                let sizes = SubtreeSizes::new(bvh, root);
                let choices = CarvingChoices::new(self);
                Packing::new(&choices, bvh, &sizes).pack(root, bounds)?
            }
        };
        if words.len() > MAX_WORDS {
            return Err(BuildError::OffsetOverflow {
                needed: words.len(),
                limit: MAX_WORDS,
            });
        }
        Ok(PlaneTree {
            words: NodeWords::new(words),
            stored: AccelerationStructure::stored(bvh).clone(),
            bounds: bvh.bounds(),
            depth: bvh.depth(),
            nodes: PhantomData,
        })
    }
}
