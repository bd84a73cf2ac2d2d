//! The codec of wide nodes. This is the only file that knows their layout.
//!
//! | bytes | hold |
//! |---|---|
//! | 0 to 95 | low planes of eight children: x, then y, then z |
//! | 96 to 191 | high planes: x, then y, then z |
//! | 192 to 223 | where the children are |
//!
//! A child takes bit 31 for whether it is a leaf and the lower bits for its node,
//! or the number of its leaf. Places without a child have a box that contains
//! nothing, and one pointer of their own, since rays whose direction constrains
//! nothing meet even that.

use accel_core::structure::predicted;
use accel_core::{Aabb, BuildError};

/// Bytes of a node of a [`WideBvh`](super::WideBvh); leaves take none.
pub const WIDE_NODE_BYTES: usize = size_of::<WideNode>();

const _: () = assert!(WIDE_NODE_BYTES == 224);

/// The most children of a node.
pub(super) const WIDTH: usize = 8;

const IS_LEAF: u32 = 1 << 31;

/// The largest index of a node, and the largest number of a leaf.
pub(super) const MAX_INDEX: usize = (IS_LEAF - 2) as usize;

/// A node or a leaf, in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pointer(u32);

/// A [`Pointer`] taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// The node at this index.
    Inner(u32),
    /// The leaf of this number.
    Leaf(u32),
    /// A place without a child.
    Nothing,
}

impl Pointer {
    const NOTHING: Self = Self(u32::MAX);

    /// # Errors
    /// [`BuildError::OffsetOverflow`] if the index takes more than 31 bits.
    pub(super) fn new(target: Target) -> Result<Self, BuildError> {
        let (index, flag) = match target {
            Target::Inner(index) => (index, 0),
            Target::Leaf(leaf) => (leaf, IS_LEAF),
            Target::Nothing => return Ok(Self::NOTHING),
        };
        if index as usize > MAX_INDEX {
            return Err(BuildError::OffsetOverflow {
                needed: index as usize,
                limit: MAX_INDEX,
            });
        }
        Ok(Self(index | flag))
    }

    #[inline(always)]
    pub(super) fn target(self) -> Target {
        if self.0 & IS_LEAF == 0 {
            Target::Inner(self.0)
        } else if self == Self::NOTHING {
            Target::Nothing
        } else {
            Target::Leaf(self.0 & !IS_LEAF)
        }
    }
}

/// Up to eight children with their boxes, coordinate by coordinate.
#[derive(Clone, Debug)]
#[repr(C, align(32))]
pub(super) struct WideNode {
    /// Low, then high; axis; child.
    planes: [[[f32; WIDTH]; 3]; 2],
    children: [Pointer; WIDTH],
}

impl WideNode {
    /// The node of these children, of which there are at most eight.
    pub(super) fn new(children: &[(Pointer, Aabb)]) -> Self {
        let mut node = Self {
            planes: [[[f32::INFINITY; WIDTH]; 3], [[f32::NEG_INFINITY; WIDTH]; 3]],
            children: [Pointer::NOTHING; WIDTH],
        };
        for (place, &(pointer, bounds)) in children.iter().enumerate() {
            node.children[place] = pointer;
            for axis in 0..3 {
                node.planes[0][axis][place] = bounds.min[axis];
                node.planes[1][axis][place] = bounds.max[axis];
            }
        }
        node
    }

    /// Names the child in `place`, which has a box already.
    pub(super) fn set_child(&mut self, place: usize, pointer: Pointer) {
        self.children[place] = pointer;
    }

    /// The planes of all children on one side of an axis.
    #[inline(always)]
    pub(super) fn planes(&self, axis: usize, high: bool) -> &[f32; WIDTH] {
        &self.planes[usize::from(high)][axis]
    }

    #[inline(always)]
    pub(super) fn child(&self, place: usize) -> Pointer {
        self.children[place]
    }

    /// As [`child`](Self::child), for the one that is visited next.
    #[inline(always)]
    pub(super) fn next_child(&self, place: usize) -> Pointer {
        predicted(&self.children, place)
    }

    /// The children and their boxes.
    pub(super) fn children(&self) -> impl DoubleEndedIterator<Item = (Pointer, Aabb)> + '_ {
        let corner = |high: bool, place: usize| -> [f32; 3] {
            [0, 1, 2].map(|axis| self.planes(axis, high)[place])
        };
        let children = (0..WIDTH).zip(&self.children);
        children
            .filter(|(_, pointer)| **pointer != Pointer::NOTHING)
            .map(move |(place, &pointer)| {
                (
                    pointer,
                    Aabb::new(corner(false, place), corner(true, place)),
                )
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pointers_and_boxes_come_back_as_they_were_put_in() {
        let bounds = |number: f32| Aabb::new([-number; 3], [number, 2.0, 3.0 * number]);
        let targets = [
            Target::Inner(0),
            Target::Leaf(0),
            Target::Inner(MAX_INDEX as u32),
            Target::Leaf(MAX_INDEX as u32),
        ];
        let children: Vec<_> = (1..)
            .zip(targets)
            .map(|(number, target)| (Pointer::new(target).unwrap(), bounds(number as f32)))
            .collect();
        let node = WideNode::new(&children);
        assert_eq!(node.children().collect::<Vec<_>>(), children);
        for ((pointer, _), target) in node.children().zip(targets) {
            assert_eq!(pointer.target(), target);
        }
        assert_eq!(node.child(7).target(), Target::Nothing);
        assert!(Pointer::new(Target::Leaf(MAX_INDEX as u32 + 1)).is_err());
    }
}
