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

use accel_bvh::Bvh;
use accel_core::layout::StoredPrimitives;
use accel_core::{BuildBudget, BuildError, Primitive};

use crate::tree::DualSplitTree;
use packing::Packing;
use sizes::SubtreeSizes;

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

impl CarvingCosts {
    fn validate(&self) -> Result<(), BuildError> {
        let costs = [
            ("carving_costs.single_axis", self.single_axis),
            ("carving_costs.dual_axis", self.dual_axis),
        ];
        for (setting, cost) in costs {
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
        let (words, depth) = self.words_of(bvh)?;
        let stored: StoredPrimitives<P> = accel_core::AccelerationStructure::stored(bvh).clone();
        Ok(DualSplitTree {
            words,
            stored,
            bounds: bvh.root().map(|(_, bounds)| bounds),
            depth,
        })
    }

    /// The words of the tree, and its depth.
    fn words_of<P: Primitive>(&self, bvh: &Bvh<P>) -> Result<(Vec<u32>, u32), BuildError> {
        self.carving_costs.validate()?;
        self.budget.validate()?;
        let Some((root, bounds)) = bvh.root() else {
            return Ok((Vec::new(), 0));
        };
        self.budget.check_bytes(packing::most_bytes(bvh))?;
        let sizes = SubtreeSizes::new(bvh, root);
        let words = Packing::new(self, bvh, &sizes).pack(root, bounds)?;
        Ok((words, bvh.depth()))
    }
}
