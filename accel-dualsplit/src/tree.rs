//! The tree.

use std::marker::PhantomData;

use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::query::Query;
use accel_core::statistics::{NodeKind, TraversalStatistics, TreeOutline};
use accel_core::{Aabb, AccelerationStructure, PreparedRay, Primitive};

use crate::codec::{Header, Node, NodeWords};
use crate::node_set::{DualSplitNodes, NodeSet};

/// A dual-split tree. Made from a BVH by a
/// [`DualSplitConverter`](crate::DualSplitConverter).
pub type DualSplitTree<P> = PlaneTree<P, DualSplitNodes>;

/// A tree of nodes that split by two planes or carve by some, of the kinds in `N`;
/// owns its primitives.
#[derive(Clone, Debug)]
pub struct PlaneTree<P: Primitive, N: NodeSet> {
    pub(crate) words: NodeWords,
    pub(crate) stored: StoredPrimitives<P>,
    /// The box of the root, whose node comes first; `None` where there is
    /// nothing to hit.
    pub(crate) bounds: Option<Aabb>,
    /// Splitting nodes on the longest path.
    pub(crate) depth: u32,
    pub(crate) nodes: PhantomData<N>,
}

impl<P: Primitive, N: NodeSet> PlaneTree<P, N> {
    /// The nodes as stored: the same for equal input and settings, whatever the
    /// number of threads.
    pub fn node_words(&self) -> &[u32] {
        self.words.nodes()
    }

    /// Splitting nodes on the path from the root that has most of them: as many
    /// nodes can a ray put off.
    pub fn depth(&self) -> u32 {
        self.depth
    }

    /// The node at a position that an encoder of this crate wrote.
    pub(crate) fn node(&self, position: usize) -> Node {
        Node::decode(self.words.nodes(), position).expect("the tree's own words are sound")
    }
}

impl<P: Primitive, N: NodeSet> AccelerationStructure for PlaneTree<P, N> {
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
        self.bounds
    }

    fn stored(&self) -> &StoredPrimitives<P> {
        &self.stored
    }

    fn node_bytes(&self) -> usize {
        size_of_val(self.words.nodes())
    }

    /// A carving node that is a leaf counts as two: it carves, then it is a leaf.
    fn outline(&self) -> TreeOutline {
        let mut outline = TreeOutline::default();
        let mut pending = Vec::from_iter(self.bounds.map(|bounds| (0, bounds, None)));
        while let Some((position, bounds, parent)) = pending.pop() {
            let node = self.node(position);
            let regions = node.child_regions(bounds);
            let parent = match node.header {
                Header::Leaf => parent,
                Header::Splitting { .. } => {
                    Some(outline.push_inner(NodeKind::Splitting, bounds, parent))
                }
                Header::Carving { .. } => {
                    Some(outline.push_inner(NodeKind::Carving, bounds, parent))
                }
            };
            if node.header.is_leaf() {
                let ids = self.stored.leaves().leaf_ids(node.target as u32);
                outline.push_leaf(regions[0], parent, ids);
            }
            let children: Vec<_> = node.children().zip(regions).collect();
            pending.extend(
                children
                    .into_iter()
                    .rev()
                    .map(|(child, region)| (child, region, parent)),
            );
        }
        outline
    }
}
