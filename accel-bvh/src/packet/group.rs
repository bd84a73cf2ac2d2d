//! A group of vectors on its way through the tree.

use accel_core::layout::LeafStorage;
use accel_core::query::Query;
use accel_core::ray::packet::{go_one_way, lanes_of};
use accel_core::ray::{PacketRay, RayPacket};
use accel_core::simd::Lanes;
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::PacketStack;
use accel_core::{PreparedRay, Primitive};

use super::cull::SiblingCull;
use crate::Bvh;
use crate::node::{INNER_NODE_BYTES, InnerNode, LEAF_NODE_BYTES, Node, NodePointer};
use crate::traversal::traverse_below;

/// Rays of a vector that go on alone when there are no more of them: two tests
/// of a vector cost about as much as one of a single ray.
const ALONE: u32 = 1;

struct Group<'a, 'r, L, P: Primitive, Q, const VECTORS: usize> {
    bvh: &'a Bvh<P>,
    packet: &'a mut RayPacket<'r, L, VECTORS>,
    queries: &'a mut [Q],
    /// For more than one vector.
    cull: Option<SiblingCull>,
    /// The largest `t_max` of all rays.
    farthest: f32,
}

/// A node that some ray of a group meets.
#[derive(Clone, Copy, Debug)]
struct Visit<L> {
    pointer: NodePointer,
    /// Whose box it is: the word of its parent, and 0 or 1 for left or right.
    parent: u32,
    side: u32,
    /// The first vector that meets it; those before don't.
    first: u32,
    /// The rays of the first vector that meet it, and where they enter.
    mask: u32,
    near: L,
}

/// Traces rays; false, and nothing done, where their directions differ in sign.
#[inline(always)]
pub(super) fn trace<L: Lanes, P, Q, S, const VECTORS: usize>(
    bvh: &Bvh<P>,
    rays: &[PacketRay],
    queries: &mut [Q],
    statistics: &mut S,
) -> bool
where
    P: Primitive,
    Q: Query,
    S: TraversalStatistics,
{
    if !go_one_way(rays) {
        return false;
    }
    let packet = RayPacket::<L, VECTORS>::new(rays, |lane| queries[lane].t_max());
    let Some(mut packet) = packet else {
        return true;
    };
    if packet.shared().signs.is_none() {
        return false;
    }
    let mut stack = PacketStack::new();
    let cull = (VECTORS > 1).then(|| SiblingCull::new(&packet.bounds()));
    let mut group = Group {
        bvh,
        cull,
        farthest: packet.farthest(),
        packet: &mut packet,
        queries,
    };
    let mut visit = group.root(statistics);
    while let Some(current) = visit {
        visit = match current.pointer.kind() {
            Node::Leaf(offset) => {
                group.leaf(offset, &current, statistics);
                if VECTORS > 1 && group.farthest == f32::NEG_INFINITY {
                    // Every ray is answered.
                    return true;
                }
                None
            }
            Node::Inner(_) if group.goes_on_alone(&current) => {
                group.trace_alone(&current, statistics);
                None
            }
            Node::Inner(offset) => group.inner(offset, &current, &mut stack, statistics),
        };
        if visit.is_none() {
            visit = group.pop(&mut stack, statistics);
        }
    }
    true
}

impl<L: Lanes, P: Primitive, Q: Query, const VECTORS: usize> Group<'_, '_, L, P, Q, VECTORS> {
    /// The root, for the first vector that meets it.
    #[inline(always)]
    fn root<S: TraversalStatistics>(&mut self, statistics: &mut S) -> Option<Visit<L>> {
        let root = self.bvh.root?;
        let plane = |axis: usize, high| {
            let corner = if high {
                root.bounds.max
            } else {
                root.bounds.min
            };
            corner[axis]
        };
        for vector in 0..VECTORS {
            statistics.test_boxes(1);
            let (near, mask) = self.packet.meets(vector, plane);
            if mask != 0 {
                return Some(Visit {
                    pointer: root.pointer,
                    parent: ROOT,
                    side: 0,
                    first: vector as u32,
                    mask,
                    near,
                });
            }
        }
        None
    }

    /// The child to visit next, if any ray meets one; the other is put off.
    #[inline(always)]
    fn inner<S: TraversalStatistics>(
        &mut self,
        offset: u32,
        parent: &Visit<L>,
        stack: &mut PacketStack<Visit<L>>,
        statistics: &mut S,
    ) -> Option<Visit<L>> {
        statistics.visit_node(NodeKind::Inner, INNER_NODE_BYTES as u32);
        statistics.test_boxes(2);
        let bvh = self.bvh;
        let node = bvh.inner_node(offset);
        let pointers = node.children().pointers();
        let mut children = [
            self.child(&node, 0, pointers[0], offset, parent.first),
            self.child(&node, 1, pointers[1], offset, parent.first),
        ];
        // Early hit failed for a child: early miss, then the other vectors.
        if let Some(cull) = &self.cull
            && (children[0].mask == 0 || children[1].mask == 0)
        {
            let may_meet = cull.may_meet(&node, self.farthest);
            for (side, child) in children.iter_mut().enumerate() {
                if child.mask == 0 && may_meet >> side & 1 == 1 {
                    self.find_first(child, &node, statistics);
                }
            }
        }
        let [left, right] = children;
        match (left.mask != 0, right.mask != 0) {
            (true, true) => {
                let [next, later] = if comes_first(&left, &right) {
                    [left, right]
                } else {
                    [right, left]
                };
                stack.push(later);
                Some(next)
            }
            (true, false) => Some(left),
            (false, true) => Some(right),
            (false, false) => None,
        }
    }

    /// A child, tested for one vector.
    #[inline(always)]
    fn child(
        &self,
        node: &InnerNode<'_>,
        side: usize,
        pointer: NodePointer,
        parent: u32,
        first: u32,
    ) -> Visit<L> {
        let (near, mask) = self.packet.meets(first as usize, child_plane(node, side));
        Visit {
            pointer,
            parent,
            side: side as u32,
            first,
            mask,
            near,
        }
    }

    /// Finds the first vector after `visit.first` that meets its box.
    #[inline(always)]
    fn find_first<S: TraversalStatistics>(
        &self,
        visit: &mut Visit<L>,
        node: &InnerNode<'_>,
        statistics: &mut S,
    ) {
        for vector in visit.first as usize + 1..VECTORS {
            statistics.test_boxes(1);
            let side = visit.side as usize;
            let (near, mask) = self.packet.meets(vector, child_plane(node, side));
            if mask != 0 {
                (visit.first, visit.mask, visit.near) = (vector as u32, mask, near);
                return;
            }
        }
    }

    /// The node put off last that a ray still enters before its best hit.
    #[inline(always)]
    fn pop<S: TraversalStatistics>(
        &self,
        stack: &mut PacketStack<Visit<L>>,
        statistics: &mut S,
    ) -> Option<Visit<L>> {
        loop {
            let mut visit = stack.pop()?;
            visit.mask &= visit.near.le_mask(self.packet.t_max(visit.first as usize));
            if VECTORS > 1 && visit.mask == 0 {
                let node = self.bvh.inner_node(visit.parent);
                self.find_first(&mut visit, &node, statistics);
            }
            if visit.mask != 0 {
                return Some(visit);
            }
        }
    }

    #[inline(always)]
    fn leaf<S: TraversalStatistics>(&mut self, offset: u32, visit: &Visit<L>, statistics: &mut S) {
        statistics.visit_node(NodeKind::Leaf, LEAF_NODE_BYTES as u32);
        let bvh = self.bvh;
        let leaf = bvh.leaf_number(offset);
        let first = visit.first as usize;
        for vector in first..VECTORS {
            let mask = if vector == first {
                visit.mask
            } else if visit.parent == ROOT {
                // A tree of one leaf, whose gates are tested anyway: all rays there are.
                L::splat(0.0).le_mask(self.packet.t_max(vector))
            } else {
                statistics.test_boxes(1);
                let node = bvh.inner_node(visit.parent);
                self.packet
                    .meets(vector, child_plane(&node, visit.side as usize))
                    .1
            };
            if mask != 0 {
                let queries = &mut self.queries[vector * L::COUNT..];
                let mut rays = self.packet.vector(vector);
                let leaves = bvh.stored.leaves();
                leaves.intersect_leaf_packet(leaf, mask, &mut rays, queries, statistics);
            }
        }
        if VECTORS > 1 {
            self.farthest = self.packet.farthest();
        }
    }

    #[inline(always)]
    fn goes_on_alone(&self, visit: &Visit<L>) -> bool {
        visit.first as usize == VECTORS - 1 && visit.mask.count_ones() <= ALONE
    }

    /// What is below a node, ray by ray.
    #[inline(always)]
    fn trace_alone<S: TraversalStatistics>(&mut self, visit: &Visit<L>, statistics: &mut S) {
        let vector = visit.first as usize;
        let queries = &mut self.queries[vector * L::COUNT..];
        let mut rays = self.packet.vector(vector);
        for lane in lanes_of(visit.mask) {
            let (Some(ray), query) = (rays.ray(lane), &mut queries[lane]) else {
                continue;
            };
            if traverse_alone(self.bvh, visit.pointer, ray, query, statistics) {
                rays.retire(lane);
            } else {
                rays.shorten(lane, query.t_max());
            }
        }
    }
}

/// Stands for the parent of the root.
const ROOT: u32 = u32::MAX;

#[inline(always)]
fn child_plane(node: &InnerNode<'_>, side: usize) -> impl Fn(usize, bool) -> f32 {
    move |axis, high| node.planes(axis, high)[side]
}

/// Whether most rays that meet both boxes enter `left` first. Where different
/// vectors meet them, the box that the earlier one meets comes first: more rays
/// may meet it.
#[inline(always)]
fn comes_first<L: Lanes>(left: &Visit<L>, right: &Visit<L>) -> bool {
    if left.first != right.first {
        return left.first < right.first;
    }
    let both = left.mask & right.mask;
    let voters = if both == 0 {
        left.mask | right.mask
    } else {
        both
    };
    let votes = left.near.le_mask(right.near) & voters;
    2 * votes.count_ones() >= voters.count_ones()
}

/// A call of its own, compiled as for single rays; true if the query broke.
#[inline(never)]
fn traverse_alone<P: Primitive, Q: Query, S: TraversalStatistics>(
    bvh: &Bvh<P>,
    pointer: NodePointer,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) -> bool {
    traverse_below(bvh, pointer, ray, query, statistics).is_break()
}
