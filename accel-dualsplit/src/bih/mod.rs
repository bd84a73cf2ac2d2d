//! The bounding interval hierarchy (BIH), from the same BVH.
//!
//! A BIH splits a node by two planes on one axis, which bound the children and may
//! overlap (Wächter and Keller 2006). Its later form has nodes that cut empty space
//! off one child by two planes on one axis (Wächter 2008), which is what lets it
//! follow the boxes of a BVH. So its nodes are those of a dual-split tree, without
//! dual-axis carving: both planes of an axis or none.
//!
//! Lin 2019 compares with a layout of its supplement, which we do not have. Ours is
//! that of the dual-split tree: 12 bytes for two planes and what else there is, 4
//! for a leaf. Departures:
//! - a node of the original holds its children's planes, axis and index in 12
//!   bytes as well, but leaves take as much, with a count of primitives; ours are
//!   those of the dual-split tree.
//! - The original's builder is top-down and places its planes without a cost; as in
//!   Lin 2019 the tree is converted from a BVH, by equation 1.
//! - A carving node may be a leaf.
//!
//! Source: Wächter and Keller, *Instant Ray Tracing: The Bounding Interval
//! Hierarchy*, Eurographics Symposium on Rendering 2006.

use accel_bvh::Bvh;
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::{BuildBudget, BuildError, PreparedRay, Primitive};

use crate::codec::{CarvingPlanes, FirstWord, Header};
use crate::convert::{CarvingRules, NodeCosts, Partitioning};
use crate::node_set::{NodeSet, Nodes};
use crate::traversal::{AxisTests, NodePlace, visit_two_planes};
use crate::tree::PlaneTree;

/// A bounding interval hierarchy. Made from a BVH by a [`BihConverter`].
pub type Bih<P> = PlaneTree<P, BihNodes>;

/// The nodes of a BIH: splitting nodes, and carving nodes on one axis.
#[derive(Clone, Copy, Debug)]
pub struct BihNodes;

/// Converts a [`Bvh`], whoever built it, to a [`Bih`] with the same boxes.
///
/// ```
/// use accel_dualsplit::{BihConverter, BvhBuilder, Sphere};
/// # fn main() -> Result<(), accel_dualsplit::BuildError> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let bih = BihConverter::default().convert(&BvhBuilder::default().build(&spheres)?)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BihConverter {
    /// What visiting a carving node costs, in tests of a primitive. Positive and
    /// finite.
    pub carving_cost: f64,
    /// Limits on memory. The depth is that of the BVH.
    pub budget: BuildBudget,
}

impl Default for BihConverter {
    /// The dual-split tree's cost of carving on one axis, 0.3.
    fn default() -> Self {
        Self {
            carving_cost: 0.3,
            budget: BuildBudget::default(),
        }
    }
}

impl BihConverter {
    /// Converts `bvh`. The primitives in its leaves are copied; hits name them as
    /// before.
    ///
    /// # Errors
    /// [`BuildError::OffsetOverflow`] if an offset or the number of a leaf takes
    /// more than 26 bits, [`BuildError::BudgetExceeded`],
    /// [`BuildError::InvalidSetting`].
    pub fn convert<P: Primitive>(&self, bvh: &Bvh<P>) -> Result<Bih<P>, BuildError> {
        NodeCosts::check(&[("carving_cost", self.carving_cost)])?;
        let rules = CarvingRules {
            partitioning: Partitioning::Identical,
            costs: NodeCosts {
                single_axis: self.carving_cost,
                dual_axis: None,
                bounding: None,
            },
        };
        rules.convert(bvh, &self.budget)
    }
}

impl NodeSet for BihNodes {}

impl Nodes for BihNodes {
    const ARCHIVE_KIND: [u8; 8] = *b"accelbih";

    type CarvingTest = ();

    fn admits(header: Header) -> bool {
        match header {
            Header::Leaf => true,
            Header::Splitting {
                first_child_words, ..
            } => first_child_words <= 3,
            Header::Carving { planes, .. } => matches!(planes, CarvingPlanes::Single(_)),
        }
    }

    #[inline(always)]
    fn first_child_words(node: FirstWord) -> u32 {
        node.small_first_child_words()
    }

    #[inline(always)]
    fn carving_test(_: &PreparedRay) {}

    #[inline(always)]
    fn carve<S: TraversalStatistics>(
        (): &(),
        axes: &AxisTests,
        place: &NodePlace<'_>,
        interval: (f32, f32),
        statistics: &mut S,
    ) -> (f32, f32) {
        let node = place.first_word();
        if node.is_plain_leaf() {
            return interval;
        }
        visit_two_planes(statistics, NodeKind::Carving);
        axes.of(node).cut(place.planes(), interval)
    }
}
