//! Packets through the kd-tree: which child is near is the same for all rays of a
//! vector if their directions have the same signs; of a common origin that is the
//! side of the plane on which it lies, for all rays that cross the plane in front
//! of it. Rays need not share their origin.

use std::ops::ControlFlow;

use accel_core::query::Query;
use accel_core::ray::RayPacket;
use accel_core::simd::Lanes;
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::{CellTree, CellVisit, Division, RayPart};
use accel_core::{PreparedRay, Primitive};

use crate::KdTree;
use crate::crossing::{CrossingLanes, Crossings};
use crate::node::{Leaf, NODE_BYTES};
use crate::traversal::traverse_below;

impl<P: Primitive> CellTree for KdTree<P> {
    type Vector<L: Lanes> = CrossingLanes<L>;

    #[inline(always)]
    fn prepare<L: Lanes>(&self, packet: &RayPacket<'_, L, 1>) -> Option<CrossingLanes<L>> {
        let signs = packet.shared().signs?;
        Some(CrossingLanes::new(
            packet.lanes(0),
            &signs,
            &self.tolerance(),
        ))
    }

    #[inline(always)]
    fn is_leaf(&self, node: u32) -> bool {
        self.nodes[node as usize].as_leaf().is_some()
    }

    #[inline(always)]
    fn divide<L: Lanes, S: TraversalStatistics>(
        &self,
        vector: &CrossingLanes<L>,
        visit: &CellVisit<L>,
        statistics: &mut S,
    ) -> Division<L> {
        let node = self.nodes[visit.node as usize];
        statistics.visit_node(NodeKind::Inner, NODE_BYTES as u32);
        statistics.test_planes(1);
        let axis = node.axis_index();
        let [entry, exit] = vector.axes[axis].lanes_at(node.position());
        Division {
            children: vector.near_children.of(axis, node.index()),
            entry,
            exit,
        }
    }

    #[inline(always)]
    fn leaf<L: Lanes, S: TraversalStatistics>(
        &self,
        _: &CrossingLanes<L>,
        visit: &CellVisit<L>,
        statistics: &mut S,
    ) -> Option<(u32, u32)> {
        statistics.visit_node(NodeKind::Leaf, NODE_BYTES as u32);
        match self.nodes[visit.node as usize].as_leaf() {
            Some(Leaf::Of(leaf)) => Some((leaf, visit.active)),
            _ => None,
        }
    }

    #[inline]
    fn traverse_below<Q: Query, S: TraversalStatistics>(
        &self,
        part: RayPart,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) -> ControlFlow<()> {
        let crossings = Crossings::new(ray, &self.tolerance());
        traverse_below(self, part, &crossings, ray, query, statistics)
    }
}
