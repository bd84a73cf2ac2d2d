//! The one traversal, for every query and with or without statistics.
//!
//! ```text
//! node := root, if the ray meets its box
//! loop:
//!     leaf:   offer its hits
//!     inner:  both boxes met:  put the farther child off, go to the nearer
//!             one met:         go there
//!     otherwise: take the child put off last that is not behind the best hit
//! ```

use accel_core::PreparedRay;
use accel_core::Primitive;
use accel_core::geometry::Axis;
use accel_core::layout::LeafStorage;
use accel_core::query::Query;
use accel_core::ray::{FAR_PAD, NEAR_PAD, max_or_keep, min_or_keep};
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::TraversalStack;

use crate::Bvh;
use crate::node::{INNER_NODE_BYTES, InnerNode, LEAF_NODE_BYTES, NodePointer};

pub(crate) fn traverse<P: Primitive, Q: Query, S: TraversalStatistics>(
    bvh: &Bvh<P>,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) {
    let Some(root) = bvh.root else { return };
    statistics.test_boxes(1);
    let whole = ray.slab(&root.bounds);
    let near = max_or_keep(ray.t_min(), whole.near);
    if !(near <= whole.far && near <= query.t_max()) {
        return;
    }
    let test = SiblingTest::new(ray);
    let mut stack = TraversalStack::new();
    let mut next = Some(root.pointer);
    while let Some(pointer) = next {
        next = match pointer {
            NodePointer::Leaf(offset) => {
                statistics.visit_node(NodeKind::Leaf, LEAF_NODE_BYTES as u32);
                let leaf = bvh.leaf_number(offset);
                let flow = bvh.storage.intersect_leaf(leaf, ray, query, statistics);
                if flow.is_break() {
                    return;
                }
                None
            }
            NodePointer::Inner(offset) => {
                statistics.visit_node(NodeKind::Inner, INNER_NODE_BYTES as u32);
                statistics.test_boxes(2);
                let node = bvh.inner_node(offset);
                let (near, far) = test.intervals(&node, query.t_max());
                let [left, right] = node.children().pointers();
                match (near[0] <= far[0], near[1] <= far[1]) {
                    (true, true) if near[0] <= near[1] => {
                        stack.push(right, near[1]);
                        Some(left)
                    }
                    (true, true) => {
                        stack.push(left, near[0]);
                        Some(right)
                    }
                    (true, false) => Some(left),
                    (false, true) => Some(right),
                    (false, false) => None,
                }
            }
        };
        if next.is_none() {
            next = stack.pop_within(query.t_max());
        }
    }
}

/// The slab test of two boxes at once, in the reference form of
/// [`PreparedRay::slab`]: the same operations on the same numbers, so that the
/// interval of a node contains those of the gate boxes inside it.
struct SiblingTest {
    origin: [f32; 3],
    reciprocal: [f32; 3],
    negative: [bool; 3],
    t_min: f32,
}

impl SiblingTest {
    #[inline]
    fn new(ray: &PreparedRay) -> Self {
        Self {
            origin: ray.origin().to_array(),
            reciprocal: ray.reciprocal().to_array(),
            negative: Axis::ALL.map(|axis| ray.is_negative(axis)),
            t_min: ray.t_min(),
        }
    }

    /// Where the ray enters and leaves the left and the right box, between its
    /// `t_min` and `t_max`.
    #[inline]
    fn intervals(&self, node: &InnerNode<'_>, t_max: f32) -> ([f32; 2], [f32; 2]) {
        let mut near = [f32::NEG_INFINITY; 2];
        let mut far = [f32::INFINITY; 2];
        for axis in 0..3 {
            let entry = node.planes(axis, self.negative[axis]);
            let exit = node.planes(axis, !self.negative[axis]);
            for side in 0..2 {
                let distance = |plane: f32| (plane - self.origin[axis]) * self.reciprocal[axis];
                near[side] = max_or_keep(near[side], distance(entry[side]));
                far[side] = min_or_keep(far[side], distance(exit[side]));
            }
        }
        (
            near.map(|near| max_or_keep(self.t_min, near * NEAR_PAD)),
            far.map(|far| min_or_keep(t_max, far * FAR_PAD)),
        )
    }
}
