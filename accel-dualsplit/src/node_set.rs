//! Which nodes a tree is made of: what tells a dual-split tree, a BIH and an
//! H-tree apart, once they are built.

use accel_core::statistics::TraversalStatistics;

use crate::codec::{CarvingPlanes, FirstWord, Header};
use crate::traversal::PlaneTest;

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
    const CARVES_SEVERAL_AXES: bool = true;

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
    fn carve_several_axes<S: TraversalStatistics>(
        test: &PlaneTest,
        node: FirstWord,
        words: &[u32],
        interval: (f32, f32),
        statistics: &mut S,
    ) -> (f32, f32) {
        test.carve_two_axes(node, words, interval, statistics)
    }
}

/// What the crate needs to know of a set of nodes.
pub trait Nodes: Copy + Send + Sync + std::fmt::Debug + 'static {
    /// The name of its archives.
    const ARCHIVE_KIND: [u8; 8];

    /// Whether there are carving nodes on more than one axis.
    const CARVES_SEVERAL_AXES: bool;

    /// Whether a node with this header belongs to the set.
    fn admits(header: Header) -> bool;

    /// Words of the first child of a splitting node.
    fn first_child_words(node: FirstWord) -> u32;

    /// What a carving node on several axes, at the start of `words`, leaves of an
    /// interval; its visit is told to `statistics`.
    fn carve_several_axes<S: TraversalStatistics>(
        test: &PlaneTest,
        node: FirstWord,
        words: &[u32],
        interval: (f32, f32),
        statistics: &mut S,
    ) -> (f32, f32);
}
