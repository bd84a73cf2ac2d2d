//! Packets through trees that divide cells by planes, kd-trees and BSP trees: a
//! vector of rays goes down together (Wald et al. 2001; Ize 2008, section 4.2).
//!
//! ```text
//! interval := each ray inside the root's cell; a ray is active while its is not empty
//! loop:
//!     one child:  cut what is empty off each ray's interval, go on with the child
//!     inner:  entry, exit := where each ray may cross the plane
//!             near child: each ray's interval up to exit
//!             far child:  each ray's interval from entry on
//!             go where rays are active: near first, far put off
//!     leaf:   offer the hits of the active rays
//!             take the child put off last in which a ray is still active
//!     one active ray: it goes on alone
//! ```
//!
//! Every node has one order of its children for all rays of a vector. Which rays
//! have one is the tree's to say: those of directions with the same signs in a
//! kd-tree, those of one origin in a BSP tree. A vector without, one in many
//! images, is traced ray by ray: so each ray has its own order of nodes.

use std::ops::ControlFlow;

use super::{AccelerationStructure, PacketStack, VectorTraversal};
use crate::layout::LeafStorage;
use crate::query::Query;
use crate::ray::packet::{go_one_way, lanes_of, start_at_one_point};
use crate::ray::{PacketRay, PreparedRay, RayPacket};
use crate::simd::Lanes;
use crate::statistics::TraversalStatistics;

/// A vector of no more active rays is traced ray by ray.
const ALONE: u32 = 1;

/// A tree whose inner nodes divide a cell by a plane.
///
/// Methods over [`Lanes`] must be `#[inline(always)]`, so that they use the
/// vectors of the machine.
pub trait CellTree: AccelerationStructure {
    /// What is computed once for a vector of rays.
    type Vector<L: Lanes>;

    /// Readies a vector of rays; `None` if they have no order of children in
    /// common.
    fn prepare<L: Lanes>(&self, packet: &RayPacket<'_, L, 1>) -> Option<Self::Vector<L>>;

    /// Whether `node` is a leaf.
    fn is_leaf(&self, node: u32) -> bool;

    /// Passes nodes with one child that cut empty space off the rays, until a node that
    /// divides, a leaf, or no ray is active any more. A tree without such nodes leaves
    /// this as it is.
    #[inline(always)]
    fn pass<L: Lanes, S: TraversalStatistics>(
        &self,
        vector: &Self::Vector<L>,
        visit: CellVisit<L>,
        statistics: &mut S,
    ) -> CellVisit<L> {
        let _ = (vector, statistics);
        visit
    }

    /// How the plane of an inner node divides the rays.
    fn divide<L: Lanes, S: TraversalStatistics>(
        &self,
        vector: &Self::Vector<L>,
        visit: &CellVisit<L>,
        statistics: &mut S,
    ) -> Division<L>;

    /// The number of a leaf that is not empty, and the mask of the active rays that
    /// can hit anything in it.
    fn leaf<L: Lanes, S: TraversalStatistics>(
        &self,
        vector: &Self::Vector<L>,
        visit: &CellVisit<L>,
        statistics: &mut S,
    ) -> Option<(u32, u32)>;

    /// Offers the hits below a node of one ray; breaks when the query does.
    fn traverse_below<Q: Query, S: TraversalStatistics>(
        &self,
        part: RayPart,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) -> ControlFlow<()>;
}

/// Where a plane divides the rays of a vector.
#[derive(Clone, Copy, Debug)]
pub struct Division<L> {
    /// The child that the rays are in first, and the other one.
    pub children: [u32; 2],
    /// By ray, where the farther child begins; NaN where it is not known.
    pub entry: L,
    /// By ray, where the nearer child ends; NaN where it is not known.
    pub exit: L,
}

/// A node, and the parts of the rays inside its cell; those of rays that are not
/// active are empty.
#[derive(Clone, Copy, Debug)]
pub struct CellVisit<L> {
    /// The node.
    pub node: u32,
    /// The mask of the active rays.
    pub active: u32,
    /// By ray, where its part begins.
    pub near: L,
    /// By ray, where its part ends.
    pub far: L,
}

/// A node, and the part of a ray inside its cell.
#[derive(Clone, Copy, Debug)]
pub struct RayPart {
    /// The node.
    pub node: u32,
    /// Where the part begins.
    pub near: f32,
    /// Where it ends.
    pub far: f32,
}

impl<L: Lanes> CellVisit<L> {
    /// The rays whose parts are not empty are active.
    #[inline(always)]
    pub fn new(node: u32, near: L, far: L) -> Self {
        Self {
            node,
            active: near.le_mask(far),
            near,
            far,
        }
    }
}

/// Every vector of a group goes down on its own.
impl<A: CellTree> VectorTraversal for A {
    #[inline(always)]
    fn traverse_vectors<L: Lanes, Q, S, const VECTORS: usize>(
        &self,
        rays: &[PacketRay],
        queries: &mut [Q],
        statistics: &mut S,
    ) where
        Q: Query,
        S: TraversalStatistics,
    {
        for (rays, queries) in rays.chunks(L::COUNT).zip(queries.chunks_mut(L::COUNT)) {
            trace_vector::<L, A, Q, S>(self, rays, queries, statistics);
        }
    }
}

#[inline(always)]
fn trace_vector<L: Lanes, A: CellTree, Q: Query, S: TraversalStatistics>(
    tree: &A,
    rays: &[PacketRay],
    queries: &mut [Q],
    statistics: &mut S,
) {
    if !go_one_way(rays) && !start_at_one_point(rays) {
        return tree.traverse_each(rays, queries, statistics);
    }
    let packet = RayPacket::<L, 1>::new(rays, |lane| queries[lane].t_max());
    let Some(mut packet) = packet else { return };
    let Some(prepared) = tree.prepare(&packet) else {
        return tree.traverse_each(rays, queries, statistics);
    };
    // In a place of its own: it is large, and must never be moved.
    let mut stack = PacketStack::new();
    let mut vector = Vector {
        tree,
        packet: &mut packet,
        prepared: &prepared,
        queries,
    };
    let mut next = vector.root(statistics);
    while let Some(visit) = next {
        let visit = tree.pass(&prepared, visit, statistics);
        next = if visit.active == 0 {
            None
        } else if tree.is_leaf(visit.node) {
            vector.leaf(&visit, statistics);
            None
        } else if visit.active.count_ones() <= ALONE {
            vector.trace_alone(&visit, statistics);
            None
        } else {
            vector.inner(&visit, &mut stack, statistics)
        };
        if next.is_none() {
            next = vector.pop(&mut stack);
        }
    }
}

/// A vector of rays on its way through the tree.
struct Vector<'a, 'r, L: Lanes, A: CellTree, Q> {
    tree: &'a A,
    packet: &'a mut RayPacket<'r, L, 1>,
    prepared: &'a A::Vector<L>,
    queries: &'a mut [Q],
}

impl<L: Lanes, A: CellTree, Q: Query> Vector<'_, '_, L, A, Q> {
    #[inline(always)]
    fn root<S: TraversalStatistics>(&self, statistics: &mut S) -> Option<CellVisit<L>> {
        let bounds = self.tree.bounds()?;
        statistics.test_boxes(1);
        let plane = |axis: usize, high| {
            if high {
                bounds.max[axis]
            } else {
                bounds.min[axis]
            }
        };
        let (near, far) = self.packet.slab(0, plane);
        let root = CellVisit::new(0, near, far);
        (root.active != 0).then_some(root)
    }

    /// The child to visit next; the other, if rays are active there too, is put
    /// off. Where cells fill space, rounding never leaves an active ray without a child.
    #[inline(always)]
    fn inner<S: TraversalStatistics>(
        &self,
        visit: &CellVisit<L>,
        stack: &mut PacketStack<CellVisit<L>>,
        statistics: &mut S,
    ) -> Option<CellVisit<L>> {
        let division = self.tree.divide(self.prepared, visit, statistics);
        let [near_child, far_child] = division.children;
        let exit = visit.far.min_or_keep(division.exit);
        let entry = visit.near.max_or_keep(division.entry);
        let near = CellVisit::new(near_child, visit.near, exit);
        let far = CellVisit::new(far_child, entry, visit.far);
        if near.active == 0 {
            return (far.active != 0).then_some(far);
        }
        if far.active != 0 {
            stack.push(far);
        }
        Some(near)
    }

    #[inline(always)]
    fn leaf<S: TraversalStatistics>(&mut self, visit: &CellVisit<L>, statistics: &mut S) {
        if let Some((leaf, mask)) = self.tree.leaf(self.prepared, visit, statistics)
            && mask != 0
        {
            let leaves = self.tree.stored().leaves();
            let mut rays = self.packet.vector(0);
            leaves.intersect_leaf_packet(leaf, mask, &mut rays, self.queries, statistics);
        }
    }

    /// The node put off last that a ray still enters before its best hit.
    #[inline(always)]
    fn pop(&self, stack: &mut PacketStack<CellVisit<L>>) -> Option<CellVisit<L>> {
        loop {
            let put_off = stack.pop()?;
            let far = put_off.far.min_or_keep(self.packet.t_max(0));
            let visit = CellVisit::new(put_off.node, put_off.near, far);
            if visit.active != 0 {
                return Some(visit);
            }
        }
    }

    /// What is below a node, ray by ray.
    #[inline(always)]
    fn trace_alone<S: TraversalStatistics>(&mut self, visit: &CellVisit<L>, statistics: &mut S) {
        let mut rays = self.packet.vector(0);
        for lane in lanes_of(visit.active) {
            let (Some(ray), query) = (rays.ray(lane), &mut self.queries[lane]) else {
                continue;
            };
            let part = RayPart {
                node: visit.node,
                near: visit.near.lanes()[lane],
                far: visit.far.lanes()[lane],
            };
            if traverse_alone(self.tree, part, ray, query, statistics) {
                rays.retire(lane);
            } else {
                rays.shorten(lane, query.t_max());
            }
        }
    }
}

/// A call of its own, compiled as for single rays; true if the query broke.
#[inline(never)]
fn traverse_alone<A: CellTree, Q: Query, S: TraversalStatistics>(
    tree: &A,
    part: RayPart,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) -> bool {
    tree.traverse_below(part, ray, query, statistics).is_break()
}
