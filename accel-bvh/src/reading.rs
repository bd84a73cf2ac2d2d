//! Reading a finished tree node by node: for structures that are converted from
//! a BVH.

use accel_core::{Aabb, Primitive};

use crate::Bvh;
use crate::node::{Node, NodePointer};

/// Names a node of one [`Bvh`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodeHandle(NodePointer);

/// A node of a [`Bvh`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BvhNode {
    /// A leaf: its number in the tree's leaf storage.
    Leaf(u32),
    /// An inner node: the boxes of its left and its right child, and the two.
    Inner {
        /// The children's boxes.
        bounds: [Aabb; 2],
        /// The children.
        children: [NodeHandle; 2],
    },
}

impl NodeHandle {
    /// Whether the node is a leaf: known without reading it.
    #[inline]
    pub fn is_leaf(self) -> bool {
        matches!(self.0.kind(), Node::Leaf(_))
    }
}

impl<P: Primitive> Bvh<P> {
    /// The root and its box; `None` where there is nothing to hit.
    pub fn root(&self) -> Option<(NodeHandle, Aabb)> {
        self.root
            .map(|root| (NodeHandle(root.pointer), root.bounds))
    }

    /// The node that `handle` names.
    ///
    /// # Panics
    /// If `handle` is of another, larger tree.
    #[inline]
    pub fn node(&self, handle: NodeHandle) -> BvhNode {
        match handle.0.kind() {
            Node::Leaf(offset) => BvhNode::Leaf(self.leaf_number(offset)),
            Node::Inner(offset) => {
                let node = self.inner_node(offset);
                BvhNode::Inner {
                    bounds: node.bounds(),
                    children: node.children().pointers().map(NodeHandle),
                }
            }
        }
    }
}
