//! The one traversal, for every query and with or without statistics (Lin 2019,
//! section 3.4 and Algorithm 1).
//!
//! ```text
//! node := root, [near, far] := the ray's part in its box
//! loop:
//!     splitting:   the child that the ray comes to first ends at the plane that
//!                  the ray leaves through; the other begins where it enters
//!                  through the other plane. Both not empty: put the farther off,
//!                  go to the closer; one not empty: go there
//!     carving:     cut [near, far] at its planes; if it is not empty, go to the
//!                  child, or offer the hits of the leaf
//!     plain leaf:  offer its hits
//!     otherwise:   take the child put off last that is not behind the best hit
//! ```
//!
//! Which child comes first follows from the sign of the direction, as in a
//! kd-tree. No hit ends the traversal: children may overlap.
//!
//! Every plane is met in the reference form of [`PreparedRay::slab`], and
//! maximum and minimum are exact: after the planes of a whole box, inherited or
//! carved, `near` and `far` are bit for bit those of that box's slab test.

mod axis_test;
mod side_test;

use std::ops::ControlFlow;

use accel_core::layout::LeafStorage;
use accel_core::query::Query;
use accel_core::ray::{max_or_keep, min_or_keep};
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::{RayPart, TraversalStack};
use accel_core::{PreparedRay, Primitive};

use crate::codec::{FirstWord, LEAF_BYTES, LEAF_WORDS, NODE_BYTES, NODE_WORDS};
use crate::node_set::NodeSet;
use crate::tree::PlaneTree;

pub use axis_test::AxisTests;
pub use side_test::SideTests;

/// A node put off, and where the ray leaves it.
#[derive(Clone, Copy)]
struct PutOff {
    position: u32,
    far: f32,
}

pub(crate) fn traverse<P: Primitive, N: NodeSet, Q: Query, S: TraversalStatistics>(
    tree: &PlaneTree<P, N>,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) {
    let Some(bounds) = tree.bounds else { return };
    statistics.test_boxes(1);
    let whole = ray.slab(&bounds);
    let near = max_or_keep(ray.t_min(), whole.near);
    let far = min_or_keep(query.t_max(), whole.far);
    // Neither is NaN: both began as numbers and kept them.
    if near <= far {
        let root = RayPart { node: 0, near, far };
        let _ = traverse_below(tree, root, ray, query, statistics);
    }
}

/// Traverses the part of the tree below a node, inside of whose region the ray has this
/// part; breaks when the query does.
#[inline]
pub(crate) fn traverse_below<P: Primitive, N: NodeSet, Q: Query, S: TraversalStatistics>(
    tree: &PlaneTree<P, N>,
    part: RayPart,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) -> ControlFlow<()> {
    let RayPart {
        node: mut position,
        mut near,
        mut far,
    } = part;
    let words = tree.words.padded();
    let axes = AxisTests::new(ray);
    let carving = N::carving_test(ray);
    let mut stack: TraversalStack<PutOff> = TraversalStack::new();
    loop {
        let place = NodePlace::new(words, position);
        let node = place.first_word();
        if node.splits() {
            visit_two_planes(statistics, NodeKind::Splitting);
            let cut = axes.of(node).cut(place.planes(), (near, far));
            let (farther_near, nearer_far) = cut;
            let first = position + node.offset();
            let [closer, farther] = axes.in_order(node, first, N::first_child_words(node));
            let meets_farther = farther_near <= far;
            if near <= nearer_far {
                // Whether both are met is hard to predict, and the way on is the
                // same: no branch.
                let put_off = PutOff {
                    position: farther,
                    far,
                };
                stack.push_if(meets_farther, put_off, farther_near);
                (position, far) = (closer, nearer_far);
                continue;
            }
            if meets_farther {
                (position, near) = (farther, farther_near);
                continue;
            }
        } else {
            if !node.carves() {
                statistics.visit_node(NodeKind::Leaf, LEAF_BYTES as u32);
            }
            (near, far) = N::carve(&carving, &axes, &place, (near, far), statistics);
            if near <= far {
                if !node.is_leaf() {
                    position += node.offset();
                    continue;
                }
                let leaves = tree.stored.leaves();
                leaves.intersect_leaf(node.offset(), ray, query, statistics)?;
            }
        }
        let Some(entry) = stack.pop_entry_within(query.t_max()) else {
            return ControlFlow::Continue(());
        };
        position = entry.node.position;
        near = entry.near;
        far = min_or_keep(query.t_max(), entry.node.far);
    }
}

/// Tells of a visit to a node with two planes.
#[inline(always)]
pub(crate) fn visit_two_planes<S: TraversalStatistics>(statistics: &mut S, kind: NodeKind) {
    statistics.visit_node(kind, NODE_BYTES as u32);
    statistics.test_planes(2);
}

/// A node where it lies among the words of a tree.
#[derive(Clone, Copy)]
pub struct NodePlace<'a> {
    words: &'a [u32],
    position: usize,
    /// Of a leaf without planes, the others are other words of the tree, or padding.
    own: &'a [u32; NODE_WORDS],
}

impl<'a> NodePlace<'a> {
    /// At the position of a node in words that padding follows.
    #[inline(always)]
    pub(crate) fn new(words: &'a [u32], position: u32) -> Self {
        let position = position as usize;
        let own = words[position..position + NODE_WORDS].first_chunk();
        Self {
            words,
            position,
            own: own.expect("the slice has that length"),
        }
    }

    #[inline(always)]
    pub(crate) fn first_word(&self) -> FirstWord {
        FirstWord(self.own[0])
    }

    /// The planes of a node that has two.
    #[inline(always)]
    pub(crate) fn planes(&self) -> &'a [u32; 2] {
        self.own.last_chunk().expect("two of three words")
    }

    /// The planes of a node that may have more, and what follows them.
    #[inline(always)]
    pub(crate) fn planes_and_rest(&self) -> &'a [u32] {
        &self.words[self.position + LEAF_WORDS..]
    }
}
