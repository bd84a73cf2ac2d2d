//! The tree.

use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::query::Query;
use accel_core::statistics::{NodeKind, TraversalStatistics, TreeOutline};
use accel_core::{Aabb, AccelerationStructure, PreparedRay, Primitive};

use crate::node::{INNER_WORDS, InnerNode, Node, NodePointer};

/// A bounding volume hierarchy in the uncompressed layout of Lin 2019: 52 bytes
/// an inner node, 4 bytes a leaf. Made by [`BvhBuilder`](crate::BvhBuilder);
/// owns its primitives.
#[derive(Clone, Debug)]
pub struct Bvh<P: Primitive> {
    pub(crate) words: Vec<u32>,
    pub(crate) stored: StoredPrimitives<P>,
    /// `None` where there is nothing to hit.
    pub(crate) root: Option<Root>,
    /// Edges from the root to the deepest leaf.
    pub(crate) depth: u32,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Root {
    pub bounds: Aabb,
    pub pointer: NodePointer,
}

impl<P: Primitive> Bvh<P> {
    /// The nodes as stored: the same for equal input and settings, whatever the
    /// number of threads.
    pub fn node_words(&self) -> &[u32] {
        &self.words
    }

    /// Edges from the root to the deepest leaf.
    pub fn depth(&self) -> u32 {
        self.depth
    }

    #[inline]
    pub(crate) fn inner_node(&self, offset: u32) -> InnerNode<'_> {
        let words = &self.words[offset as usize..offset as usize + INNER_WORDS];
        // The slice has that length, so this never fails.
        InnerNode(words.first_chunk().expect("an inner node has 13 words"))
    }

    #[inline]
    pub(crate) fn leaf_number(&self, offset: u32) -> u32 {
        self.words[offset as usize]
    }
}

impl<P: Primitive> AccelerationStructure for Bvh<P> {
    type Primitive = P;
    type Storage = P::Storage;

    #[inline]
    fn traverse<Q: Query, S: TraversalStatistics>(
        &self,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) {
        crate::traversal::traverse(self, ray, query, statistics);
    }

    fn bounds(&self) -> Option<Aabb> {
        self.root.map(|root| root.bounds)
    }

    fn stored(&self) -> &StoredPrimitives<P> {
        &self.stored
    }

    fn node_bytes(&self) -> usize {
        size_of_val(self.words.as_slice())
    }

    fn outline(&self) -> TreeOutline {
        let mut outline = TreeOutline::default();
        let mut pending: Vec<_> = self
            .root
            .map(|root| (root.pointer, root.bounds, None))
            .into_iter()
            .collect();
        while let Some((pointer, bounds, parent)) = pending.pop() {
            match pointer.kind() {
                Node::Leaf(offset) => {
                    let ids = self.stored.leaves().leaf_ids(self.leaf_number(offset));
                    outline.push_leaf(bounds, parent, ids);
                }
                Node::Inner(offset) => {
                    let node = self.inner_node(offset);
                    let position = outline.push_inner(NodeKind::Inner, bounds, parent);
                    let children = node.children().pointers().into_iter().zip(node.bounds());
                    pending.extend(
                        children
                            .rev()
                            .map(|(child, bounds)| (child, bounds, Some(position))),
                    );
                }
            }
        }
        outline
    }
}
