//! From a BVH to a wide dual-split tree.
//!
//! ```text
//! convert(inner node of the BVH, region that is left of space):
//!     children := its two children
//!     while there are fewer than eight: replace the inner one with the largest box
//!         by its two children
//!     for each child: the at most four planes of its box that leave least of the region
//!     convert the children, each in the region that its planes leave
//! ```

use accel_bvh::{Bvh, BvhNode, NodeHandle};
use accel_core::{Aabb, AccelerationStructure, BuildBudget, BuildError, Primitive};

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
        let root = match bvh.root() {
            Some((handle, bounds)) => Some((convert(bvh, handle, bounds, &mut words)?, bounds)),
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

/// A node of the BVH that becomes a child.
#[derive(Clone, Copy)]
struct Child {
    handle: NodeHandle,
    bounds: Aabb,
    /// Edges of the BVH from its root.
    level: u32,
}

/// A child whose node is still to be written.
struct Pending {
    child: Child,
    /// What is left of space.
    region: Aabb,
    /// How many nodes may still be put off on a way down from here.
    room: u32,
    /// The word that says where it is; `None` for the root.
    pointer: Option<usize>,
}

fn convert<P: Primitive>(
    bvh: &Bvh<P>,
    root: NodeHandle,
    bounds: Aabb,
    words: &mut Vec<u32>,
) -> Result<WidePointer, BuildError> {
    let mut first = None;
    let mut pending = vec![Pending {
        child: Child {
            handle: root,
            bounds,
            level: 0,
        },
        region: bounds,
        room: BuildBudget::DEEPEST,
        pointer: None,
    }];
    while let Some(next) = pending.pop() {
        let target = match bvh.node(next.child.handle) {
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
            push_children(bvh, &next, words, &mut pending);
        }
    }
    Ok(first.expect("the root comes first"))
}

/// Writes the node of an inner node of the BVH; its children are then pending.
fn push_children<P: Primitive>(
    bvh: &Bvh<P>,
    node: &Pending,
    words: &mut Vec<u32>,
    pending: &mut Vec<Pending>,
) {
    let children = open(bvh, node);
    let room = node.room - (children.len() as u32 - 1);
    let carved: Vec<_> = children
        .iter()
        .map(|child| planes_towards(node.region, child.bounds))
        .collect();
    let planes: Vec<_> = carved.iter().map(|&(planes, _)| planes).collect();
    let pointers = push_node(words, &planes);
    let new = children.into_iter().zip(carved).zip(pointers..);
    let new = new.map(|((child, (_, region)), pointer)| Pending {
        child,
        region,
        room,
        pointer: Some(pointer),
    });
    let first = pending.len();
    pending.extend(new);
    // The first child is written next.
    pending[first..].reverse();
}

/// The children of a node, two to eight: those of the BVH, the largest opened again and
/// again (Wald, Benthin and Boulos 2008).
///
/// A ray puts off all children but one. Whatever is opened, there is room for a way down
/// that opens nothing more.
fn open<P: Primitive>(bvh: &Bvh<P>, node: &Pending) -> Vec<Child> {
    let mut children: Vec<Child> = children_of(bvh, node.child).into_iter().flatten().collect();
    let fits = |children: &[Child]| {
        let highest = children.iter().map(|child| child.level).min().unwrap_or(0);
        children.len() as u32 - 1 + (bvh.depth() - highest) <= node.room
    };
    while children.len() < LANES {
        let inner = (0..children.len()).filter(|&index| !children[index].handle.is_leaf());
        let area = |index: &usize| children[*index].bounds.half_area();
        let Some(largest) = inner.max_by(|a, b| area(a).total_cmp(&area(b))) else {
            break;
        };
        let mut opened = children.clone();
        let below = children_of(bvh, children[largest]).into_iter().flatten();
        opened.splice(largest..=largest, below);
        if !fits(&opened) {
            break;
        }
        children = opened;
    }
    children
}

fn children_of<P: Primitive>(bvh: &Bvh<P>, child: Child) -> Option<[Child; 2]> {
    match bvh.node(child.handle) {
        BvhNode::Leaf(_) => None,
        BvhNode::Inner { bounds, children } => Some([0, 1].map(|side| Child {
            handle: children[side],
            bounds: bounds[side],
            level: child.level + 1,
        })),
    }
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
