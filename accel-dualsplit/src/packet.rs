//! Packets: which child comes first is the same for all rays of a vector if their
//! directions have the same signs, and so is through which planes they enter and leave.

use std::ops::ControlFlow;

use accel_core::geometry::Axis;
use accel_core::query::Query;
use accel_core::ray::RayPacket;
use accel_core::ray::packet::RayLanes;
use accel_core::simd::Lanes;
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::{CellTree, CellVisit, Division, RayPart};
use accel_core::{PreparedRay, Primitive};

use crate::codec::{FirstWord, Header, LEAF_BYTES};
use crate::node_set::NodeSet;
use crate::traversal::{NodePlace, traverse_below, visit_two_planes};
use crate::tree::PlaneTree;

/// Rays with directions of the same signs.
#[derive(Clone, Copy, Debug)]
pub struct SignedLanes<L> {
    rays: RayLanes<L>,
    /// By axis, whether the directions are negative.
    negative: [bool; 3],
}

impl<L: Lanes> SignedLanes<L> {
    #[inline(always)]
    fn entry(&self, axis: Axis, position: f32) -> L {
        let axis = axis.index();
        (L::splat(position) - self.rays.origin[axis]) * self.rays.near_reciprocal[axis]
    }

    #[inline(always)]
    fn exit(&self, axis: Axis, position: f32) -> L {
        let axis = axis.index();
        (L::splat(position) - self.rays.origin[axis]) * self.rays.far_reciprocal[axis]
    }
}

impl<P: Primitive, N: NodeSet> PlaneTree<P, N> {
    #[inline(always)]
    fn place(&self, position: u32) -> NodePlace<'_> {
        NodePlace::new(self.words.padded(), position)
    }
}

impl<P: Primitive, N: NodeSet> CellTree for PlaneTree<P, N> {
    type Vector<L: Lanes> = SignedLanes<L>;

    #[inline(always)]
    fn prepare<L: Lanes>(&self, packet: &RayPacket<'_, L, 1>) -> Option<SignedLanes<L>> {
        Some(SignedLanes {
            rays: *packet.lanes(0),
            negative: packet.shared().signs?,
        })
    }

    #[inline(always)]
    fn is_leaf(&self, node: u32) -> bool {
        let word = self.place(node).first_word();
        !word.splits() && word.is_leaf()
    }

    #[inline(always)]
    fn pass<L: Lanes, S: TraversalStatistics>(
        &self,
        vector: &SignedLanes<L>,
        mut visit: CellVisit<L>,
        statistics: &mut S,
    ) -> CellVisit<L> {
        loop {
            let place = self.place(visit.node);
            let word = place.first_word();
            let Some(Header::Carving { planes, is_leaf }) = Header::decode(word) else {
                return visit;
            };
            statistics.visit_node(NodeKind::Carving, 4 * (1 + planes.count() as u32));
            statistics.test_planes(planes.count() as u32);
            let (mut near, mut far) = (visit.near, visit.far);
            for (plane, position) in planes.box_planes().zip(place.planes_and_rest()) {
                let position = f32::from_bits(*position);
                if plane.is_high == vector.negative[plane.axis.index()] {
                    near = near.max_or_keep(vector.entry(plane.axis, position));
                } else {
                    far = far.min_or_keep(vector.exit(plane.axis, position));
                }
            }
            let child = if is_leaf { 0 } else { word.offset() };
            visit = CellVisit::new(visit.node + child, near, far);
            if is_leaf || visit.active == 0 {
                return visit;
            }
        }
    }

    #[inline(always)]
    fn divide<L: Lanes, S: TraversalStatistics>(
        &self,
        vector: &SignedLanes<L>,
        visit: &CellVisit<L>,
        statistics: &mut S,
    ) -> Division<L> {
        let place = self.place(visit.node);
        let word = place.first_word();
        visit_two_planes(statistics, NodeKind::Splitting);
        let axis = Axis::ALL[word.axis_index()];
        let first = visit.node + word.offset();
        let children = [first, first + N::first_child_words(word)];
        let [high, low] = place.planes().map(f32::from_bits);
        let (entry, exit, children) = if vector.negative[axis.index()] {
            let [first, second] = children;
            (high, low, [second, first])
        } else {
            (low, high, children)
        };
        Division {
            children,
            entry: vector.entry(axis, entry),
            exit: vector.exit(axis, exit),
        }
    }

    #[inline(always)]
    fn leaf<L: Lanes, S: TraversalStatistics>(
        &self,
        _: &SignedLanes<L>,
        visit: &CellVisit<L>,
        statistics: &mut S,
    ) -> Option<(u32, u32)> {
        let word: FirstWord = self.place(visit.node).first_word();
        if !word.carves() {
            statistics.visit_node(NodeKind::Leaf, LEAF_BYTES as u32);
        }
        Some((word.offset(), visit.active))
    }

    #[inline]
    fn traverse_below<Q: Query, S: TraversalStatistics>(
        &self,
        part: RayPart,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) -> ControlFlow<()> {
        traverse_below(self, part, ray, query, statistics)
    }
}
