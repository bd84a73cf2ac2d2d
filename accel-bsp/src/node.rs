//! The codec of nodes: 8 bytes each, as in a kd-tree, and the planes that are not
//! axis-aligned apart, 16 bytes each (Ize 2008, section 4.4, has 20 bytes for every
//! node). This is the only file that knows bits.
//!
//! One word holds the kind: 2 bits of the axis, 3 for a general plane; for an
//! axis-aligned one 1 bit of the class of its slack; 2 bits that tell whether there is
//! a child behind the plane and one in front of it, none for a leaf; and an index of 27
//! bits: of the child behind the plane, the one in front being the next, or of a leaf in
//! the storage. A part of a cell that holds nothing has no node.
//!
//! The other word is the position of an axis-aligned plane; or the number of a general
//! one, or of the plane of a leaf's only primitive; or the depth of the node that
//! splits by that primitive (section 4.3).

use accel_core::geometry::Axis;

/// Bytes of a node, without its plane if that is not orthogonal to an axis.
pub const NODE_BYTES: usize = size_of::<Node>();

const _: () = assert!(NODE_BYTES == 8);

const KIND: u32 = 0b11;
const GENERAL: u32 = 3;
/// Among the kinds of leaves: one whose other word is a depth.
const BOUNDED: u32 = 1;
const LARGE_SLACK: u32 = 1 << 2;
/// Of axis and class: what a ray looks up.
const AXIS_AND_CLASS: u32 = KIND | LARGE_SLACK;
/// From here on, a bit for each child that there is.
const CHILDREN_SHIFT: u32 = 3;
const CHILDREN: u32 = 0b11 << CHILDREN_SHIFT;
const INDEX_SHIFT: u32 = 5;
const BELOW_INDEX: u32 = (1 << INDEX_SHIFT) - 1;

/// The largest index that a node can hold.
pub(crate) const MAX_INDEX: usize = (u32::MAX >> INDEX_SHIFT) as usize;

/// How many values [`Node::axis_and_class`] has.
pub(crate) const AXES_AND_CLASSES: usize = AXIS_AND_CLASS as usize + 1;

/// A node as it lies in memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(8))]
pub(crate) struct Node {
    word: u32,
    data: u32,
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
        slack: SlackClass,
        children: Children,
    },
    /// Split by the plane of this number.
    General { plane: u32, children: Children },
    /// Holds primitives.
    Leaf(u32),
    /// Holds one primitive, which lies within the slack of the plane of this number.
    PlanarLeaf { plane: u32, leaf: u32 },
    /// Holds one primitive, which covers the face of the cell that the node at
    /// this depth above has cut.
    BoundedLeaf { depth: u32, leaf: u32 },
}

/// Which of the two slacks that axis-aligned planes share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SlackClass {
    Small,
    Large,
}

/// Where an inner node splits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NodePlane {
    AxisAligned {
        axis: Axis,
        position: f32,
        slack: SlackClass,
    },
    /// The number of a plane.
    General(u32),
}

impl Node {
    /// An inner node with its first child at `first`, never 0, and the other next to
    /// it; at least one must be there.
    pub(crate) fn inner(plane: NodePlane, first: u32, is_there: [bool; 2]) -> Self {
        debug_assert!((1..=MAX_INDEX).contains(&(first as usize)) && is_there != [false; 2]);
        let [behind, in_front] = is_there.map(u32::from);
        let children = (behind | in_front << 1) << CHILDREN_SHIFT;
        let (kind, data) = match plane {
            NodePlane::AxisAligned {
                axis,
                position,
                slack,
            } => {
                let class = u32::from(slack == SlackClass::Large) * LARGE_SLACK;
                (axis.index() as u32 | class, position.to_bits())
            }
            NodePlane::General(number) => (GENERAL, number),
        };
        let word = (first + behind - 1) << INDEX_SHIFT | children | kind;
        Self { word, data }
    }

    pub(crate) fn leaf(leaf: u32) -> Self {
        Self::leaf_of(0, leaf, 0)
    }

    /// A leaf of one primitive within the slack of the plane of this number.
    pub(crate) fn planar_leaf(leaf: u32, plane: u32) -> Self {
        Self::leaf_of(GENERAL, leaf, plane)
    }

    /// A leaf of one primitive that covers the face which the node at `depth` has
    /// cut.
    pub(crate) fn bounded_leaf(leaf: u32, depth: u32) -> Self {
        Self::leaf_of(BOUNDED, leaf, depth)
    }

    fn leaf_of(kind: u32, leaf: u32, data: u32) -> Self {
        debug_assert!(leaf as usize <= MAX_INDEX);
        let word = leaf << INDEX_SHIFT | kind;
        Self { word, data }
    }

    /// The node as words; [`from_words`](Self::from_words) reads them.
    pub(crate) fn to_words(self) -> [u32; 2] {
        [self.word, self.data]
    }

    pub(crate) fn from_words([word, data]: [u32; 2]) -> Self {
        Self { word, data }
    }

    #[inline]
    pub(crate) fn is_leaf(&self) -> bool {
        self.word & CHILDREN == 0
    }

    /// Whether the plane of an inner node is not orthogonal to an axis, or a leaf has
    /// one.
    #[inline]
    pub(crate) fn is_general(&self) -> bool {
        self.word & KIND == GENERAL
    }

    /// Of an axis-aligned node, what tells the axis and the class of its slack: less
    /// than [`AXES_AND_CLASSES`], so that tables of so many need no check. The axis'
    /// number is its remainder by 4.
    #[inline]
    pub(crate) fn axis_and_class(&self) -> usize {
        (self.word & AXIS_AND_CLASS) as usize
    }

    /// Of an axis-aligned node.
    #[inline]
    pub(crate) fn position(&self) -> f32 {
        f32::from_bits(self.data)
    }

    /// The number of the plane of a general node or a planar leaf.
    #[inline]
    pub(crate) fn plane_number(&self) -> u32 {
        self.data
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

    /// The number of a leaf.
    pub(crate) fn leaf_number(&self) -> Option<u32> {
        self.is_leaf().then_some(self.word >> INDEX_SHIFT)
    }

    /// This leaf, with another number.
    pub(crate) fn with_leaf_number(self, leaf: u32) -> Self {
        debug_assert!(leaf as usize <= MAX_INDEX);
        let word = leaf << INDEX_SHIFT | self.word & BELOW_INDEX;
        Self { word, ..self }
    }

    #[inline]
    pub(crate) fn kind(&self) -> NodeKind {
        let Self { word, data } = *self;
        if self.is_leaf() {
            let leaf = word >> INDEX_SHIFT;
            return match word & KIND {
                GENERAL => NodeKind::PlanarLeaf { plane: data, leaf },
                BOUNDED => NodeKind::BoundedLeaf { depth: data, leaf },
                _ => NodeKind::Leaf(leaf),
            };
        }
        let children = self.children();
        let axis = match word & KIND {
            0 => Axis::X,
            1 => Axis::Y,
            2 => Axis::Z,
            _ => {
                let plane = data;
                return NodeKind::General { plane, children };
            }
        };
        NodeKind::AxisAligned {
            axis,
            position: self.position(),
            slack: if word & LARGE_SLACK == 0 {
                SlackClass::Small
            } else {
                SlackClass::Large
            },
            children,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inner_nodes_survive_encoding() {
        for first in [1, 7, MAX_INDEX as u32 - 1] {
            for (is_there, children) in [
                ([true, true], [Some(first), Some(first + 1)]),
                ([true, false], [Some(first), None]),
                ([false, true], [None, Some(first)]),
            ] {
                for axis in Axis::ALL {
                    for slack in [SlackClass::Small, SlackClass::Large] {
                        let position = -2.5;
                        let plane = NodePlane::AxisAligned {
                            axis,
                            position,
                            slack,
                        };
                        let expected = NodeKind::AxisAligned {
                            axis,
                            position,
                            slack,
                            children,
                        };
                        let node = Node::inner(plane, first, is_there);
                        assert_eq!(node.kind(), expected);
                        assert_eq!(node.axis_and_class() % 4, axis.index());
                        assert_eq!(node.axis_and_class() / 4, slack as usize);
                    }
                }
                let node = Node::inner(NodePlane::General(u32::MAX), first, is_there);
                let plane = u32::MAX;
                assert_eq!(node.kind(), NodeKind::General { plane, children });
            }
        }
    }

    #[test]
    fn leaves_survive_encoding() {
        for leaf in [0, 7, MAX_INDEX as u32] {
            assert_eq!(Node::leaf(leaf).kind(), NodeKind::Leaf(leaf));
            let expected = NodeKind::PlanarLeaf { plane: 12, leaf };
            assert_eq!(Node::planar_leaf(leaf, 12).kind(), expected);
            let (depth, bounded) = (19, Node::bounded_leaf(leaf, 19));
            assert_eq!(bounded.kind(), NodeKind::BoundedLeaf { depth, leaf });
            assert_eq!(bounded.children(), [None; 2]);
            assert_eq!(bounded.with_leaf_number(3).leaf_number(), Some(3));
        }
    }
}
