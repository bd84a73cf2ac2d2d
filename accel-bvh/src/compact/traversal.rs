//! The one traversal of compact nodes.
//!
//! ```text
//! node := root, [near, far] := the ray's part in its box
//! loop:
//!     leaf:   offer its hits
//!     inner:  both children begin with [near, far]; every plane cuts the interval
//!             of the child that owns it; go on as in a BVH
//!     otherwise: take the child put off last that is not behind the best hit
//! ```
//!
//! Planes are met in the reference form of [`PreparedRay::slab`], and maximum and
//! minimum are exact: a child's interval is bit for bit that of its box.

use accel_core::geometry::Axis;
use accel_core::layout::LeafStorage;
use accel_core::query::Query;
use accel_core::ray::{max_or_keep, min_or_keep};
use accel_core::simd::F32x4;
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::TraversalStack;
use accel_core::{PreparedRay, Primitive};

use super::CompactBvh;
use super::node::{COMPACT_NODE_BYTES, CompactNode, Pointer, Target};

/// A child put off, and where the ray leaves it.
#[derive(Clone, Copy)]
struct PutOff {
    pointer: Pointer,
    far: f32,
}

pub(super) fn traverse<P: Primitive, Q: Query, S: TraversalStatistics>(
    bvh: &CompactBvh<P>,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) {
    let Some((mut pointer, bounds)) = bvh.root else {
        return;
    };
    statistics.test_boxes(1);
    let whole = ray.slab(&bounds);
    let mut near = max_or_keep(ray.t_min(), whole.near);
    let mut far = min_or_keep(query.t_max(), whole.far);
    if near > far {
        return;
    }
    let planes = SharedPlaneTest::new(ray);
    let mut stack: TraversalStack<PutOff> = TraversalStack::new();
    loop {
        match pointer.target() {
            Target::Leaf(leaf) => {
                // Its word lies in the parent.
                statistics.visit_node(NodeKind::Leaf, 0);
                let leaves = bvh.stored.leaves();
                if leaves
                    .intersect_leaf(leaf, ray, query, statistics)
                    .is_break()
                {
                    return;
                }
            }
            Target::Inner(index) => {
                statistics.visit_node(NodeKind::Inner, COMPACT_NODE_BYTES as u32);
                statistics.test_planes(6);
                let node = &bvh.nodes[index as usize];
                let cut = planes.cut(node, near, far);
                let [left, right] = node.children();
                if cut.met == 0b11 {
                    let (nearer, farther) = if cut.near[0] <= cut.near[1] {
                        (0, 1)
                    } else {
                        (1, 0)
                    };
                    let children = [left, right];
                    let put_off = PutOff {
                        pointer: children[farther],
                        far: cut.far[farther],
                    };
                    stack.push(put_off, cut.near[farther]);
                    (pointer, near, far) = (children[nearer], cut.near[nearer], cut.far[nearer]);
                    continue;
                }
                if cut.met == 0b01 {
                    (pointer, near, far) = (left, cut.near[0], cut.far[0]);
                    continue;
                }
                if cut.met == 0b10 {
                    (pointer, near, far) = (right, cut.near[1], cut.far[1]);
                    continue;
                }
            }
        }
        let Some(entry) = stack.pop_entry_within(query.t_max()) else {
            return;
        };
        pointer = entry.node.pointer;
        near = entry.near;
        far = min_or_keep(query.t_max(), entry.node.far);
    }
}

/// The intervals of both children, and which of them are not empty: bit 0 for the
/// left one, bit 1 for the right one.
struct Cut {
    near: [f32; 2],
    far: [f32; 2],
    met: u32,
}

/// What meeting six planes takes of a ray.
struct SharedPlaneTest([AxisTest; 3]);

/// Lanes hold entry left and right, then exit left and right, negated: so that
/// every plane cuts by the same maximum.
struct AxisTest {
    origin: F32x4,
    reciprocal: F32x4,
    /// The planes that the ray enters and leaves through.
    planes: [usize; 2],
    is_negative: bool,
}

/// By the owners of the low and the high plane of an axis, what each of the four
/// lanes may be at most: nothing limits the owner's, the other one is kept from
/// cutting anything.
fn limits(is_negative: bool, owners: usize) -> F32x4 {
    const OWN: f32 = f32::INFINITY;
    const OTHER: f32 = f32::NEG_INFINITY;
    const LEFT_RIGHT: [[f32; 2]; 2] = [[OWN, OTHER], [OTHER, OWN]];
    let (low, high) = (LEFT_RIGHT[owners & 1], LEFT_RIGHT[owners >> 1 & 1]);
    let (entry, exit) = if is_negative {
        (high, low)
    } else {
        (low, high)
    };
    F32x4::new(entry[0], entry[1], exit[0], exit[1])
}

impl SharedPlaneTest {
    #[inline]
    fn new(ray: &PreparedRay) -> Self {
        Self(Axis::ALL.map(|axis| {
            let (near, far) = (
                axis.of(ray.near_reciprocal()),
                axis.of(ray.far_reciprocal()),
            );
            let is_negative = ray.is_negative(axis);
            let entry = 2 * axis.index() + usize::from(is_negative);
            AxisTest {
                origin: F32x4::splat(axis.of(ray.origin())),
                reciprocal: F32x4::new(near, near, -far, -far),
                planes: [entry, entry ^ 1],
                is_negative,
            }
        }))
    }

    #[inline]
    fn cut(&self, node: &CompactNode, near: f32, far: f32) -> Cut {
        let owners = node.owners();
        let mut ends = F32x4::new(near, near, -far, -far);
        for (axis, test) in self.0.iter().enumerate() {
            let [entry, exit] = test.planes.map(|plane| node.plane(plane));
            let distance = (F32x4::new(entry, entry, exit, exit) - test.origin) * test.reciprocal;
            let limits = limits(test.is_negative, owners >> (2 * axis));
            // NaN, of a ray inside the plane, passes the limit and cuts nothing.
            ends = ends.max_or_keep(distance.min_or_keep(limits));
        }
        let exits = F32x4::splat(0.0) - ends.high();
        Cut {
            near: ends.first_two(),
            far: exits.first_two(),
            met: ends.le_mask(exits) & 0b11,
        }
    }
}
