//! Packets through the BSP tree (Ize 2008, section 4.2). Planes may have any
//! orientation, so the signs of directions decide no order; a common origin does:
//! every ray that crosses a plane crosses it from the origin's side. Packets of other
//! rays, or of numbers so large that they could overflow, are traced ray by ray.

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
use crate::node::NodeKind;
use crate::nodes::bytes_of;
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
        CommonOrigin::new(origin, packet.lanes(0).direction, self.plane_limits())
    }

    #[inline(always)]
    fn is_leaf(&self, node: u32) -> bool {
        node == NOTHING || self.nodes.node(node).is_leaf()
    }

    #[inline(always)]
    fn divide<L: Lanes, S: TraversalStatistics>(
        &self,
        vector: &CommonOrigin<L>,
        visit: &CellVisit<L>,
        statistics: &mut S,
    ) -> Division<L> {
        let node = self.nodes.node(visit.node);
        let (crossing, children, kind) = match node.kind() {
            NodeKind::AxisAligned {
                axis,
                position,
                slack,
                children,
            } => {
                let slack = self.nodes.slacks().of(slack);
                let crossing = vector.axis_aligned(axis, position, slack, visit.far);
                (crossing, children, StatisticsKind::Inner)
            }
            NodeKind::General { plane, children } => {
                let crossing = vector.general(self.nodes.plane(plane), visit.far);
                (crossing, children, StatisticsKind::General)
            }
            leaf => unreachable!("{leaf:?} is not an inner node"),
        };
        statistics.visit_node(kind, bytes_of(node));
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
        if visit.node == NOTHING {
            return None;
        }
        let node = self.nodes.node(visit.node);
        statistics.visit_node(StatisticsKind::Leaf, bytes_of(node));
        match node.kind() {
            NodeKind::Leaf(leaf) | NodeKind::BoundedLeaf { leaf, .. } => Some((leaf, visit.active)),
            NodeKind::PlanarLeaf { plane, leaf } => {
                statistics.test_planes(1);
                let crossing = vector.general(self.nodes.plane(plane), visit.far);
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
        let crossings = Crossings::new(ray, part.far, self.plane_limits(), Tolerance::SAFE);
        traverse_below::<P, Untracked, Q, S>(self, part, &crossings, query, statistics)
    }
}
