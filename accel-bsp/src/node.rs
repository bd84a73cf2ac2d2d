//! The codec of nodes: 20 bytes each (Ize 2008, section 4.4). This is the only
//! file that knows bits.
//!
//! Three words of the normal, one of the offset, and one of the kind (2 bits of
//! the axis, 3 for a general plane; 1 bit for a leaf) and an index of 29 bits: of
//! the first of two adjacent children, back then front, or of a leaf in the
//! storage. An axis-aligned node keeps its slack in the normal's first word. A
//! leaf of one primitive keeps there the plane of that primitive, or the depth of
//! the node that splits by it (section 4.3).

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
const IS_LEAF: u32 = 1 << 2;
const INDEX_SHIFT: u32 = 3;
const NO_LEAF: u32 = u32::MAX >> INDEX_SHIFT;

/// The largest index that a node can hold.
pub(crate) const MAX_INDEX: usize = NO_LEAF as usize - 1;

/// A node as it lies in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Node {
    normal: [f32; 3],
    offset: f32,
    word: u32,
}

/// A [`Node`] taken apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NodeKind {
    /// Split by a plane orthogonal to an axis: the fast path.
    AxisAligned {
        axis: Axis,
        position: f32,
        slack: f32,
        children: u32,
    },
    /// Split by a plane of any orientation, its slack 1.
    General {
        normal: Vec3,
        offset: f32,
        children: u32,
    },
    /// Holds nothing.
    Empty,
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
    pub(crate) fn inner(plane: &SplitPlane, children: u32) -> Self {
        debug_assert!(children as usize <= MAX_INDEX);
        let (normal, offset, slack) = plane.stored();
        let index = children << INDEX_SHIFT;
        match plane.axis() {
            Some(axis) => Self {
                normal: [slack, 0.0, 0.0],
                offset,
                word: index | axis.index() as u32,
            },
            None => Self {
                normal: normal.to_array(),
                offset,
                word: index | GENERAL,
            },
        }
    }

    pub(crate) fn empty() -> Self {
        Self::leaf_word(NO_LEAF)
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
            word: leaf << INDEX_SHIFT | IS_LEAF,
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
        self.word & IS_LEAF != 0
    }

    /// Whether the plane of an inner node is not orthogonal to an axis.
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

    /// The first child of an inner node, or the number of a leaf.
    #[inline]
    pub(crate) fn index(&self) -> u32 {
        self.word >> INDEX_SHIFT
    }

    /// The first of the two children of an inner node.
    pub(crate) fn children(&self) -> Option<u32> {
        (self.word & IS_LEAF == 0).then_some(self.word >> INDEX_SHIFT)
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

    /// The number of a leaf that is not empty.
    pub(crate) fn leaf_number(&self) -> Option<u32> {
        let leaf = self.word >> INDEX_SHIFT;
        (self.word & IS_LEAF != 0 && leaf != NO_LEAF).then_some(leaf)
    }

    /// This leaf, with another number.
    pub(crate) fn with_leaf_number(self, leaf: u32) -> Self {
        let low_bits = self.word & !(NO_LEAF << INDEX_SHIFT);
        Self {
            word: leaf << INDEX_SHIFT | low_bits,
            ..self
        }
    }

    #[inline]
    pub(crate) fn kind(&self) -> NodeKind {
        let index = self.word >> INDEX_SHIFT;
        let (normal, offset) = (Vec3::from_array(self.normal), self.offset);
        if self.word & IS_LEAF != 0 {
            return match (index, self.word & GENERAL) {
                (NO_LEAF, _) => NodeKind::Empty,
                (leaf, GENERAL) => NodeKind::PlanarLeaf {
                    normal,
                    offset,
                    leaf,
                },
                (leaf, BOUNDED) => NodeKind::BoundedLeaf {
                    depth: self.normal[0].to_bits(),
                    leaf,
                },
                (leaf, _) => NodeKind::Leaf(leaf),
            };
        }
        let axis = match self.word & GENERAL {
            0 => Axis::X,
            1 => Axis::Y,
            2 => Axis::Z,
            _ => {
                return NodeKind::General {
                    normal,
                    offset,
                    children: index,
                };
            }
        };
        NodeKind::AxisAligned {
            axis,
            position: offset,
            slack: normal.x,
            children: index,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use accel_core::geometry::Plane;

    #[test]
    fn nodes_survive_encoding() {
        for children in [0, 7, MAX_INDEX as u32] {
            for axis in Axis::ALL {
                let plane = SplitPlane::axis_aligned(axis, -2.5, 0.5);
                let expected = NodeKind::AxisAligned {
                    axis,
                    position: -2.5,
                    slack: 0.5,
                    children,
                };
                assert_eq!(Node::inner(&plane, children).kind(), expected);
            }
            let point = Vec3::new(4.0, 0.0, 0.0);
            let plane = SplitPlane::general(&Plane::through(point, Vec3::X), point, 0.5).unwrap();
            let (normal, offset) = (Vec3::X * 2.0, 8.0);
            let expected = NodeKind::General {
                normal,
                offset,
                children,
            };
            assert_eq!(Node::inner(&plane, children).kind(), expected);
            assert_eq!(Node::leaf(children).kind(), NodeKind::Leaf(children));
            let leaf = children;
            let expected = NodeKind::PlanarLeaf {
                normal,
                offset,
                leaf,
            };
            assert_eq!(Node::planar_leaf(leaf, &plane).kind(), expected);
            let (depth, bounded) = (19, Node::bounded_leaf(leaf, 19));
            assert_eq!(bounded.kind(), NodeKind::BoundedLeaf { depth, leaf });
            assert_eq!(Node::inner(&plane, children).plane(), Some(plane));
        }
        assert_eq!(Node::empty().kind(), NodeKind::Empty);
    }
}
