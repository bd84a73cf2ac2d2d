//! The codec of compact nodes. This is the only file that knows their bits.
//!
//! | words | hold |
//! |---|---|
//! | 0 to 5 | planes: low x, high x, low y, high y, low z, high z |
//! | 6 | the left child, and whose the planes on x and the low one on y are |
//! | 7 | the right child, and whose the high plane on y and those on z are |
//!
//! A child takes bit 31 for whether it is a leaf and the lower 28 bits for its
//! node, or the number of its leaf; bits 28 to 30 tell of three planes whether
//! they are the right child's. The other child has the parent's plane there.

use accel_core::geometry::Axis;
use accel_core::{Aabb, BuildError};

/// Bytes of a node of a [`CompactBvh`](super::CompactBvh); leaves take none.
pub const COMPACT_NODE_BYTES: usize = size_of::<CompactNode>();

const _: () = assert!(COMPACT_NODE_BYTES == 32);

const IS_LEAF: u32 = 1 << 31;
const INDEX_BITS: u32 = 28;
const INDEX_MASK: u32 = (1 << INDEX_BITS) - 1;
const OWNERS_MASK: u32 = 0b111;
/// Owners that a child's word has room for.
const OWNERS_PER_WORD: u32 = 3;

/// The largest index of a node, and the largest number of a leaf.
pub(super) const MAX_INDEX: usize = INDEX_MASK as usize;

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
}

impl Pointer {
    /// # Errors
    /// [`BuildError::OffsetOverflow`] if the index takes more than 28 bits.
    pub(super) fn new(target: Target) -> Result<Self, BuildError> {
        let (index, flag) = match target {
            Target::Inner(index) => (index, 0),
            Target::Leaf(leaf) => (leaf, IS_LEAF),
        };
        if index as usize > MAX_INDEX {
            return Err(BuildError::OffsetOverflow {
                needed: index as usize,
                limit: MAX_INDEX,
            });
        }
        Ok(Self(index | flag))
    }

    #[inline]
    pub(super) fn target(self) -> Target {
        let index = self.0 & INDEX_MASK;
        if self.0 & IS_LEAF != 0 {
            Target::Leaf(index)
        } else {
            Target::Inner(index)
        }
    }
}

/// An inner node: half a cache line, and never in two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(align(32))]
pub(super) struct CompactNode([u32; 8]);

impl CompactNode {
    /// The node of two children in the union of their boxes.
    pub(super) fn encode(bounds: &[Aabb; 2], children: [Pointer; 2]) -> Self {
        let parent = bounds[0].union(&bounds[1]);
        let mut words = [0; 8];
        let mut owners = 0;
        for (index, plane) in words[..6].iter_mut().enumerate() {
            let [left, right] = bounds.map(|bounds| plane_of(&bounds, index));
            let is_right = left == plane_of(&parent, index);
            *plane = if is_right { right } else { left }.to_bits();
            owners |= u32::from(is_right) << index;
        }
        words[6] = children[0].0 | (owners & OWNERS_MASK) << INDEX_BITS;
        words[7] = children[1].0 | (owners >> OWNERS_PER_WORD) << INDEX_BITS;
        Self(words)
    }

    /// The plane at an index: twice the axis, and one more for the high one.
    #[inline]
    pub(super) fn plane(&self, index: usize) -> f32 {
        f32::from_bits(self.0[index & 7])
    }

    /// A bit per plane: whether it is the right child's.
    #[inline]
    pub(super) fn owners(&self) -> usize {
        let of_word = |word: u32| word >> INDEX_BITS & OWNERS_MASK;
        (of_word(self.0[6]) | of_word(self.0[7]) << OWNERS_PER_WORD) as usize
    }

    /// Left and right.
    #[inline]
    pub(super) fn children(&self) -> [Pointer; 2] {
        [6, 7].map(|word| Pointer(self.0[word] & (IS_LEAF | INDEX_MASK)))
    }

    /// The boxes of both children in a parent of box `parent`.
    pub(super) fn child_bounds(&self, parent: &Aabb) -> [Aabb; 2] {
        let mut bounds = [*parent; 2];
        for axis in Axis::ALL {
            for is_high in [false, true] {
                let index = 2 * axis.index() + usize::from(is_high);
                let owner = &mut bounds[self.owners() >> index & 1];
                let corner = if is_high {
                    &mut owner.max
                } else {
                    &mut owner.min
                };
                corner[axis.index()] = self.plane(index);
            }
        }
        bounds
    }
}

fn plane_of(bounds: &Aabb, index: usize) -> f32 {
    let corner = if index % 2 == 1 {
        bounds.max
    } else {
        bounds.min
    };
    corner[index / 2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_survive_encoding() {
        let outer = Aabb::new([0.0; 3], [10.0; 3]);
        let boxes = [
            Aabb::new([0.0, 1.0, 2.0], [4.0, 5.0, 10.0]),
            Aabb::new([3.0, 0.0, 0.0], [10.0, 10.0, 10.0]),
            outer,
            Aabb::new([0.0; 3], [0.0; 3]),
        ];
        let pointer = |target| Pointer::new(target).unwrap();
        for left in boxes {
            for right in boxes {
                let targets = [Target::Leaf(MAX_INDEX as u32), Target::Inner(7)];
                let node = CompactNode::encode(&[left, right], targets.map(pointer));
                assert_eq!(node.children().map(Pointer::target), targets);
                let parent = left.union(&right);
                assert_eq!(node.child_bounds(&parent), [left, right]);
            }
        }
    }

    #[test]
    fn an_index_beyond_28_bits_is_a_typed_error() {
        for target in [Target::Leaf(1 << 28), Target::Inner(1 << 28)] {
            let error = BuildError::OffsetOverflow {
                needed: 1 << 28,
                limit: (1 << 28) - 1,
            };
            assert_eq!(Pointer::new(target), Err(error));
        }
    }
}
