//! The codec of nodes: the uncompressed layout of Lin 2019, section 5. This is
//! the only file that knows bits.
//!
//! An inner node takes 13 words of 4 bytes: for each axis the low planes of the
//! left and the right child, then their high planes, and at the end where the
//! children are. A leaf takes one word: the number of its leaf in the storage.
//! Siblings are adjacent; whether they are leaves stands in their parent, so that
//! a node's kind is known before it is read.

use accel_core::Aabb;
use accel_core::glam::Vec3;

/// Bytes of an inner node.
pub const INNER_NODE_BYTES: usize = INNER_WORDS * 4;

/// Bytes of a leaf node.
pub const LEAF_NODE_BYTES: usize = LEAF_WORDS * 4;

pub(crate) const INNER_WORDS: usize = 13;
pub(crate) const LEAF_WORDS: usize = 1;

const _: () = assert!(INNER_NODE_BYTES == 52 && LEAF_NODE_BYTES == 4);

const CHILDREN_WORD: usize = 12;
const LEFT_IS_LEAF: u32 = 1 << 30;
const RIGHT_IS_LEAF: u32 = 1 << 31;
const OFFSET_MASK: u32 = LEFT_IS_LEAF - 1;

/// The largest word offset that a node can hold.
pub(crate) const MAX_OFFSET: usize = OFFSET_MASK as usize;

/// Where a node is, and what kind it is, in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NodePointer(u32);

const IS_LEAF: u32 = 1 << 31;

/// A [`NodePointer`] taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Node {
    /// An inner node at this word.
    Inner(u32),
    /// A leaf at this word.
    Leaf(u32),
}

impl NodePointer {
    #[inline]
    pub(crate) fn new(offset: u32, is_leaf: bool) -> Self {
        Self(offset | (u32::from(is_leaf) * IS_LEAF))
    }

    #[inline]
    pub(crate) fn kind(self) -> Node {
        let offset = self.0 & !IS_LEAF;
        if self.0 & IS_LEAF != 0 {
            Node::Leaf(offset)
        } else {
            Node::Inner(offset)
        }
    }
}

/// A pair of adjacent siblings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Siblings {
    /// The word at which the left one starts.
    pub offset: u32,
    /// Which of them are leaves.
    pub are_leaves: [bool; 2],
}

impl Siblings {
    /// Left and right.
    #[inline]
    pub(crate) fn pointers(self) -> [NodePointer; 2] {
        let [left, right] = self.are_leaves;
        let left_words = if left { LEAF_WORDS } else { INNER_WORDS } as u32;
        [
            NodePointer::new(self.offset, left),
            NodePointer::new(self.offset + left_words, right),
        ]
    }

    /// Words that both take together.
    pub(crate) fn words(self) -> usize {
        let words = |is_leaf| if is_leaf { LEAF_WORDS } else { INNER_WORDS };
        self.are_leaves.into_iter().map(words).sum()
    }

    fn encode(self) -> u32 {
        let [left, right] = self.are_leaves;
        debug_assert!(self.offset as usize <= MAX_OFFSET);
        self.offset | if left { LEFT_IS_LEAF } else { 0 } | if right { RIGHT_IS_LEAF } else { 0 }
    }

    #[inline]
    fn decode(word: u32) -> Self {
        Self {
            offset: word & OFFSET_MASK,
            are_leaves: [word & LEFT_IS_LEAF != 0, word & RIGHT_IS_LEAF != 0],
        }
    }
}

/// An inner node as it lies in memory.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InnerNode<'a>(pub &'a [u32; INNER_WORDS]);

impl InnerNode<'_> {
    /// The words of a node.
    pub(crate) fn encode(bounds: &[Aabb; 2], children: Siblings) -> [u32; INNER_WORDS] {
        let mut words = [0; INNER_WORDS];
        for axis in 0..3 {
            for side in 0..2 {
                words[plane_word(axis, false) + side] = bounds[side].min[axis].to_bits();
                words[plane_word(axis, true) + side] = bounds[side].max[axis].to_bits();
            }
        }
        words[CHILDREN_WORD] = children.encode();
        words
    }

    /// The planes of both children, left and right, on one side of one axis.
    #[inline]
    pub(crate) fn planes(&self, axis: usize, high: bool) -> [f32; 2] {
        let word = plane_word(axis, high);
        [
            f32::from_bits(self.0[word]),
            f32::from_bits(self.0[word + 1]),
        ]
    }

    #[inline]
    pub(crate) fn children(&self) -> Siblings {
        Siblings::decode(self.0[CHILDREN_WORD])
    }

    /// The boxes of both children.
    pub(crate) fn bounds(&self) -> [Aabb; 2] {
        [0, 1].map(|side| {
            let corner = |high| Vec3::from([0, 1, 2].map(|axis| self.planes(axis, high)[side]));
            Aabb {
                min: corner(false),
                max: corner(true),
            }
        })
    }
}

#[inline]
const fn plane_word(axis: usize, high: bool) -> usize {
    axis * 4 + 2 * high as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_survive_encoding() {
        let bounds = [
            Aabb::new([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]),
            Aabb::new([-1.0, -2.0, -3.0], [-0.5, f32::MAX, 1e-45]),
        ];
        for are_leaves in [[false, false], [true, false], [false, true], [true, true]] {
            for offset in [0, 14, MAX_OFFSET as u32] {
                let children = Siblings { offset, are_leaves };
                let words = InnerNode::encode(&bounds, children);
                let node = InnerNode(&words);
                assert_eq!((node.bounds(), node.children()), (bounds, children));
            }
        }
    }

    #[test]
    fn siblings_are_adjacent() {
        let siblings = Siblings {
            offset: 100,
            are_leaves: [true, false],
        };
        assert_eq!(
            siblings.pointers(),
            [NodePointer::new(100, true), NodePointer::new(101, false)]
        );
        assert_eq!(siblings.words(), 14);
        assert_eq!(
            siblings.pointers().map(NodePointer::kind),
            [Node::Leaf(100), Node::Inner(101)]
        );
    }
}
