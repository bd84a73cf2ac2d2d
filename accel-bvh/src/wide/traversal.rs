//! The one traversal of wide nodes, compiled for each instruction set.
//!
//! ```text
//! node := root
//! loop:
//!     leaf:   offer its hits
//!     inner:  test all boxes at once
//!             put the children that are met off, the farthest first
//!             of one or two, go to the closer by a jump, which is predicted
//!     take the child put off last that is not behind the best hit
//! ```

use std::ops::ControlFlow;

use accel_core::geometry::Axis;
use accel_core::layout::LeafStorage;
use accel_core::query::Query;
use accel_core::simd::{InstructionSet, Lanes, SimdLevel, SimdWork};
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::WideStack;
use accel_core::{PreparedRay, Primitive};

use super::WideBvh;
use super::node::{Pointer, Target, WIDE_NODE_BYTES, WIDTH, WideNode};

pub(super) fn traverse<P, L, Q, S>(
    bvh: &WideBvh<P, L>,
    level: SimdLevel,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) where
    P: Primitive,
    L: LeafStorage<P>,
    Q: Query,
    S: TraversalStatistics,
{
    // Its box is not tested first: testing its children costs no more.
    let Some((root, _)) = bvh.root else {
        return;
    };
    let _ = level.run(TraverseBelow {
        bvh,
        root,
        ray,
        query,
        statistics,
    });
}

struct TraverseBelow<'a, P: Primitive, L: LeafStorage<P>, Q, S> {
    bvh: &'a WideBvh<P, L>,
    root: Pointer,
    ray: &'a PreparedRay,
    query: &'a mut Q,
    statistics: &'a mut S,
}

impl<P, L, Q, S> SimdWork for TraverseBelow<'_, P, L, Q, S>
where
    P: Primitive,
    L: LeafStorage<P>,
    Q: Query,
    S: TraversalStatistics,
{
    type Output = ControlFlow<()>;

    #[inline(always)]
    fn run<I: InstructionSet>(self) -> ControlFlow<()> {
        let Self {
            bvh,
            root: mut pointer,
            ray,
            query,
            statistics,
        } = self;
        let test = ChildrenTest::<I::Eight>::new(ray);
        let mut stack = WideStack::new();
        loop {
            match pointer.target() {
                Target::Inner(index) => {
                    statistics.visit_node(NodeKind::Inner, WIDE_NODE_BYTES as u32);
                    statistics.test_boxes(WIDTH as u32);
                    let node = &bvh.nodes[index as usize];
                    let (near, met) = test.meets(node, query.t_max());
                    if let Some(nearest) = nearest(node, near.lanes(), met, &mut stack) {
                        pointer = nearest;
                        continue;
                    }
                }
                Target::Leaf(leaf) => {
                    statistics.visit_node(NodeKind::Leaf, 0);
                    let leaves = bvh.stored.leaves();
                    leaves.intersect_leaf(leaf, ray, query, statistics)?;
                }
                Target::Nothing => {}
            }
            match stack.pop_within(query.t_max()) {
                Some(next) => pointer = next,
                None => return ControlFlow::Continue(()),
            }
        }
    }
}

/// The nearest of the children in `met`; puts the others off, so that the next
/// one is on top. One and two are most of the cases, and need no sorting.
#[inline(always)]
fn nearest(
    node: &WideNode,
    near: &[f32],
    met: u32,
    stack: &mut WideStack<Pointer>,
) -> Option<Pointer> {
    if met == 0 {
        return None;
    }
    let first = met.trailing_zeros() as usize;
    let others = met & (met - 1);
    if others == 0 {
        return Some(node.next_child(first));
    }
    let second = others.trailing_zeros() as usize;
    let mut rest = others & (others - 1);
    let (closer, farther) = if near[first] <= near[second] {
        (first, second)
    } else {
        (second, first)
    };
    if rest == 0 {
        stack.push(node.child(farther), near[farther]);
        return Some(node.next_child(closer));
    }
    let bottom = stack.len();
    stack.push(node.child(farther), near[farther]);
    stack.push(node.child(closer), near[closer]);
    while rest != 0 {
        let place = rest.trailing_zeros() as usize;
        rest &= rest - 1;
        stack.push_sorted(node.child(place), near[place], bottom);
    }
    stack.pop()
}

/// The slab test of eight boxes at once, in the reference form of
/// [`PreparedRay::slab`]: the same operations on the same numbers, so that the
/// interval of a node contains those of the gate boxes inside it.
struct ChildrenTest<L> {
    origin: [L; 3],
    near_reciprocal: [L; 3],
    far_reciprocal: [L; 3],
    t_min: L,
    negative: [bool; 3],
}

impl<L: Lanes> ChildrenTest<L> {
    #[inline(always)]
    fn new(ray: &PreparedRay) -> Self {
        Self {
            origin: ray.origin().to_array().map(L::splat),
            near_reciprocal: ray.near_reciprocal().to_array().map(L::splat),
            far_reciprocal: ray.far_reciprocal().to_array().map(L::splat),
            t_min: L::splat(ray.t_min()),
            negative: Axis::ALL.map(|axis| ray.is_negative(axis)),
        }
    }

    /// Where the ray enters each box, and which it meets between its `t_min` and
    /// `t_max`: a bit for each.
    #[inline(always)]
    fn meets(&self, node: &WideNode, t_max: f32) -> (L, u32) {
        let (mut near, mut far) = (self.t_min, L::splat(t_max));
        for axis in 0..3 {
            let negative = self.negative[axis];
            let entry = L::from_slice(node.planes(axis, negative));
            let exit = L::from_slice(node.planes(axis, !negative));
            let entry = (entry - self.origin[axis]) * self.near_reciprocal[axis];
            let exit = (exit - self.origin[axis]) * self.far_reciprocal[axis];
            near = near.max_or_keep(entry);
            far = far.min_or_keep(exit);
        }
        (near, near.le_mask(far))
    }
}
