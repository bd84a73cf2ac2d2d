//! The codec of nodes: 8 bytes each. This is the only file that knows bits.
//!
//! One word holds the axis (2 bits), whether the node is a leaf (1 bit), and an
//! index (29 bits): of the first of two adjacent children, below then above, or
//! of a leaf in the storage. The other word is the position of the plane.

use accel_core::geometry::Axis;

/// Bytes of a node.
pub const NODE_BYTES: usize = size_of::<Node>();

const _: () = assert!(NODE_BYTES == 8);

const AXIS_MASK: u32 = 0b11;
const IS_LEAF: u32 = 1 << 2;
const INDEX_SHIFT: u32 = 3;
const NO_LEAF: u32 = u32::MAX >> INDEX_SHIFT;

/// The largest index that a node can hold.
pub(crate) const MAX_INDEX: usize = NO_LEAF as usize - 1;

/// A node as it lies in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(8))]
pub(crate) struct Node {
    word: u32,
    position: f32,
}

/// A leaf taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Leaf {
    /// Holds nothing.
    Empty,
    /// Holds the primitives of this leaf of the storage.
    Of(u32),
}

/// A [`Node`] taken apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NodeKind {
    /// Split by the plane at `position`; the child below it is `children`, the
    /// one above it the next.
    Inner {
        axis: Axis,
        position: f32,
        children: u32,
    },
    Leaf(Leaf),
}

impl Node {
    pub(crate) fn inner(axis: Axis, position: f32, children: u32) -> Self {
        debug_assert!(children as usize <= MAX_INDEX);
        Self {
            word: children << INDEX_SHIFT | axis.index() as u32,
            position,
        }
    }

    pub(crate) fn leaf(leaf: Leaf) -> Self {
        let index = match leaf {
            Leaf::Empty => NO_LEAF,
            Leaf::Of(index) => {
                debug_assert!(index as usize <= MAX_INDEX);
                index
            }
        };
        Self {
            word: index << INDEX_SHIFT | IS_LEAF,
            position: 0.0,
        }
    }

    /// The leaf that this node is, if it is one.
    #[inline]
    pub(crate) fn as_leaf(self) -> Option<Leaf> {
        if self.word & IS_LEAF == 0 {
            return None;
        }
        Some(match self.index() {
            NO_LEAF => Leaf::Empty,
            index => Leaf::Of(index),
        })
    }

    /// The axis' number, at most 3, so that tables of four need no check.
    #[inline]
    pub(crate) fn axis_index(self) -> usize {
        (self.word & AXIS_MASK) as usize
    }

    /// Where the plane of an inner node lies.
    #[inline]
    pub(crate) fn position(self) -> f32 {
        self.position
    }

    /// The first child of an inner node.
    #[inline]
    pub(crate) fn index(self) -> u32 {
        self.word >> INDEX_SHIFT
    }

    pub(crate) fn kind(self) -> NodeKind {
        match self.as_leaf() {
            Some(leaf) => NodeKind::Leaf(leaf),
            None => NodeKind::Inner {
                axis: Axis::ALL[self.axis_index()],
                position: self.position,
                children: self.index(),
            },
        }
    }

    /// The node as words.
    pub(crate) fn words(self) -> [u32; 2] {
        [self.word, self.position.to_bits()]
    }

    /// The node of these words; `None` where they mean none.
    pub(crate) fn from_words([word, position]: [u32; 2]) -> Option<Self> {
        let position = f32::from_bits(position);
        let node = Self { word, position };
        let is_inner = node.axis_index() < Axis::ALL.len() && position.is_finite();
        match node.as_leaf() {
            Some(leaf) => (node.words() == Self::leaf(leaf).words()).then_some(node),
            None => is_inner.then_some(node),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_survives_coding_up_to_its_limit() {
        for axis in Axis::ALL {
            for children in [0, 1, MAX_INDEX as u32] {
                let node = Node::inner(axis, -2.5, children);
                let kind = NodeKind::Inner {
                    axis,
                    position: -2.5,
                    children,
                };
                assert_eq!(node.kind(), kind);
                assert_eq!((node.axis_index(), node.position()), (axis.index(), -2.5));
                assert_eq!(Node::from_words(node.words()), Some(node));
            }
        }
        for leaf in [Leaf::Empty, Leaf::Of(0), Leaf::Of(MAX_INDEX as u32)] {
            let node = Node::leaf(leaf);
            assert_eq!(node.kind(), NodeKind::Leaf(leaf));
            assert_eq!(Node::from_words(node.words()), Some(node));
        }
        let inner = Node::inner(Axis::X, 1.0, 0).words()[0];
        let no_axis = inner | AXIS_MASK;
        let spare_bits = Node::leaf(Leaf::Empty).words()[0] | AXIS_MASK;
        for (word, position) in [(no_axis, 1.0), (inner, f32::INFINITY), (spare_bits, 0.0)] {
            assert_eq!(Node::from_words([word, position.to_bits()]), None);
        }
        assert_eq!(MAX_INDEX, (1 << 29) - 2);
    }
}
