//! The first word of a node, as the traversal reads it.

use accel_core::geometry::Axis;

use super::{
    AXES_MASK, BOUNDING_AXES, BoundedAxes, BoxPlane, KIND_MASK, LEAF, OFFSET_BITS, OFFSET_MASK,
    SEVERAL_AXES, SINGLE, SPLITTING,
};

/// The first word of a node: each answer takes an instruction or two, and is right
/// for words that were checked.
#[derive(Clone, Copy, Debug)]
pub struct FirstWord(pub u32);

impl FirstWord {
    /// Whether this carves, on two axes or three.
    #[inline(always)]
    pub(crate) fn is_on_several_axes(self) -> bool {
        self.0 & SEVERAL_AXES << OFFSET_BITS != 0
    }

    /// Whether this is a leaf without planes; asked of nodes that do not carve on
    /// several axes.
    #[inline(always)]
    pub(crate) fn is_plain_leaf(self) -> bool {
        self.0 & KIND_MASK << OFFSET_BITS == 0
    }

    /// Whether this splits; asked of any node.
    #[inline(always)]
    pub(crate) fn splits(self) -> bool {
        self.0 & (SEVERAL_AXES | SPLITTING) << OFFSET_BITS == SPLITTING << OFFSET_BITS
    }

    /// Whether this carves; asked of any node.
    #[inline(always)]
    pub(crate) fn carves(self) -> bool {
        self.is_on_several_axes() || self.0 & KIND_MASK << OFFSET_BITS == SINGLE << OFFSET_BITS
    }

    /// [`BoxPlane::index`] of the planes that a node carves, in their order; 6 for
    /// no plane, twice for a node that carves none. Asked of nodes that are not
    /// bounding nodes.
    #[inline(always)]
    pub(crate) fn carved_planes(self) -> [usize; 2] {
        CARVED_PLANES[(self.0 >> OFFSET_BITS) as usize].map(usize::from)
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

    /// Words of the first child, 1 to 7; asked of splitting nodes.
    #[inline(always)]
    pub(crate) fn first_child_words(self) -> u32 {
        let code = self.0 >> OFFSET_BITS;
        code & KIND_MASK | code >> 2 & LEAF >> 2
    }

    /// Words of the first child, 1 or 3; asked of splitting nodes without bounding
    /// nodes below.
    #[inline(always)]
    pub(crate) fn small_first_child_words(self) -> u32 {
        self.0 >> OFFSET_BITS & KIND_MASK
    }

    /// [`BoxPlane::index`] of both planes of a dual-axis node.
    #[inline(always)]
    pub(crate) const fn dual_plane_indices(self) -> [usize; 2] {
        let code = self.0 >> OFFSET_BITS;
        // Each pair of bits is an axis and a side: x or y first, y or z second.
        [(code >> 2 & 0b11) as usize, 2 + (code & 0b11) as usize]
    }

    /// Asked of dual-axis nodes.
    pub(super) fn dual_planes(self) -> [BoxPlane; 2] {
        self.dual_plane_indices().map(BoxPlane::from_index)
    }

    /// Asked of bounding nodes.
    #[inline(always)]
    pub(crate) fn bounded_axes(self) -> BoundedAxes {
        let code = self.0 >> OFFSET_BITS;
        BoundedAxes::ALL[(code >> 1 & 0b10 | code & 1) as usize]
    }
}

/// Some of the headers of nodes on one axis, a bit each.
#[derive(Clone, Copy, Debug)]
pub struct HeaderSet(u32);

impl HeaderSet {
    /// Those of nodes on this axis.
    pub(crate) fn on(axis: Axis) -> Self {
        let of_kinds = 0b1111 << (4 * axis.index());
        Self(of_kinds | of_kinds << LEAF)
    }

    /// Whether it holds the header of a node on one axis.
    #[inline(always)]
    pub(crate) fn holds(self, node: FirstWord) -> bool {
        self.0 >> (node.0 >> OFFSET_BITS & (SEVERAL_AXES - 1)) & 1 != 0
    }
}

impl FromIterator<Self> for HeaderSet {
    fn from_iter<T: IntoIterator<Item = Self>>(sets: T) -> Self {
        Self(sets.into_iter().fold(0, |all, set| all | set.0))
    }
}

/// By header.
static CARVED_PLANES: [[u8; 2]; 64] = carved_planes();

const fn carved_planes() -> [[u8; 2]; 64] {
    let mut table = [[6; 2]; 64];
    let mut code = 0;
    while code < 64 {
        let middle = code >> 2 & 0b11;
        let word = FirstWord(code << OFFSET_BITS);
        if code & SEVERAL_AXES != 0 {
            if code & AXES_MASK != BOUNDING_AXES {
                let [first, second] = word.dual_plane_indices();
                table[code as usize] = [first as u8, second as u8];
            }
        } else if code & KIND_MASK == SINGLE && middle < 3 {
            let low = 2 * middle as u8;
            table[code as usize] = [low + 1, low];
        }
        code += 1;
    }
    table
}

#[cfg(test)]
mod tests {
    use super::super::header::tests::all_headers;
    use super::super::{CarvingPlanes, Header};
    use super::*;

    #[test]
    fn the_traversal_s_answers_are_those_of_the_header() {
        for header in all_headers() {
            let word = FirstWord(header.encode(7));
            match header {
                Header::Leaf => assert!(!word.is_on_several_axes() && word.is_plain_leaf()),
                Header::Splitting {
                    axis,
                    first_child_words,
                } => {
                    assert!(!word.is_on_several_axes() && !word.is_plain_leaf());
                    assert!(word.splits());
                    assert_eq!(word.axis_index(), axis.index());
                    assert_eq!(word.first_child_words() as usize, first_child_words);
                    let is_small = first_child_words < 5;
                    let small = word.small_first_child_words() as usize;
                    assert_eq!(small == first_child_words, is_small);
                }
                Header::Carving { planes, is_leaf } => {
                    assert_eq!(word.is_leaf(), is_leaf);
                    let is_single = matches!(planes, CarvingPlanes::Single(_));
                    assert_eq!(word.is_on_several_axes(), !is_single);
                    match planes {
                        CarvingPlanes::Single(axis) => {
                            assert!(!word.is_plain_leaf() && word.carves());
                            assert_eq!(word.axis_index(), axis.index());
                        }
                        CarvingPlanes::Dual(first, second) => {
                            let indices = [first.index(), second.index()];
                            assert_eq!(word.dual_plane_indices(), indices);
                        }
                        CarvingPlanes::Bounding(bounded) => {
                            assert_eq!(word.bounded_axes(), bounded);
                        }
                    }
                }
            }
        }
    }
}
