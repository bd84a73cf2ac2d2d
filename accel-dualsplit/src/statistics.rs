//! What a tree is made of: the figures of Tables 2 and 3 of Lin 2019.

use accel_core::Primitive;

use crate::codec::{CarvingPlanes, Header};
use crate::node_set::NodeSet;
use crate::tree::PlaneTree;

/// Counts of nodes. A carving node that is a leaf counts as a carving node, as in
/// the paper's Table 2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NodeStatistics {
    /// Splitting nodes.
    pub splitting: usize,
    /// Carving nodes with both planes on one axis.
    pub single_axis_carving: usize,
    /// Carving nodes with a plane on each of two axes.
    pub dual_axis_carving: usize,
    /// Bounding nodes on two or three axes, which an H-tree has.
    pub bounding: usize,
    /// Of the carving nodes, those that are leaves.
    pub carving_leaves: usize,
    /// Leaves without planes.
    pub plain_leaves: usize,
    /// `carving_levels[n]` children of splitting nodes stand behind `n` carving
    /// nodes (Table 3).
    pub carving_levels: [usize; 4],
}

impl NodeStatistics {
    /// Carving nodes of all kinds.
    pub fn carving(&self) -> usize {
        self.single_axis_carving + self.dual_axis_carving + self.bounding
    }

    /// Nodes of all kinds.
    pub fn nodes(&self) -> usize {
        self.splitting + self.carving() + self.plain_leaves
    }
}

impl<P: Primitive, N: NodeSet> PlaneTree<P, N> {
    /// Counts the nodes.
    pub fn node_statistics(&self) -> NodeStatistics {
        let mut statistics = NodeStatistics::default();
        if self.bounds.is_none() {
            return statistics;
        }
        // Of a child of a splitting node, the carving nodes passed since.
        let mut pending = vec![(0, None)];
        while let Some((position, levels)) = pending.pop() {
            let node = self.node(position);
            let below = match node.header {
                Header::Splitting { .. } => {
                    statistics.splitting += 1;
                    Some(0)
                }
                Header::Leaf => {
                    statistics.plain_leaves += 1;
                    None
                }
                Header::Carving { planes, is_leaf } => {
                    match planes {
                        CarvingPlanes::Single(_) => statistics.single_axis_carving += 1,
                        CarvingPlanes::Dual(..) => statistics.dual_axis_carving += 1,
                        CarvingPlanes::Bounding(_) => statistics.bounding += 1,
                    }
                    statistics.carving_leaves += usize::from(is_leaf);
                    levels.map(|levels: usize| levels + 1)
                }
            };
            let ends_chain = match node.header {
                Header::Carving { is_leaf: true, .. } => below,
                Header::Carving { .. } => None,
                Header::Splitting { .. } | Header::Leaf => levels,
            };
            if let Some(levels) = ends_chain {
                statistics.carving_levels[levels.min(3)] += 1;
            }
            pending.extend(node.children().map(|child| (child, below)));
        }
        statistics
    }
}
