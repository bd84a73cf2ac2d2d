//! From a BVH to a wide dual-split tree.
//!
//! ```text
//! convert(inner node of the BVH, region that is left of space):
//!     children := those that a wide BVH has there
//!     for each child: the at most four planes of its box that leave least of the region
//!     convert the children, each in the region that its planes leave
//! ```

use accel_bvh::{Bvh, BvhNode, KeptNode, WideCollapse};
use accel_core::{Aabb, AccelerationStructure, BuildError, Primitive};

use super::WideDualSplitTree;
use super::node::{
    ChildPlanes, LANES, MAX_TARGET, PADDING, ROWS, Target, WidePointer, push_node, set_pointer,
};
use crate::codec::BoxPlane;

impl<P: Primitive> WideDualSplitTree<P> {
    /// The wide form of `bvh`, whoever built that. The primitives in its leaves are
    /// copied; hits name them as before.
    ///
    /// # Errors
    /// [`BuildError::OffsetOverflow`] if the tree has more than 2^31 words or leaf
    /// numbers.
    pub fn from_bvh(bvh: &Bvh<P>) -> Result<Self, BuildError> {
        let mut words = Vec::new();
        let kept = WideCollapse::new(bvh);
        let root = match kept.root() {
            Some(root) => Some((convert(bvh, &kept, root, &mut words)?, root.bounds)),
            None => None,
        };
        words.resize(words.len() + PADDING, 0);
        Ok(Self {
            words,
            stored: AccelerationStructure::stored(bvh).clone(),
            root,
        })
    }
}

/// A node of the BVH whose own is still to be written.
struct Pending {
    node: KeptNode,
    /// What is left of space.
    region: Aabb,
    /// The word that says where it is; `None` for the root.
    pointer: Option<usize>,
}

fn convert<P: Primitive>(
    bvh: &Bvh<P>,
    kept: &WideCollapse<'_, P, LANES>,
    root: KeptNode,
    words: &mut Vec<u32>,
) -> Result<WidePointer, BuildError> {
    let mut first = None;
    let mut pending = vec![Pending {
        node: root,
        region: root.bounds,
        pointer: None,
    }];
    while let Some(next) = pending.pop() {
        let target = match bvh.node(next.node.handle) {
            BvhNode::Leaf(leaf) => Target::Leaf(leaf),
            BvhNode::Inner { .. } => Target::Inner(words.len() as u32),
        };
        let (Target::Leaf(number) | Target::Inner(number)) = target;
        if number as usize > MAX_TARGET || words.len() > MAX_TARGET {
            return Err(BuildError::OffsetOverflow {
                needed: words.len().max(number as usize),
                limit: MAX_TARGET,
            });
        }
        let pointer = WidePointer::new(target);
        match next.pointer {
            Some(at) => set_pointer(words, at, pointer),
            None => first = Some(pointer),
        }
        if matches!(target, Target::Inner(_)) {
            push_children(kept, &next, words, &mut pending);
        }
    }
    Ok(first.expect("the root comes first"))
}

/// Writes the node of an inner node of the BVH; its children are then pending.
fn push_children<P: Primitive>(
    kept: &WideCollapse<'_, P, LANES>,
    parent: &Pending,
    words: &mut Vec<u32>,
    pending: &mut Vec<Pending>,
) {
    let children = kept.children(&parent.node);
    let carved: Vec<_> = children
        .iter()
        .map(|child| planes_towards(parent.region, child.bounds))
        .collect();
    let planes: Vec<_> = carved.iter().map(|&(planes, _)| planes).collect();
    let pointers = push_node(words, &planes);
    let new = children.into_iter().zip(carved).zip(pointers..);
    let new = new.map(|((node, (_, region)), pointer)| Pending {
        node,
        region,
        pointer: Some(pointer),
    });
    let first = pending.len();
    pending.extend(new);
    // The first child is written next.
    pending[first..].reverse();
}

/// The planes of `target` that leave least of `region`, no more than a child may have,
/// and what they leave.
fn planes_towards(region: Aabb, target: Aabb) -> (ChildPlanes, Aabb) {
    let planes = [0, 1, 2, 3, 4, 5].map(BoxPlane::from_index);
    let is_loose = |plane: &BoxPlane| plane.carve(region, plane.of(&target)) != region;
    let loose: Vec<BoxPlane> = planes.into_iter().filter(is_loose).collect();
    let chosen = |set: u32| {
        let planes = loose.iter().enumerate();
        planes.filter_map(move |(index, &plane)| (set >> index & 1 != 0).then_some(plane))
    };
    let left = |set: u32| {
        chosen(set).fold(region, |region, plane| {
            plane.carve(region, plane.of(&target))
        })
    };
    let most = loose.len().min(ROWS) as u32;
    let best = (0..1_u32 << loose.len())
        .filter(|set| set.count_ones() == most)
        .min_by(|&a, &b| left(a).half_area().total_cmp(&left(b).half_area()))
        .expect("at least the empty set has that many planes");
    let mut rows = [None; ROWS];
    for (row, plane) in rows.iter_mut().zip(chosen(best)) {
        *row = Some((plane, plane.of(&target)));
    }
    (ChildPlanes(rows), left(best))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_planes_that_cut_most_are_kept() {
        let region = Aabb::new([0.0; 3], [10.0; 3]);
        let target = Aabb::new([1.0, 0.5, 4.0], [8.5, 6.0, 5.0]);
        let (planes, left) = planes_towards(region, target);
        assert!(planes.0.iter().all(Option::is_some));
        assert_eq!(left, Aabb::new([0.0, 0.0, 4.0], [8.5, 6.0, 5.0]));
        let (planes, left) = planes_towards(region, region);
        assert!(planes.0.iter().all(Option::is_none));
        assert_eq!(left, region);
    }
}
