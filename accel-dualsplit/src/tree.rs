//! The tree.

use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::query::Query;
use accel_core::statistics::{NodeKind, TraversalStatistics, TreeOutline};
use accel_core::{Aabb, AccelerationStructure, PacketTraversal, PreparedRay, Primitive};

use crate::codec::{CarvingPlanes, Header, Node};

/// A dual-split tree. Made from a BVH by a
/// [`DualSplitConverter`](crate::DualSplitConverter); owns its primitives.
#[derive(Clone, Debug)]
pub struct DualSplitTree<P: Primitive> {
    pub(crate) words: Vec<u32>,
    pub(crate) stored: StoredPrimitives<P>,
    /// The box of the root, whose node comes first; `None` where there is
    /// nothing to hit.
    pub(crate) bounds: Option<Aabb>,
    /// Splitting nodes on the longest path.
    pub(crate) depth: u32,
}

impl<P: Primitive> DualSplitTree<P> {
    /// The nodes as stored: the same for equal input and settings, whatever the
    /// number of threads.
    pub fn node_words(&self) -> &[u32] {
        &self.words
    }

    /// Splitting nodes on the path from the root that has most of them: as many
    /// nodes can a ray put off.
    pub fn depth(&self) -> u32 {
        self.depth
    }

    /// The node at a position that an encoder of this crate wrote.
    pub(crate) fn node(&self, position: usize) -> Node {
        Node::decode(&self.words, position).expect("the tree's own words are sound")
    }
}

impl<P: Primitive> AccelerationStructure for DualSplitTree<P> {
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
        size_of_val(self.words.as_slice())
    }

    /// A carving node that is a leaf counts as two: it carves, then it is a leaf.
    fn outline(&self) -> TreeOutline {
        let mut outline = TreeOutline::default();
        let mut pending: Vec<_> = self
            .bounds
            .map(|bounds| (0, bounds, None))
            .into_iter()
            .collect();
        while let Some((position, bounds, parent)) = pending.pop() {
            let node = self.node(position);
            let (parent, regions) = match node.header {
                Header::Leaf => (parent, [bounds; 2]),
                Header::Splitting { .. } => {
                    let kind = NodeKind::Splitting;
                    let parent = outline.push_inner(kind, bounds, parent);
                    (Some(parent), node.child_regions(bounds))
                }
                Header::Carving { .. } => {
                    let kind = NodeKind::Carving;
                    let parent = outline.push_inner(kind, bounds, parent);
                    (Some(parent), node.child_regions(bounds))
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

impl Node {
    /// What the planes leave of `region`: of a splitting node for each child, of
    /// a carving node for its one child, twice.
    pub(crate) fn child_regions(&self, region: Aabb) -> [Aabb; 2] {
        let [first, second] = self.planes;
        match self.header {
            Header::Leaf => [region; 2],
            Header::Splitting { axis, .. } => [
                region.with_range(axis, f32::NEG_INFINITY, first),
                region.with_range(axis, second, f32::INFINITY),
            ],
            Header::Carving { planes, .. } => {
                let carved = match planes {
                    CarvingPlanes::Single(axis) => region.with_range(axis, second, first),
                    CarvingPlanes::Dual(a, b) => a.carve(b.carve(region, second), first),
                };
                [carved; 2]
            }
        }
    }
}

impl<P: Primitive, const N: usize> PacketTraversal<N> for DualSplitTree<P> {}
