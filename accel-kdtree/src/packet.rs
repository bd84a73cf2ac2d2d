//! Traversal of packets: a vector of rays goes down the tree together (Wald et
//! al. 2001; Ize 2008, section 4.2).
//!
//! ```text
//! interval := each ray inside the root's cell; a ray is active while its is not empty
//! loop:
//!     inner:  entry, exit := where each ray may cross the plane
//!             near child: each ray's interval up to exit
//!             far child:  each ray's interval from entry on
//!             go where rays are active: near first, far put off
//!     leaf:   offer the hits of the active rays
//!             take the child put off last in which a ray is still active
//!     one active ray: it goes on alone
//! ```
//!
//! Which child is near is the same for all rays of a vector if their directions
//! have the same signs; of a common origin that is the side of the plane on which
//! it lies, for all rays that cross the plane in front of it. Rays need not share
//! their origin. A vector of different signs, one in many images, is traced ray
//! by ray: so each ray has its own order of nodes.

use accel_core::layout::LeafStorage;
use accel_core::query::Query;
use accel_core::ray::packet::lanes_of;
use accel_core::ray::{PacketRay, RayPacket};
use accel_core::simd::Lanes;
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::{PacketStack, VectorTraversal};
use accel_core::{PreparedRay, Primitive};

use crate::KdTree;
use crate::crossing::{CrossingLanes, Crossings};
use crate::node::{Leaf, NODE_BYTES, Node};
use crate::traversal::{Segment, traverse_below};

/// A vector of no more active rays is traced ray by ray.
const ALONE: u32 = 1;

impl<P: Primitive> VectorTraversal for KdTree<P> {
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
            trace_vector::<L, P, Q, S>(self, rays, queries, statistics);
        }
    }
}

#[inline(always)]
fn trace_vector<L: Lanes, P: Primitive, Q: Query, S: TraversalStatistics>(
    tree: &KdTree<P>,
    rays: &[PacketRay],
    queries: &mut [Q],
    statistics: &mut S,
) {
    let packet = RayPacket::<L, 1>::new(rays, |lane| queries[lane].t_max());
    let Some(mut packet) = packet else { return };
    let Some(signs) = packet.shared().signs else {
        return tree.traverse_each(rays, queries, statistics);
    };
    let crossings = CrossingLanes::new(packet.lanes(0), &signs, &tree.tolerance());
    // In a place of its own: it is large, and must never be moved.
    let mut stack = PacketStack::new();
    let mut vector = Vector {
        tree,
        packet: &mut packet,
        crossings: &crossings,
        queries,
    };
    let mut next = vector.root(statistics);
    while let Some(visit) = next {
        let node = tree.nodes[visit.node as usize];
        next = match node.as_leaf() {
            Some(leaf) => {
                vector.leaf(leaf, &visit, statistics);
                None
            }
            None if visit.active.count_ones() <= ALONE => {
                vector.trace_alone(&visit, statistics);
                None
            }
            None => vector.inner(node, &visit, &mut stack, statistics),
        };
        if next.is_none() {
            next = vector.pop(&mut stack);
        }
    }
}

/// A vector of rays on its way through the tree.
struct Vector<'a, 'r, L, P: Primitive, Q> {
    tree: &'a KdTree<P>,
    packet: &'a mut RayPacket<'r, L, 1>,
    crossings: &'a CrossingLanes<L>,
    queries: &'a mut [Q],
}

/// A node, and the parts of the rays inside its cell; those of rays that are not
/// active are empty.
#[derive(Clone, Copy, Debug)]
struct Visit<L> {
    node: u32,
    active: u32,
    near: L,
    far: L,
}

impl<L: Lanes> Visit<L> {
    #[inline(always)]
    fn new(node: u32, near: L, far: L) -> Self {
        Self {
            node,
            active: near.le_mask(far),
            near,
            far,
        }
    }
}

impl<L: Lanes, P: Primitive, Q: Query> Vector<'_, '_, L, P, Q> {
    #[inline(always)]
    fn root<S: TraversalStatistics>(&self, statistics: &mut S) -> Option<Visit<L>> {
        let bounds = self.tree.bounds?;
        statistics.test_boxes(1);
        let plane = |axis: usize, high| {
            if high {
                bounds.max[axis]
            } else {
                bounds.min[axis]
            }
        };
        let (near, far) = self.packet.slab(0, plane);
        let root = Visit::new(0, near, far);
        (root.active != 0).then_some(root)
    }

    /// The child to visit next; the other, if rays are active there too, is put
    /// off. Rounding never leaves an active ray without a child.
    #[inline(always)]
    fn inner<S: TraversalStatistics>(
        &self,
        node: Node,
        visit: &Visit<L>,
        stack: &mut PacketStack<Visit<L>>,
        statistics: &mut S,
    ) -> Option<Visit<L>> {
        statistics.visit_node(NodeKind::Inner, NODE_BYTES as u32);
        statistics.test_planes(1);
        let crossing = &self.crossings.axes[node.axis_index()];
        let [entry, exit] = crossing.lanes_at(node.position());
        let [near_child, far_child] = crossing.children(node.index());
        let near = Visit::new(near_child, visit.near, visit.far.min_or_keep(exit));
        let far = Visit::new(far_child, visit.near.max_or_keep(entry), visit.far);
        if near.active == 0 {
            return (far.active != 0).then_some(far);
        }
        if far.active != 0 {
            stack.push(far);
        }
        Some(near)
    }

    #[inline(always)]
    fn leaf<S: TraversalStatistics>(&mut self, leaf: Leaf, visit: &Visit<L>, statistics: &mut S) {
        statistics.visit_node(NodeKind::Leaf, NODE_BYTES as u32);
        if let Leaf::Of(leaf) = leaf {
            let leaves = self.tree.stored.leaves();
            let mut rays = self.packet.vector(0);
            leaves.intersect_leaf_packet(leaf, visit.active, &mut rays, self.queries, statistics);
        }
    }

    /// The node put off last that a ray still enters before its best hit.
    #[inline(always)]
    fn pop(&self, stack: &mut PacketStack<Visit<L>>) -> Option<Visit<L>> {
        loop {
            let put_off = stack.pop()?;
            let far = put_off.far.min_or_keep(self.packet.t_max(0));
            let visit = Visit::new(put_off.node, put_off.near, far);
            if visit.active != 0 {
                return Some(visit);
            }
        }
    }

    /// What is below a node, ray by ray.
    #[inline(always)]
    fn trace_alone<S: TraversalStatistics>(&mut self, visit: &Visit<L>, statistics: &mut S) {
        let mut rays = self.packet.vector(0);
        for lane in lanes_of(visit.active) {
            let (Some(ray), query) = (rays.ray(lane), &mut self.queries[lane]) else {
                continue;
            };
            let segment = Segment {
                node: visit.node,
                near: visit.near.lanes()[lane],
                far: visit.far.lanes()[lane],
            };
            if traverse_alone(self.tree, segment, ray, query, statistics) {
                rays.retire(lane);
            } else {
                rays.shorten(lane, query.t_max());
            }
        }
    }
}

/// A call of its own, compiled as for single rays; true if the query broke.
#[inline(never)]
fn traverse_alone<P: Primitive, Q: Query, S: TraversalStatistics>(
    tree: &KdTree<P>,
    segment: Segment,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) -> bool {
    let crossings = Crossings::new(ray, &tree.tolerance());
    traverse_below(tree, segment, &crossings, ray, query, statistics).is_break()
}
