//! From a BVH to its compact form.
//!
//! Sharing planes takes boxes that are the union of their children. Where spatial
//! splits made inner boxes larger, they are fitted first; the leaves keep theirs.

use accel_core::{Aabb, AccelerationStructure, BuildError, Primitive};

use super::CompactBvh;
use super::node::{CompactNode, Pointer, Target};
use crate::{Bvh, BvhNode};

impl<P: Primitive> CompactBvh<P> {
    /// The compact form of `bvh`, whoever built that. The primitives in its leaves
    /// are copied; hits name them as before.
    ///
    /// # Errors
    /// [`BuildError::OffsetOverflow`] if the tree has more than 2^28 inner nodes or
    /// leaf numbers.
    pub fn from_bvh(bvh: &Bvh<P>) -> Result<Self, BuildError> {
        let mut nodes = Vec::new();
        let root = match bvh.root() {
            Some(_) => Some(convert(bvh, &mut nodes)?),
            None => None,
        };
        Ok(Self {
            nodes,
            stored: AccelerationStructure::stored(bvh).clone(),
            root,
            depth: bvh.depth(),
        })
    }
}

/// A node on the way from words to words.
struct Visited {
    bounds: Aabb,
    target: Target,
}

/// Writes all inner nodes in depth-first order; returns the root and its box.
fn convert<P: Primitive>(
    bvh: &Bvh<P>,
    nodes: &mut Vec<CompactNode>,
) -> Result<(Pointer, Aabb), BuildError> {
    let (order, inner_count) = depth_first(bvh);
    let leaf = Pointer::new(Target::Leaf(0))?;
    nodes.resize(
        inner_count as usize,
        CompactNode::encode(&[Aabb::EMPTY; 2], [leaf; 2]),
    );
    // Subtrees whose parent is still to come, the left one on top.
    let mut finished: Vec<(Pointer, Aabb)> = Vec::new();
    for Visited { bounds, target } in order.into_iter().rev() {
        let pointer = Pointer::new(target)?;
        let fitted = match target {
            Target::Leaf(_) => bounds,
            Target::Inner(index) => {
                let mut child = || finished.pop().expect("children come after their parent");
                let ((left, left_bounds), (right, right_bounds)) = (child(), child());
                let bounds = [left_bounds, right_bounds];
                nodes[index as usize] = CompactNode::encode(&bounds, [left, right]);
                left_bounds.union(&right_bounds)
            }
        };
        finished.push((pointer, fitted));
    }
    Ok(finished.pop().expect("the root is finished last"))
}

/// All nodes, parents before children, left subtrees before right ones, and how
/// many of them are inner nodes, which are numbered in this order.
fn depth_first<P: Primitive>(bvh: &Bvh<P>) -> (Vec<Visited>, u32) {
    let mut order = Vec::new();
    let mut inner_count = 0;
    let mut pending = Vec::from_iter(bvh.root());
    while let Some((handle, bounds)) = pending.pop() {
        let target = match bvh.node(handle) {
            BvhNode::Leaf(leaf) => Target::Leaf(leaf),
            BvhNode::Inner {
                bounds: [left_bounds, right_bounds],
                children: [left, right],
            } => {
                pending.extend([(right, right_bounds), (left, left_bounds)]);
                inner_count += 1;
                Target::Inner(inner_count - 1)
            }
        };
        order.push(Visited { bounds, target });
    }
    (order, inner_count)
}
