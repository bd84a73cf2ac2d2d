//! The codec of nodes: 20 bytes each (Ize 2008, section 4.4). This is the only
//! file that knows bits.
//!
//! Three words of the normal, one of the offset, and one of the kind: 2 bits of the
//! axis, 3 for a general plane; 2 bits that tell whether there is a child behind the
//! plane and one in front of it, none for a leaf; and an index of 28 bits: of the
//! child behind the plane, the one in front being the next, or of a leaf in the
//! storage. A part of a cell that holds nothing has no node.
//!
//! An axis-aligned node keeps its slack in the normal's first word. A leaf of one
//! primitive keeps there the plane of that primitive, or the depth of the node that
//! splits by it (section 4.3).

use accel_core::geometry::Axis;
use accel_core::glam::{Vec3, Vec4};

use crate::split_plane::SplitPlane;

/// Bytes of a node.
pub const NODE_BYTES: usize = size_of::<Node>();

/// Words of 4 bytes of a node.
pub(crate) const NODE_WORDS: usize = NODE_BYTES / 4;

const _: () = assert!(NODE_BYTES == 20);

const GENERAL: u32 = 3;
/// Among the kinds of leaves: one whose normal's first word is a depth.
const BOUNDED: u32 = 1;
/// From here on, a bit for each child that there is.
const CHILDREN_SHIFT: u32 = 2;
const CHILDREN: u32 = 0b11 << CHILDREN_SHIFT;
const INDEX_SHIFT: u32 = 4;

/// The largest index that a node can hold.
pub(crate) const MAX_INDEX: usize = (u32::MAX >> INDEX_SHIFT) as usize;

/// A node as it lies in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Node {
    normal: [f32; 3],
    offset: f32,
    word: u32,
}

/// The children of an inner node, behind its plane and in front of it; `None` for a
/// part that holds nothing.
pub(crate) type Children = [Option<u32>; 2];

/// A [`Node`] taken apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NodeKind {
    /// Split by a plane orthogonal to an axis: the fast path.
    AxisAligned {
        axis: Axis,
        position: f32,
        slack: f32,
        children: Children,
    },
    /// Split by a plane of any orientation, its slack 1.
    General {
        normal: Vec3,
        offset: f32,
        children: Children,
    },
    /// Holds primitives.
    Leaf(u32),
    /// Holds one primitive, which lies within 1 of this plane.
    PlanarLeaf {
        normal: Vec3,
        offset: f32,
        leaf: u32,
    },
    /// Holds one primitive, which covers the face of the cell that the node at
    /// this depth above has cut.
    BoundedLeaf { depth: u32, leaf: u32 },
}

impl Node {
    /// An inner node with its first child at `first`, never 0, and the other next to
    /// it; at least one must be there.
    pub(crate) fn inner(plane: &SplitPlane, first: u32, is_there: [bool; 2]) -> Self {
        debug_assert!((1..=MAX_INDEX).contains(&(first as usize)) && is_there != [false; 2]);
        let [behind, in_front] = is_there.map(u32::from);
        let children = (behind | in_front << 1) << CHILDREN_SHIFT;
        let word = (first + behind - 1) << INDEX_SHIFT | children;
        let (normal, offset, slack) = plane.stored();
        match plane.axis() {
            Some(axis) => Self {
                normal: [slack, 0.0, 0.0],
                offset,
                word: word | axis.index() as u32,
            },
            None => Self {
                normal: normal.to_array(),
                offset,
                word: word | GENERAL,
            },
        }
    }

    pub(crate) fn leaf(leaf: u32) -> Self {
        debug_assert!(leaf as usize <= MAX_INDEX);
        Self::leaf_word(leaf)
    }

    /// A leaf of one primitive within the slack of a general plane.
    pub(crate) fn planar_leaf(leaf: u32, plane: &SplitPlane) -> Self {
        debug_assert!(plane.axis().is_none());
        let (normal, offset, _) = plane.stored();
        Self {
            normal: normal.to_array(),
            offset,
            word: Self::leaf(leaf).word | GENERAL,
        }
    }

    /// A leaf of one primitive that covers the face which the node at `depth` has
    /// cut.
    pub(crate) fn bounded_leaf(leaf: u32, depth: u32) -> Self {
        let plain = Self::leaf(leaf);
        Self {
            normal: [f32::from_bits(depth), 0.0, 0.0],
            word: plain.word | BOUNDED,
            ..plain
        }
    }

    fn leaf_word(leaf: u32) -> Self {
        Self {
            normal: [0.0; 3],
            offset: 0.0,
            word: leaf << INDEX_SHIFT,
        }
    }

    /// The node as words; [`from_words`](Self::from_words) reads them.
    pub(crate) fn to_words(self) -> [u32; NODE_WORDS] {
        let [x, y, z] = self.normal.map(f32::to_bits);
        [x, y, z, self.offset.to_bits(), self.word]
    }

    pub(crate) fn from_words([x, y, z, offset, word]: [u32; NODE_WORDS]) -> Self {
        Self {
            normal: [x, y, z].map(f32::from_bits),
            offset: f32::from_bits(offset),
            word,
        }
    }

    pub(crate) fn is_finite(&self) -> bool {
        self.offset.is_finite() && self.normal.iter().all(|x| x.is_finite())
    }

    #[inline]
    pub(crate) fn is_leaf(&self) -> bool {
        self.word & CHILDREN == 0
    }

    /// Whether the plane of an inner node is not orthogonal to an axis, or a leaf has
    /// one.
    #[inline]
    pub(crate) fn is_general(&self) -> bool {
        self.word & GENERAL == GENERAL
    }

    /// The number of an axis-aligned node's axis: at most 3, so that tables of four
    /// need no check.
    #[inline]
    pub(crate) fn axis_index(&self) -> usize {
        (self.word & GENERAL) as usize
    }

    /// Of an axis-aligned node.
    #[inline]
    pub(crate) fn position_and_slack(&self) -> (f32, f32) {
        (self.offset, self.normal[0])
    }

    /// The normal and the offset of a general node or a planar leaf.
    #[inline]
    pub(crate) fn plane_words(&self) -> Vec4 {
        Vec3::from_array(self.normal).extend(self.offset)
    }

    /// The child of an inner node on a side, 0 behind its plane and 1 in front of it.
    #[inline]
    pub(crate) fn child(&self, side: u32) -> Option<u32> {
        let is_there = self.word >> (CHILDREN_SHIFT + side) & 1 != 0;
        is_there.then(|| (self.word >> INDEX_SHIFT) + side)
    }

    /// Both children; none of a leaf.
    pub(crate) fn children(&self) -> Children {
        [self.child(0), self.child(1)]
    }

    /// The plane of an inner node.
    pub(crate) fn plane(&self) -> Option<SplitPlane> {
        match self.kind() {
            NodeKind::AxisAligned {
                axis,
                position,
                slack,
                ..
            } => {
                let normal = axis.unit();
                Some(SplitPlane::from_stored(Some(axis), normal, position, slack))
            }
            NodeKind::General { normal, offset, .. } => {
                Some(SplitPlane::from_stored(None, normal, offset, 1.0))
            }
            _ => None,
        }
    }

    /// The number of a leaf.
    pub(crate) fn leaf_number(&self) -> Option<u32> {
        self.is_leaf().then_some(self.word >> INDEX_SHIFT)
    }

    /// This leaf, with another number.
    pub(crate) fn with_leaf_number(self, leaf: u32) -> Self {
        let low_bits = self.word & !(u32::MAX << INDEX_SHIFT);
        Self {
            word: leaf << INDEX_SHIFT | low_bits,
            ..self
        }
    }

    #[inline]
    pub(crate) fn kind(&self) -> NodeKind {
        let index = self.word >> INDEX_SHIFT;
        let (normal, offset) = (Vec3::from_array(self.normal), self.offset);
        if self.is_leaf() {
            return match self.word & GENERAL {
                GENERAL => NodeKind::PlanarLeaf {
                    normal,
                    offset,
                    leaf: index,
                },
                BOUNDED => NodeKind::BoundedLeaf {
                    depth: self.normal[0].to_bits(),
                    leaf: index,
                },
                _ => NodeKind::Leaf(index),
            };
        }
        let children = self.children();
        let axis = match self.word & GENERAL {
            0 => Axis::X,
            1 => Axis::Y,
            2 => Axis::Z,
            _ => {
                return NodeKind::General {
                    normal,
                    offset,
                    children,
                };
            }
        };
        NodeKind::AxisAligned {
            axis,
            position: offset,
            slack: normal.x,
            children,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use accel_core::geometry::Plane;

    #[test]
    fn nodes_survive_encoding() {
        for first in [1, 7, MAX_INDEX as u32 - 1] {
            for (is_there, children) in [
                ([true, true], [Some(first), Some(first + 1)]),
                ([true, false], [Some(first), None]),
                ([false, true], [None, Some(first)]),
            ] {
                for axis in Axis::ALL {
                    let plane = SplitPlane::axis_aligned(axis, -2.5, 0.5);
                    let expected = NodeKind::AxisAligned {
                        axis,
                        position: -2.5,
                        slack: 0.5,
                        children,
                    };
                    let node = Node::inner(&plane, first, is_there);
                    assert_eq!((node.kind(), node.plane()), (expected, Some(plane)));
                }
                let plane = sloping();
                let expected = NodeKind::General {
                    normal: Vec3::X * 2.0,
                    offset: 8.0,
                    children,
                };
                let node = Node::inner(&plane, first, is_there);
                assert_eq!((node.kind(), node.plane()), (expected, Some(plane)));
            }
        }
    }

    #[test]
    fn leaves_survive_encoding() {
        for leaf in [0, 7, MAX_INDEX as u32] {
            assert_eq!(Node::leaf(leaf).kind(), NodeKind::Leaf(leaf));
            let expected = NodeKind::PlanarLeaf {
                normal: Vec3::X * 2.0,
                offset: 8.0,
                leaf,
            };
            assert_eq!(Node::planar_leaf(leaf, &sloping()).kind(), expected);
            let (depth, bounded) = (19, Node::bounded_leaf(leaf, 19));
            assert_eq!(bounded.kind(), NodeKind::BoundedLeaf { depth, leaf });
            assert_eq!(bounded.children(), [None; 2]);
        }
    }

    /// A plane through (4, 0, 0), its slack 0.5, stored as a general one.
    fn sloping() -> SplitPlane {
        let point = Vec3::new(4.0, 0.0, 0.0);
        SplitPlane::general(&Plane::through(point, Vec3::X), point, 0.5).unwrap()
    }
}
