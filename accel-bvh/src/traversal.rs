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

use std::ops::ControlFlow;

use accel_core::geometry::Axis;
use accel_core::glam::Vec3;
use accel_core::layout::LeafStorage;
use accel_core::query::Query;
use accel_core::ray::max_or_keep;
use accel_core::simd::F32x4;
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::TraversalStack;
use accel_core::{PreparedRay, Primitive};

use crate::Bvh;
use crate::node::{INNER_NODE_BYTES, InnerNode, LEAF_NODE_BYTES, Node, NodePointer};

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
    let _ = traverse_below(bvh, root.pointer, ray, query, statistics);
}

/// Traverses the part of the tree below `pointer`, whose box the ray meets;
/// breaks when the query does.
#[inline]
pub(crate) fn traverse_below<P: Primitive, Q: Query, S: TraversalStatistics>(
    bvh: &Bvh<P>,
    mut pointer: NodePointer,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) -> ControlFlow<()> {
    let test = SiblingTest::new(ray);
    let mut stack = TraversalStack::new();
    loop {
        match pointer.kind() {
            Node::Leaf(offset) => {
                statistics.visit_node(NodeKind::Leaf, LEAF_NODE_BYTES as u32);
                let (leaf, leaves) = (bvh.leaf_number(offset), bvh.stored.leaves());
                leaves.intersect_leaf(leaf, ray, query, statistics)?;
            }
            Node::Inner(offset) => {
                statistics.visit_node(NodeKind::Inner, INNER_NODE_BYTES as u32);
                statistics.test_boxes(2);
                let node = bvh.inner_node(offset);
                let (near, met) = test.meets(&node, query.t_max());
                let [left, right] = node.children().pointers();
                // Branches, not selections: where the prediction is right, the
                // next node is on its way before this test is done. Selecting
                // by index was 0.75 times as fast on coherent rays.
                if met == 0b11 {
                    if near[0] <= near[1] {
                        stack.push(right, near[1]);
                        pointer = left;
                    } else {
                        stack.push(left, near[0]);
                        pointer = right;
                    }
                    continue;
                }
                if met == 0b01 {
                    pointer = left;
                    continue;
                }
                if met == 0b10 {
                    pointer = right;
                    continue;
                }
            }
        }
        match stack.pop_within(query.t_max()) {
            Some(next) => pointer = next,
            None => return ControlFlow::Continue(()),
        }
    }
}

/// The slab test of two boxes at once, in the reference form of
/// [`PreparedRay::slab`]: the same operations on the same numbers, so that the
/// interval of a node contains those of the gate boxes inside it.
///
/// Lanes hold left and right of x, then left and right of y; z has a register
/// of its own for entry and exit.
struct SiblingTest {
    origin_xy: F32x4,
    near_reciprocal_xy: F32x4,
    far_reciprocal_xy: F32x4,
    origin_z: F32x4,
    /// Near twice, then far twice.
    reciprocal_z: F32x4,
    t_min: F32x4,
    negative: [bool; 3],
}

impl SiblingTest {
    #[inline]
    fn new(ray: &PreparedRay) -> Self {
        let pairs = |v: Vec3| F32x4::new(v.x, v.x, v.y, v.y);
        let (near, far) = (ray.near_reciprocal(), ray.far_reciprocal());
        Self {
            origin_xy: pairs(ray.origin()),
            near_reciprocal_xy: pairs(near),
            far_reciprocal_xy: pairs(far),
            origin_z: F32x4::splat(ray.origin().z),
            reciprocal_z: F32x4::new(near.z, near.z, far.z, far.z),
            t_min: F32x4::splat(ray.t_min()),
            negative: Axis::ALL.map(|axis| ray.is_negative(axis)),
        }
    }

    /// Where the ray enters the left and the right box, and whether it meets
    /// them between its `t_min` and `t_max`: bit 0 for the left one, bit 1 for
    /// the right one.
    #[inline]
    fn meets(&self, node: &InnerNode<'_>, t_max: f32) -> ([f32; 2], u32) {
        let [x, y, z] = self.negative;
        let planes = |first: [f32; 2], second: [f32; 2]| {
            F32x4::new(first[0], first[1], second[0], second[1])
        };
        let entry_xy = planes(node.planes(0, x), node.planes(1, y));
        let exit_xy = planes(node.planes(0, !x), node.planes(1, !y));
        let both_z = planes(node.planes(2, z), node.planes(2, !z));
        let entry_xy = (entry_xy - self.origin_xy) * self.near_reciprocal_xy;
        let exit_xy = (exit_xy - self.origin_xy) * self.far_reciprocal_xy;
        let both_z = (both_z - self.origin_z) * self.reciprocal_z;

        let near = self.t_min.max_or_keep(entry_xy);
        let near = near.max_or_keep(near.high()).max_or_keep(both_z);
        let far = F32x4::splat(t_max).min_or_keep(exit_xy);
        let far = far.min_or_keep(far.high()).min_or_keep(both_z.high());
        (near.first_two(), near.le_mask(far) & 0b11)
    }
}
