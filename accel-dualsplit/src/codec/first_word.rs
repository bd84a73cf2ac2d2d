//! The first word of a node, as the traversal reads it.

use accel_core::geometry::Axis;

use super::{
    BoundedAxes, BoxPlane, KIND_MASK, LEAF, OFFSET_BITS, OFFSET_MASK, SEVERAL_AXES, SPLITTING,
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

    /// Whether this splits; asked of nodes that do not carve on several axes.
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
    pub(crate) fn dual_plane_indices(self) -> [usize; 2] {
        let code = self.0 >> OFFSET_BITS;
        // Twice the axis, and the side: x or y first, y or z second.
        let first = (code >> 2 & 0b10) | (code >> 1 & 1);
        let second = 2 + (code >> 1 & 0b10) + (code & 1);
        [first as usize, second as usize]
    }

    /// Asked of dual-axis nodes.
    pub(super) fn dual_planes(self) -> [BoxPlane; 2] {
        self.dual_plane_indices().map(|index| BoxPlane {
            axis: Axis::ALL[index / 2],
            is_high: index % 2 == 1,
        })
    }

    /// Asked of bounding nodes.
    #[inline(always)]
    pub(crate) fn bounded_axes(self) -> BoundedAxes {
        BoundedAxes::ALL[(self.0 >> OFFSET_BITS & KIND_MASK) as usize]
    }
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
                    assert!(word.is_splitting());
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
                            assert!(!word.is_plain_leaf() && !word.is_splitting());
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
