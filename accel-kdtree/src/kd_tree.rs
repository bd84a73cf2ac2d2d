//! The tree.

use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::query::Query;
use accel_core::simd::SimdLevel;
use accel_core::statistics::{NodeKind as StatisticsKind, TraversalStatistics, TreeOutline};
use accel_core::structure::traverse_cells;
use accel_core::{Aabb, AccelerationStructure, PacketTraversal, PreparedRay, Primitive};

use crate::node::{Leaf, Node, NodeKind};
use crate::part::Slack;

/// A kd-tree in nodes of 8 bytes. Made by
/// [`KdTreeBuilder`](crate::KdTreeBuilder); owns its primitives.
#[derive(Clone, Debug)]
pub struct KdTree<P: Primitive> {
    pub(crate) nodes: Vec<Node>,
    pub(crate) stored: StoredPrimitives<P>,
    /// The root's cell; `None` where there is nothing to hit.
    pub(crate) bounds: Option<Aabb>,
    /// How far beyond planes both sides are visited.
    pub(crate) slack: Slack,
    /// Edges from the root to the deepest leaf.
    pub(crate) depth: u32,
}

impl<P: Primitive> KdTree<P> {
    /// Edges from the root to the deepest leaf.
    pub fn depth(&self) -> u32 {
        self.depth
    }

    /// The nodes as they lie in memory, two words each.
    pub fn node_words(&self) -> Vec<[u32; 2]> {
        self.nodes.iter().map(|node| node.words()).collect()
    }

    /// Calls `visit` with the index of each node, its cell, and its depth, each
    /// node after its parent; `visit` answers whether to go on below an inner
    /// node.
    pub(crate) fn walk(&self, mut visit: impl FnMut(u32, &Aabb, u32) -> bool) {
        let root = self.bounds.map(|bounds| (0, bounds, 0));
        let mut pending: Vec<(u32, Aabb, u32)> = root.into_iter().collect();
        while let Some((index, cell, depth)) = pending.pop() {
            let goes_on = visit(index, &cell, depth);
            let NodeKind::Inner {
                axis,
                position,
                children,
            } = self.nodes[index as usize].kind()
            else {
                continue;
            };
            if goes_on {
                let below = cell.with_range(axis, f32::MIN, position);
                let above = cell.with_range(axis, position, f32::MAX);
                pending.push((children + 1, above, depth + 1));
                pending.push((children, below, depth + 1));
            }
        }
    }
}

impl<P: Primitive> AccelerationStructure for KdTree<P> {
    type Primitive = P;
    type Storage = P::Storage;

    #[inline]
    fn traverse<Q: Query, S: TraversalStatistics>(
        &self,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) {
        crate::traversal::traverse(self, ray, query, statistics, &self.tolerance());
    }

    fn bounds(&self) -> Option<Aabb> {
        self.bounds
    }

    fn stored(&self) -> &StoredPrimitives<P> {
        &self.stored
    }

    fn node_bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice())
    }

    /// Bounds are the nodes' cells.
    fn outline(&self) -> TreeOutline {
        let mut outline = TreeOutline::default();
        // By depth, the position in the outline of the node last met there.
        let mut path: Vec<u32> = Vec::new();
        self.walk(|index, cell, depth| {
            path.truncate(depth as usize);
            let parent = path.last().copied();
            match self.nodes[index as usize].as_leaf() {
                Some(Leaf::Of(leaf)) => {
                    let ids = self.stored.leaves().leaf_ids(leaf);
                    outline.push_leaf(*cell, parent, ids);
                }
                Some(Leaf::Empty) => {
                    outline.push_leaf(*cell, parent, std::iter::empty());
                }
                None => path.push(outline.push_inner(StatisticsKind::Inner, *cell, parent)),
            }
            true
        });
        outline
    }
}

/// Packets are vectors of 4, 8 or 16 rays; more than 16 are cut into vectors of 8.
impl<P: Primitive, const N: usize> PacketTraversal<N> for KdTree<P> {
    #[inline]
    fn traverse_packet_at<Q: Query, S: TraversalStatistics>(
        &self,
        level: SimdLevel,
        rays: &[Option<PreparedRay>; N],
        queries: &mut [Q; N],
        statistics: &mut S,
    ) {
        traverse_cells(self, level, rays, queries, statistics);
    }
}
