//! The H-tree, from the same BVH.
//!
//! An H-tree is a spatial kd-tree, whose nodes split by two planes on one axis,
//! with bounding nodes in between that cut empty space off by the planes of a box.
//! Ours bound one axis, two or three, by two planes on each.
//!
//! Lin 2019 compares with a layout of its supplement, which we do not have. Ours is
//! the dual-split tree's with a larger bounding node: 12 bytes for two planes, 20
//! for four, 28 for six, 4 for a leaf. Departures from the original:
//! - it has more widths of nodes, and builds the tree itself; as in Lin 2019 ours is
//!   converted from a BVH and has its boxes.
//! - A bounding node of the original is inserted where its cost model finds that it
//!   pays, and bounds what it likes; with identical boxes the only choice is how the
//!   planes are put into nodes, nested or together. Equation 1 of Lin 2019 decides,
//!   with a cost for each size of node.
//! - A bounding node may be a leaf.
//!
//! Source: Havran, Herzog and Seidel, *On the Fast Construction of Spatial
//! Hierarchies for Ray Tracing*, IEEE Symposium on Interactive Ray Tracing 2006.

use accel_bvh::Bvh;
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::{BuildBudget, BuildError, PreparedRay, Primitive};

use crate::codec::{CarvingPlanes, FirstWord, Header};
use crate::convert::{CarvingRules, NodeCosts, Partitioning};
use crate::node_set::{NodeSet, Nodes};
use crate::traversal::{AxisTests, NodePlace, visit_two_planes};
use crate::tree::PlaneTree;

/// An H-tree. Made from a BVH by an [`HTreeConverter`].
pub type HTree<P> = PlaneTree<P, HTreeNodes>;

/// The nodes of an H-tree: splitting nodes, and bounding nodes on one axis or more.
#[derive(Clone, Copy, Debug)]
pub struct HTreeNodes;

/// Converts a [`Bvh`], whoever built it, to an [`HTree`] with the same boxes.
///
/// ```
/// use accel_dualsplit::{BvhBuilder, HTreeConverter, Sphere};
/// # fn main() -> Result<(), accel_dualsplit::BuildError> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let h_tree = HTreeConverter::default().convert(&BvhBuilder::default().build(&spheres)?)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HTreeConverter {
    /// What visiting a bounding node costs.
    pub bounding_costs: BoundingCosts,
    /// Limits on memory. The depth is that of the BVH.
    pub budget: BuildBudget,
}

/// What visiting a bounding node costs, in tests of a primitive. Positive and
/// finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingCosts {
    /// Two planes, on one axis.
    pub one_axis: f64,
    /// Four planes.
    pub two_axes: f64,
    /// Six planes: a box.
    pub three_axes: f64,
}

impl Default for BoundingCosts {
    /// The dual-split tree's cost for one axis, 0.3, and 0.2 for each axis more.
    fn default() -> Self {
        Self {
            one_axis: 0.3,
            two_axes: 0.5,
            three_axes: 0.7,
        }
    }
}

impl HTreeConverter {
    /// Converts `bvh`. The primitives in its leaves are copied; hits name them as
    /// before.
    ///
    /// # Errors
    /// [`BuildError::OffsetOverflow`] if an offset or the number of a leaf takes
    /// more than 26 bits, [`BuildError::BudgetExceeded`],
    /// [`BuildError::InvalidSetting`].
    pub fn convert<P: Primitive>(&self, bvh: &Bvh<P>) -> Result<HTree<P>, BuildError> {
        let costs = self.bounding_costs;
        NodeCosts::check(&[
            ("bounding_costs.one_axis", costs.one_axis),
            ("bounding_costs.two_axes", costs.two_axes),
            ("bounding_costs.three_axes", costs.three_axes),
        ])?;
        let rules = CarvingRules {
            partitioning: Partitioning::Identical,
            costs: NodeCosts {
                single_axis: costs.one_axis,
                dual_axis: None,
                bounding: Some([costs.two_axes, costs.three_axes]),
            },
        };
        rules.convert(bvh, &self.budget)
    }
}

impl NodeSet for HTreeNodes {}

impl Nodes for HTreeNodes {
    const ARCHIVE_KIND: [u8; 8] = *b"accelhtr";

    type CarvingTest = ();

    fn admits(header: Header) -> bool {
        match header {
            Header::Leaf | Header::Splitting { .. } => true,
            Header::Carving { planes, .. } => !matches!(planes, CarvingPlanes::Dual(..)),
        }
    }

    #[inline(always)]
    fn first_child_words(node: FirstWord) -> u32 {
        node.first_child_words()
    }

    #[inline(always)]
    fn carving_test(_: &PreparedRay) {}

    #[inline(always)]
    fn carve<S: TraversalStatistics>(
        (): &(),
        axes: &AxisTests,
        place: &NodePlace<'_>,
        mut interval: (f32, f32),
        statistics: &mut S,
    ) -> (f32, f32) {
        let node = place.first_word();
        if node.is_on_several_axes() {
            let bounded = node.bounded_axes().axes();
            let planes = 2 * bounded.len() as u32;
            statistics.visit_node(NodeKind::Carving, 4 * (1 + planes));
            statistics.test_planes(planes);
            let (pairs, _) = place.planes_and_rest().as_chunks();
            for (&axis, pair) in bounded.iter().zip(pairs) {
                interval = axes.on(axis).cut(pair, interval);
            }
            return interval;
        }
        if node.is_plain_leaf() {
            return interval;
        }
        visit_two_planes(statistics, NodeKind::Carving);
        axes.of(node).cut(place.planes(), interval)
    }
}
