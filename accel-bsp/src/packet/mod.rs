//! Packets through the BSP tree (Ize 2008, section 4.2). Planes may have any
//! orientation, so the signs of directions decide no order; a common origin does:
//! every ray that crosses a plane crosses it from the origin's side. Packets of other
//! rays are traced ray by ray.

mod common_origin;

use std::ops::ControlFlow;

use accel_core::query::Query;
use accel_core::ray::RayPacket;
use accel_core::simd::Lanes;
use accel_core::statistics::{NodeKind as StatisticsKind, TraversalStatistics};
use accel_core::structure::{CellTree, CellVisit, Division, RayPart};
use accel_core::{PreparedRay, Primitive};

use crate::BspTree;
use crate::crossing::{Crossings, Tolerance};
use crate::node::{NODE_BYTES, Node, NodeKind};
use crate::plane_tracking::Untracked;
use crate::traversal::traverse_below;
use common_origin::CommonOrigin;

/// Stands for a part that holds nothing.
const NOTHING: u32 = u32::MAX;

impl<P: Primitive> CellTree for BspTree<P> {
    type Vector<L: Lanes> = CommonOrigin<L>;

    #[inline(always)]
    fn prepare<L: Lanes>(&self, packet: &RayPacket<'_, L, 1>) -> Option<CommonOrigin<L>> {
        let origin = packet.shared().origin?;
        Some(CommonOrigin::new(origin, packet.lanes(0).direction))
    }

    #[inline(always)]
    fn is_leaf(&self, node: u32) -> bool {
        self.nodes.get(node as usize).is_none_or(Node::is_leaf)
    }

    #[inline(always)]
    fn divide<L: Lanes, S: TraversalStatistics>(
        &self,
        vector: &CommonOrigin<L>,
        visit: &CellVisit<L>,
        statistics: &mut S,
    ) -> Division<L> {
        let (crossing, children, kind) = match self.nodes[visit.node as usize].kind() {
            NodeKind::AxisAligned {
                axis,
                position,
                slack,
                children,
            } => {
                let crossing = vector.axis_aligned(axis, position, slack, visit.far);
                (crossing, children, StatisticsKind::Inner)
            }
            NodeKind::General {
                normal,
                offset,
                children,
            } => {
                let crossing = vector.general(normal, offset, visit.far);
                (crossing, children, StatisticsKind::General)
            }
            leaf => unreachable!("{leaf:?} is not an inner node"),
        };
        statistics.visit_node(kind, NODE_BYTES as u32);
        statistics.test_planes(1);
        let [back, front] = children.map(|child| child.unwrap_or(NOTHING));
        let children = if crossing.is_origin_behind {
            [back, front]
        } else {
            [front, back]
        };
        Division {
            children,
            entry: crossing.entry,
            exit: crossing.exit,
        }
    }

    #[inline(always)]
    fn leaf<L: Lanes, S: TraversalStatistics>(
        &self,
        vector: &CommonOrigin<L>,
        visit: &CellVisit<L>,
        statistics: &mut S,
    ) -> Option<(u32, u32)> {
        let node = self.nodes.get(visit.node as usize)?;
        statistics.visit_node(StatisticsKind::Leaf, NODE_BYTES as u32);
        match node.kind() {
            NodeKind::Leaf(leaf) | NodeKind::BoundedLeaf { leaf, .. } => Some((leaf, visit.active)),
            NodeKind::PlanarLeaf {
                normal,
                offset,
                leaf,
            } => {
                statistics.test_planes(1);
                let crossing = vector.general(normal, offset, visit.far);
                Some((leaf, visit.active & crossing.meets(visit)))
            }
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
        let crossings = Crossings::new(ray, self.largest, Tolerance::SAFE);
        traverse_below::<P, Untracked, Q, S>(self, part, &crossings, query, statistics)
    }
}
