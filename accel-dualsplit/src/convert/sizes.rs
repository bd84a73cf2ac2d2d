//! How much is below each node of a BVH: what equation 1 weighs, and by what the
//! conversion decides where to fork.

use accel_bvh::{Bvh, BvhNode, NodeHandle};
use accel_core::build::join;
use accel_core::layout::LeafStorage;
use accel_core::{AccelerationStructure, Primitive};

use super::splitting::Weighed;

/// Sizes of all inner nodes, in depth-first order: an inner left child follows
/// its parent, and an inner right child all that is below the left one.
pub(super) struct SubtreeSizes(Vec<InnerSize>);

#[derive(Clone, Copy)]
struct InnerSize {
    references: u32,
    /// Inner nodes of the subtree, its root included.
    inner_nodes: u32,
}

/// A node of a BVH, and what is below it.
#[derive(Clone, Copy)]
pub(super) struct SizedNode {
    pub handle: NodeHandle,
    /// References below it.
    pub references: u32,
    /// Its place among the inner nodes, where that of the next one would be for a
    /// leaf.
    index: usize,
}

impl Weighed for SizedNode {
    fn references(&self) -> u32 {
        self.references
    }
}

/// Subtrees this far below the root are measured by one thread each.
const FORK_DEPTH: u32 = 7;

impl SubtreeSizes {
    pub(super) fn new<P: Primitive>(bvh: &Bvh<P>, root: NodeHandle) -> Self {
        let mut sizes = Vec::new();
        measure(bvh, root, 0, &mut sizes);
        Self(sizes)
    }

    pub(super) fn root<P: Primitive>(&self, bvh: &Bvh<P>, root: NodeHandle) -> SizedNode {
        self.sized(bvh, root, 0)
    }

    /// The children of an inner node, left and right.
    pub(super) fn children<P: Primitive>(
        &self,
        bvh: &Bvh<P>,
        parent: SizedNode,
        [left, right]: [NodeHandle; 2],
    ) -> [SizedNode; 2] {
        let left = self.sized(bvh, left, parent.index + 1);
        let below_left = if left.handle.is_leaf() {
            0
        } else {
            self.0[left.index].inner_nodes as usize
        };
        let right = self.sized(bvh, right, left.index + below_left);
        [left, right]
    }

    fn sized<P: Primitive>(&self, bvh: &Bvh<P>, handle: NodeHandle, index: usize) -> SizedNode {
        let references = match bvh.node(handle) {
            BvhNode::Leaf(leaf) => leaf_size(bvh, leaf),
            BvhNode::Inner { .. } => self.0[index].references,
        };
        SizedNode {
            handle,
            references,
            index,
        }
    }
}

fn leaf_size<P: Primitive>(bvh: &Bvh<P>, leaf: u32) -> u32 {
    bvh.stored().leaves().leaf_ids(leaf).count() as u32
}

/// Appends the sizes of the subtree of `handle` and returns its references. The
/// recursion is as deep as the tree, whose depth is bounded.
fn measure<P: Primitive>(
    bvh: &Bvh<P>,
    handle: NodeHandle,
    depth: u32,
    sizes: &mut Vec<InnerSize>,
) -> u32 {
    let [left, right] = match bvh.node(handle) {
        BvhNode::Leaf(leaf) => return leaf_size(bvh, leaf),
        BvhNode::Inner { children, .. } => children,
    };
    let index = sizes.len();
    sizes.push(InnerSize {
        references: 0,
        inner_nodes: 0,
    });
    let references = if depth < FORK_DEPTH {
        let mut right_sizes = Vec::new();
        let (left, right) = join(
            || measure(bvh, left, depth + 1, sizes),
            || measure(bvh, right, depth + 1, &mut right_sizes),
        );
        sizes.append(&mut right_sizes);
        left + right
    } else {
        measure(bvh, left, depth + 1, sizes) + measure(bvh, right, depth + 1, sizes)
    };
    sizes[index] = InnerSize {
        references,
        inner_nodes: (sizes.len() - index) as u32,
    };
    references
}
