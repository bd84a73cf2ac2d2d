//! The codec of nodes (Lin 2019, section 4.1). This is the only file that knows
//! bits.
//!
//! A node's first word holds a header in its upper 6 bits and an offset in its
//! lower 26. A leaf without carving planes is this word alone; every other node
//! is followed by two planes in single precision. The offset of an inner node
//! leads from the node to its first child, in words; that of a leaf is the
//! number of the leaf in the storage: the index of its first reference.
//!
//! The paper's Figure 6 is a drawing; these are our 37 codes, `a` an axis (00 x,
//! 01 y, 10 z), `p` a pair of axes (00 xy, 01 xz, 11 yz), `l` whether the node is
//! a leaf, `s` the words of the first child, `c` the corner:
//!
//! | bits | node | first plane | second plane | codes |
//! |---|---|---|---|---|
//! | `0 0 aa ss` | splitting, ss = 01 or 11 | high bound of the first child | low bound of the second | 6 |
//! | `0 l aa 10` | single-axis carving | high bound | low bound | 6 |
//! | `0 1 00 00` | leaf | none | none | 1 |
//! | `1 l pp cc` | dual-axis carving | bound on the first axis | bound on the second | 24 |
//!
//! The upper bit of a corner says that the plane on the first axis is a high
//! bound, the lower bit the same of the second axis.
//!
//! The planes of single-axis carving stand in the order of those of splitting:
//! so a ray leaves through the same one and enters through the same other one in
//! both kinds of node, and the traversal computes both before it knows the kind.

use accel_core::Aabb;
use accel_core::geometry::Axis;

use crate::error::WordsError;

/// Bytes of a node with planes.
pub const NODE_BYTES: usize = NODE_WORDS * 4;

/// Bytes of a leaf without planes.
pub const LEAF_BYTES: usize = LEAF_WORDS * 4;

pub(crate) const NODE_WORDS: usize = 3;
pub(crate) const LEAF_WORDS: usize = 1;

const OFFSET_BITS: u32 = 26;
const OFFSET_MASK: u32 = (1 << OFFSET_BITS) - 1;

/// The largest offset and the largest number of a leaf.
pub(crate) const MAX_OFFSET: usize = OFFSET_MASK as usize;

const DUAL: u32 = 1 << 5;
const LEAF: u32 = 1 << 4;
const SINGLE: u32 = 0b10;
const SPLITTING: u32 = 0b01;
const KIND_MASK: u32 = 0b11;

const _: () = assert!(NODE_BYTES == 12 && LEAF_BYTES == 4);
const _: () = assert!(DUAL << 1 == 1 << (u32::BITS - OFFSET_BITS));

/// One of the six planes of a box: an axis and a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BoxPlane {
    pub axis: Axis,
    pub is_high: bool,
}

impl BoxPlane {
    /// 0 to 5: low x, high x, low y, and so on.
    #[inline]
    pub(crate) fn index(self) -> usize {
        2 * self.axis.index() + usize::from(self.is_high)
    }

    /// What is left of `region` with this plane at `position`.
    pub(crate) fn carve(self, region: Aabb, position: f32) -> Aabb {
        if self.is_high {
            region.with_range(self.axis, f32::NEG_INFINITY, position)
        } else {
            region.with_range(self.axis, position, f32::INFINITY)
        }
    }
}

/// Which planes a carving node holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CarvingPlanes {
    /// High and low on one axis.
    Single(Axis),
    /// One on each of two axes, in order.
    Dual(BoxPlane, BoxPlane),
}

/// A header, taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Header {
    Splitting {
        axis: Axis,
        first_child_words: usize,
    },
    Carving {
        planes: CarvingPlanes,
        is_leaf: bool,
    },
    Leaf,
}

impl Header {
    /// Words that the node takes.
    pub(crate) fn words(self) -> usize {
        match self {
            Self::Leaf => LEAF_WORDS,
            Self::Splitting { .. } | Self::Carving { .. } => NODE_WORDS,
        }
    }

    /// Whether the offset is the number of a leaf.
    pub(crate) fn is_leaf(self) -> bool {
        matches!(self, Self::Leaf | Self::Carving { is_leaf: true, .. })
    }

    /// The first word of a node. The offset must fit.
    pub(crate) fn encode(self, offset: usize) -> u32 {
        debug_assert!(offset <= MAX_OFFSET, "offsets are checked before");
        self.code() << OFFSET_BITS | offset as u32
    }

    fn code(self) -> u32 {
        match self {
            Self::Splitting {
                axis,
                first_child_words,
            } => (axis.index() as u32) << 2 | first_child_words as u32,
            Self::Carving { planes, is_leaf } => {
                let leaf = if is_leaf { LEAF } else { 0 };
                leaf | match planes {
                    CarvingPlanes::Single(axis) => (axis.index() as u32) << 2 | SINGLE,
                    CarvingPlanes::Dual(first, second) => {
                        let axes =
                            (first.axis.index() as u32) << 1 | u32::from(second.axis == Axis::Z);
                        let corner = u32::from(first.is_high) << 1 | u32::from(second.is_high);
                        DUAL | axes << 2 | corner
                    }
                }
            }
            Self::Leaf => LEAF,
        }
    }

    /// Takes a word apart; `None` for one of the 27 codes that mean nothing.
    pub(crate) fn decode(word: FirstWord) -> Option<Self> {
        let code = word.0 >> OFFSET_BITS;
        let middle = (code >> 2) & 0b11;
        let is_leaf = code & LEAF != 0;
        if code & DUAL != 0 {
            let [first, second] = word.dual_planes();
            let planes = CarvingPlanes::Dual(first, second);
            return (middle != 0b10).then_some(Self::Carving { planes, is_leaf });
        }
        let axis = Axis::ALL.get(middle as usize).copied();
        match code & KIND_MASK {
            SINGLE => axis.map(|axis| Self::Carving {
                planes: CarvingPlanes::Single(axis),
                is_leaf,
            }),
            0 => (code == LEAF).then_some(Self::Leaf),
            words if !is_leaf => axis.map(|axis| Self::Splitting {
                axis,
                first_child_words: words as usize,
            }),
            _ => None,
        }
    }
}

/// The first word of a node, as the traversal reads it: each answer takes an
/// instruction or two, and is right for words that were checked.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FirstWord(pub u32);

impl FirstWord {
    #[inline(always)]
    pub(crate) fn is_dual_axis(self) -> bool {
        self.0 & DUAL << OFFSET_BITS != 0
    }

    /// Whether this is a leaf without planes; asked of nodes that are not
    /// dual-axis.
    #[inline(always)]
    pub(crate) fn is_plain_leaf(self) -> bool {
        self.0 & KIND_MASK << OFFSET_BITS == 0
    }

    /// Whether this splits; asked of nodes that are not dual-axis.
    #[inline(always)]
    pub(crate) fn is_splitting(self) -> bool {
        self.0 & SPLITTING << OFFSET_BITS != 0
    }

    /// Whether the offset is the number of a leaf; asked of carving nodes.
    #[inline(always)]
    pub(crate) fn is_leaf(self) -> bool {
        self.0 & LEAF << OFFSET_BITS != 0
    }

    /// The offset, or the number of the leaf.
    #[inline(always)]
    pub(crate) fn offset(self) -> u32 {
        self.0 & OFFSET_MASK
    }

    /// 0 to 2; asked of splitting and single-axis nodes.
    #[inline(always)]
    pub(crate) fn axis_index(self) -> usize {
        (self.0 >> (OFFSET_BITS + 2) & 0b11) as usize
    }

    /// Words of the first child; asked of splitting nodes.
    #[inline(always)]
    pub(crate) fn first_child_words(self) -> u32 {
        self.0 >> OFFSET_BITS & KIND_MASK
    }

    /// [`BoxPlane::index`] of both planes of a dual-axis node.
    #[inline(always)]
    pub(crate) fn dual_plane_indices(self) -> [usize; 2] {
        let code = self.0 >> OFFSET_BITS;
        // Twice the axis, and the side: x or y first, y or z second.
        let first = (code >> 2 & 0b10) | (code >> 1 & 1);
        let second = 2 + (code >> 1 & 0b10) + (code & 1);
        [first as usize, second as usize]
    }

    fn dual_planes(self) -> [BoxPlane; 2] {
        self.dual_plane_indices().map(|index| BoxPlane {
            axis: Axis::ALL[index / 2],
            is_high: index % 2 == 1,
        })
    }
}

/// A node, decoded with checks: for words that may be anything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    pub header: Header,
    /// Of the first child, from the start of the words; or a leaf's number.
    pub target: usize,
    /// Zeros for a leaf without planes.
    pub planes: [f32; 2],
}

impl Node {
    /// Reads the node at `position`.
    ///
    /// # Errors
    /// What is wrong with it: see [`WordsError`].
    pub(crate) fn decode(words: &[u32], position: usize) -> Result<Self, WordsError> {
        let beyond = WordsError::BeyondEnd {
            position,
            words: words.len(),
        };
        let word = FirstWord(*words.get(position).ok_or(beyond.clone())?);
        let code = word.0 >> OFFSET_BITS;
        let header = Header::decode(word).ok_or(WordsError::UnusedCode { position, code })?;
        let own = words
            .get(position..position + header.words())
            .ok_or(beyond)?;
        let planes = match own {
            &[_, first, second] => [first, second].map(f32::from_bits),
            _ => [0.0; 2],
        };
        if planes.iter().any(|plane| plane.is_nan()) {
            return Err(WordsError::NanPlane { position });
        }
        let offset = word.offset() as usize;
        let target = if header.is_leaf() {
            offset
        } else if offset < header.words() {
            return Err(WordsError::NotForward { position, offset });
        } else {
            position + offset
        };
        Ok(Self {
            header,
            target,
            planes,
        })
    }

    /// Where the children of an inner node are: one or two of them.
    pub(crate) fn children(&self) -> impl DoubleEndedIterator<Item = usize> + use<> {
        let second = match self.header {
            Header::Splitting {
                first_child_words, ..
            } => Some(self.target + first_child_words),
            _ => None,
        };
        let first = (!self.header.is_leaf()).then_some(self.target);
        first.into_iter().chain(second)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all_headers() -> Vec<Header> {
        let mut headers = vec![Header::Leaf];
        for axis in Axis::ALL {
            for first_child_words in [LEAF_WORDS, NODE_WORDS] {
                headers.push(Header::Splitting {
                    axis,
                    first_child_words,
                });
            }
        }
        for is_leaf in [false, true] {
            for axis in Axis::ALL {
                let planes = CarvingPlanes::Single(axis);
                headers.push(Header::Carving { planes, is_leaf });
            }
            for [first, second] in [[Axis::X, Axis::Y], [Axis::X, Axis::Z], [Axis::Y, Axis::Z]] {
                for corner in 0..4 {
                    let plane = |axis, is_high| BoxPlane { axis, is_high };
                    let first = plane(first, corner & 2 != 0);
                    let second = plane(second, corner & 1 != 0);
                    let planes = CarvingPlanes::Dual(first, second);
                    headers.push(Header::Carving { planes, is_leaf });
                }
            }
        }
        headers
    }

    #[test]
    fn all_37_headers_survive_encoding_and_no_other_code_is_accepted() {
        let mut codes = Vec::new();
        for header in all_headers() {
            for offset in [0, 3, 4_711, MAX_OFFSET] {
                let word = FirstWord(header.encode(offset));
                assert_eq!(Header::decode(word), Some(header), "{header:?}");
                assert_eq!(word.offset() as usize, offset, "{header:?}");
            }
            codes.push(header.code());
        }
        codes.sort_unstable();
        codes.dedup();
        assert_eq!(codes.len(), 37);
        for code in 0..64 {
            let is_used = Header::decode(FirstWord(code << OFFSET_BITS)).is_some();
            assert_eq!(is_used, codes.contains(&code), "{code:06b}");
        }
    }

    #[test]
    fn the_traversal_s_answers_are_those_of_the_header() {
        for header in all_headers() {
            let word = FirstWord(header.encode(7));
            match header {
                Header::Leaf => assert!(!word.is_dual_axis() && word.is_plain_leaf()),
                Header::Splitting {
                    axis,
                    first_child_words,
                } => {
                    assert!(!word.is_dual_axis() && !word.is_plain_leaf() && word.is_splitting());
                    assert_eq!(word.axis_index(), axis.index());
                    assert_eq!(word.first_child_words() as usize, first_child_words);
                }
                Header::Carving { planes, is_leaf } => {
                    assert_eq!(word.is_leaf(), is_leaf);
                    match planes {
                        CarvingPlanes::Single(axis) => {
                            assert!(!word.is_dual_axis() && !word.is_plain_leaf());
                            assert!(!word.is_splitting());
                            assert_eq!(word.axis_index(), axis.index());
                        }
                        CarvingPlanes::Dual(first, second) => {
                            assert!(word.is_dual_axis());
                            let indices = [first.index(), second.index()];
                            assert_eq!(word.dual_plane_indices(), indices);
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn decoding_refuses_what_no_encoder_writes() {
        let splitting = Header::Splitting {
            axis: Axis::Y,
            first_child_words: 1,
        };
        let plane = 1.0_f32.to_bits();
        let error = |words: &[u32]| Node::decode(words, 0).unwrap_err();
        let forward = splitting.encode(3);
        assert!(Node::decode(&[forward, plane, plane], 0).is_ok());
        assert_eq!(
            error(&[splitting.encode(2), plane, plane]),
            WordsError::NotForward {
                position: 0,
                offset: 2
            }
        );
        assert_eq!(
            error(&[forward, plane]),
            WordsError::BeyondEnd {
                position: 0,
                words: 2
            }
        );
        assert_eq!(
            error(&[forward, plane, f32::NAN.to_bits()]),
            WordsError::NanPlane { position: 0 }
        );
        assert_eq!(
            error(&[0b00_1101 << OFFSET_BITS, plane, plane]),
            WordsError::UnusedCode {
                position: 0,
                code: 0b00_1101
            }
        );
    }
}
