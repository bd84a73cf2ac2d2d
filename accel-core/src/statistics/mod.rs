//! What a traversal did, and what a tree is like.

mod counters;
mod end_point_overlap;
mod outline;
mod tree;

pub use counters::{Count, TraversalCounters};
pub use end_point_overlap::{SurfaceArea, end_point_overlap};
pub use outline::{OutlineNode, TreeOutline};
pub use tree::{BytesByPart, TreeStatistics};

/// The kinds of nodes that structures are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NodeKind {
    /// Has children and decides between them.
    Inner,
    /// Of a BSP tree: an inner node whose plane is not orthogonal to an axis.
    General,
    /// References primitives.
    Leaf,
    /// Of a dual-split tree: separates two children by two planes.
    Splitting,
    /// Of a dual-split tree: cuts empty space off its one child.
    Carving,
}

/// Watches a traversal. The unit type `()` watches nothing and costs nothing;
/// [`TraversalCounters`] counts.
pub trait TraversalStatistics {
    /// A node of `bytes` bytes is read.
    #[inline]
    fn visit_node(&mut self, kind: NodeKind, bytes: u32) {
        let _ = (kind, bytes);
    }

    /// `count` boxes are tested, six planes each.
    #[inline]
    fn test_boxes(&mut self, count: u32) {
        let _ = count;
    }

    /// `count` single planes are tested.
    #[inline]
    fn test_planes(&mut self, count: u32) {
        let _ = count;
    }

    /// `count` primitives are tested.
    #[inline]
    fn test_primitives(&mut self, count: u32) {
        let _ = count;
    }

    /// A query of one ray is over.
    #[inline]
    fn finish_ray(&mut self) {}
}

impl TraversalStatistics for () {}
