//! Which nodes a tree is made of: what tells a dual-split tree, a BIH and an
//! H-tree apart, once they are built.

use accel_core::PreparedRay;
use accel_core::statistics::{NodeKind, TraversalStatistics};

use crate::codec::{CarvingPlanes, FirstWord, Header};
use crate::traversal::{AxisTests, NodePlace, SideTests, visit_two_planes};

/// A set of nodes that a [`PlaneTree`](crate::PlaneTree) may consist of: those of
/// dual-split trees, of a BIH or of an H-tree. Sealed.
pub trait NodeSet: Nodes {}

/// The nodes of a dual-split tree: splitting nodes, carving nodes on one axis and
/// on two.
#[derive(Clone, Copy, Debug)]
pub struct DualSplitNodes;

impl NodeSet for DualSplitNodes {}

impl Nodes for DualSplitNodes {
    const ARCHIVE_KIND: [u8; 8] = *b"acceldst";

    type CarvingTest = SideTests;

    fn admits(header: Header) -> bool {
        match header {
            Header::Leaf => true,
            Header::Splitting {
                first_child_words, ..
            } => first_child_words <= 3,
            Header::Carving { planes, .. } => !matches!(planes, CarvingPlanes::Bounding(_)),
        }
    }

    #[inline(always)]
    fn first_child_words(node: FirstWord) -> u32 {
        node.small_first_child_words()
    }

    #[inline(always)]
    fn carving_test(ray: &PreparedRay) -> SideTests {
        SideTests::new(ray)
    }

    #[inline(always)]
    fn carve<S: TraversalStatistics>(
        sides: &SideTests,
        _: &AxisTests,
        place: &NodePlace<'_>,
        interval: (f32, f32),
        statistics: &mut S,
    ) -> (f32, f32) {
        let node = place.first_word();
        if node.carves() {
            visit_two_planes(statistics, NodeKind::Carving);
        }
        sides.cut(node, place.planes(), interval)
    }
}

/// What the crate needs to know of a set of nodes.
pub trait Nodes: Copy + Send + Sync + std::fmt::Debug + 'static {
    /// The name of its archives.
    const ARCHIVE_KIND: [u8; 8];

    /// What carving nodes take of a ray, besides the tests of axes.
    type CarvingTest;

    /// Whether a node with this header belongs to the set.
    fn admits(header: Header) -> bool;

    /// Words of the first child of a splitting node.
    fn first_child_words(node: FirstWord) -> u32;

    /// Prepares a ray for carving nodes.
    fn carving_test(ray: &PreparedRay) -> Self::CarvingTest;

    /// What a node that does not split leaves of an interval. The visit of a carving
    /// node is told to `statistics`; a plain leaf leaves all.
    fn carve<S: TraversalStatistics>(
        test: &Self::CarvingTest,
        axes: &AxisTests,
        place: &NodePlace<'_>,
        interval: (f32, f32),
        statistics: &mut S,
    ) -> (f32, f32);
}
