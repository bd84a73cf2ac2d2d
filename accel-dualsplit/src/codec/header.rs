//! Headers, taken apart and put together.

use accel_core::Aabb;
use accel_core::geometry::Axis;

use super::{
    AXES_MASK, BOUNDING_AXES, FirstWord, KIND_MASK, LEAF, LEAF_WORDS, MAX_OFFSET, MOST_PLANES,
    OFFSET_BITS, SEVERAL_AXES, SINGLE,
};

/// One of the six planes of a box: an axis and a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoxPlane {
    pub axis: Axis,
    pub is_high: bool,
}

impl BoxPlane {
    /// 0 to 5: low x, high x, low y, and so on.
    #[inline]
    pub(crate) fn index(self) -> usize {
        2 * self.axis.index() + usize::from(self.is_high)
    }

    /// The plane with this [`index`](Self::index).
    pub(crate) fn from_index(index: usize) -> Self {
        Self {
            axis: Axis::ALL[index / 2],
            is_high: index % 2 == 1,
        }
    }

    /// Where the plane is on a box.
    pub(crate) fn of(self, bounds: &Aabb) -> f32 {
        self.axis
            .of(if self.is_high { bounds.max } else { bounds.min })
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

/// The axes of a bounding node, two or three.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoundedAxes {
    Xy,
    Xz,
    Xyz,
    Yz,
}

impl BoundedAxes {
    /// In the order of their codes.
    pub(crate) const ALL: [Self; 4] = [Self::Xy, Self::Xz, Self::Xyz, Self::Yz];

    #[inline]
    pub(crate) fn axes(self) -> &'static [Axis] {
        match self {
            Self::Xy => &[Axis::X, Axis::Y],
            Self::Xz => &[Axis::X, Axis::Z],
            Self::Xyz => &Axis::ALL,
            Self::Yz => &[Axis::Y, Axis::Z],
        }
    }
}

/// Which planes a carving node holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CarvingPlanes {
    /// High and low on one axis.
    Single(Axis),
    /// One on each of two axes, in order.
    Dual(BoxPlane, BoxPlane),
    /// High and low on each of several axes.
    Bounding(BoundedAxes),
}

impl CarvingPlanes {
    pub(crate) fn count(self) -> usize {
        match self {
            Self::Single(_) | Self::Dual(..) => 2,
            Self::Bounding(bounded) => 2 * bounded.axes().len(),
        }
    }

    /// Which planes of a box they are, in the order in which they stand.
    #[inline(always)]
    pub(crate) fn box_planes(self) -> impl Iterator<Item = BoxPlane> {
        let pair = |axis| [true, false].map(|is_high| BoxPlane { axis, is_high });
        let (one, axes): (_, &[Axis]) = match self {
            Self::Single(axis) => (Some(pair(axis)), &[]),
            Self::Dual(a, b) => (Some([a, b]), &[]),
            Self::Bounding(bounded) => (None, bounded.axes()),
        };
        let several = axes.iter().map(move |&axis| pair(axis));
        one.into_iter().chain(several).flatten()
    }

    /// The positions that carve to `bounds`: as many as there are planes, then zeros.
    pub(crate) fn around(self, bounds: &Aabb) -> [f32; MOST_PLANES] {
        let mut positions = [0.0; MOST_PLANES];
        let pair = |axis: Axis| [axis.of(bounds.max), axis.of(bounds.min)];
        match self {
            Self::Single(axis) => positions[..2].copy_from_slice(&pair(axis)),
            Self::Dual(a, b) => positions[..2].copy_from_slice(&[a.of(bounds), b.of(bounds)]),
            Self::Bounding(bounded) => {
                for (&axis, place) in bounded.axes().iter().zip(positions.chunks_exact_mut(2)) {
                    place.copy_from_slice(&pair(axis));
                }
            }
        }
        positions
    }

    /// What is left of `region` with the planes at these positions.
    pub(crate) fn carve(self, region: Aabb, positions: &[f32]) -> Aabb {
        let range = |region: Aabb, axis: Axis, pair: &[f32]| {
            let [high, low] = [pair[0], pair[1]];
            region.with_range(axis, low, high)
        };
        match self {
            Self::Single(axis) => range(region, axis, positions),
            Self::Dual(a, b) => a.carve(b.carve(region, positions[1]), positions[0]),
            Self::Bounding(bounded) => {
                let pairs = bounded.axes().iter().zip(positions.chunks(2));
                pairs.fold(region, |region, (&axis, pair)| range(region, axis, pair))
            }
        }
    }
}

/// A header, taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Header {
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
    /// Planes that the node holds.
    pub(crate) fn planes(self) -> usize {
        match self {
            Self::Leaf => 0,
            Self::Splitting { .. } => 2,
            Self::Carving { planes, .. } => planes.count(),
        }
    }

    /// Words that the node takes.
    pub(crate) fn words(self) -> usize {
        LEAF_WORDS + self.planes()
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

    pub(crate) fn code(self) -> u32 {
        match self {
            Self::Splitting {
                axis,
                first_child_words,
            } => {
                let words = first_child_words as u32;
                let is_large = if words > KIND_MASK { LEAF } else { 0 };
                is_large | (axis.index() as u32) << 2 | words & KIND_MASK
            }
            Self::Carving { planes, is_leaf } => {
                let leaf = if is_leaf { LEAF } else { 0 };
                leaf | match planes {
                    CarvingPlanes::Single(axis) => (axis.index() as u32) << 2 | SINGLE,
                    CarvingPlanes::Dual(first, second) => {
                        // x or y first, y or z second: what is left are four each.
                        let [first, second] = [first.index(), second.index() - 2];
                        SEVERAL_AXES | (first as u32) << 2 | second as u32
                    }
                    CarvingPlanes::Bounding(bounded) => {
                        let bounded = bounded as u32;
                        SEVERAL_AXES | BOUNDING_AXES | (bounded & 0b10) << 1 | bounded & 1
                    }
                }
            }
            Self::Leaf => LEAF,
        }
    }

    /// Takes a word apart; `None` for one of the 13 codes that mean nothing in any
    /// tree.
    pub(crate) fn decode(word: FirstWord) -> Option<Self> {
        let code = word.0 >> OFFSET_BITS;
        let middle = (code >> 2) & 0b11;
        let is_leaf = code & LEAF != 0;
        if code & SEVERAL_AXES != 0 {
            let planes = if code & AXES_MASK == BOUNDING_AXES {
                CarvingPlanes::Bounding(word.bounded_axes())
            } else {
                let [first, second] = word.dual_planes();
                CarvingPlanes::Dual(first, second)
            };
            return Some(Self::Carving { planes, is_leaf });
        }
        let axis = Axis::ALL.get(middle as usize).copied();
        match code & KIND_MASK {
            SINGLE => axis.map(|axis| Self::Carving {
                planes: CarvingPlanes::Single(axis),
                is_leaf,
            }),
            0 => (code == LEAF).then_some(Self::Leaf),
            _ => axis.map(|axis| Self::Splitting {
                axis,
                first_child_words: word.first_child_words() as usize,
            }),
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in crate::codec) fn all_headers() -> Vec<Header> {
        let mut headers = vec![Header::Leaf];
        for axis in Axis::ALL {
            for first_child_words in [1, 3, 5, 7] {
                headers.push(Header::Splitting {
                    axis,
                    first_child_words,
                });
            }
        }
        let mut carving = |planes| {
            headers.extend([false, true].map(|is_leaf| Header::Carving { planes, is_leaf }));
        };
        Axis::ALL
            .into_iter()
            .for_each(|axis| carving(CarvingPlanes::Single(axis)));
        BoundedAxes::ALL
            .into_iter()
            .for_each(|bounded| carving(CarvingPlanes::Bounding(bounded)));
        for [first, second] in [[Axis::X, Axis::Y], [Axis::X, Axis::Z], [Axis::Y, Axis::Z]] {
            for corner in 0..4 {
                let plane = |axis, is_high| BoxPlane { axis, is_high };
                let first = plane(first, corner & 2 != 0);
                let second = plane(second, corner & 1 != 0);
                carving(CarvingPlanes::Dual(first, second));
            }
        }
        headers
    }

    #[test]
    fn all_51_headers_survive_encoding_and_no_other_code_is_accepted() {
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
        assert_eq!(codes.len(), 51);
        for code in 0..64 {
            let is_used = Header::decode(FirstWord(code << OFFSET_BITS)).is_some();
            assert_eq!(is_used, codes.contains(&code), "{code:06b}");
        }
    }
}
