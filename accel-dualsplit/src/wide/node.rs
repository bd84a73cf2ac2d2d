//! The codec of wide nodes.
//!
//! | words | hold |
//! |---|---|
//! | 4 | by row, which plane of a box each child's plane is, three bits a child, the first child's lowest; above those of the first row, one less than there are children |
//! | 4 a child | by row, the planes of the children; zero where there is none |
//! | 1 a child | where the child is, or the number of the leaf and [`IS_LEAF`] |
//!
//! A node is read as if it had eight children. What is read too much are other words
//! of the tree, or [`PADDING`]: of children that there are not.

use accel_core::Aabb;

use crate::codec::BoxPlane;

/// The most children of a node.
pub(super) const LANES: usize = 8;

/// The most planes of a child.
pub(super) const ROWS: usize = 4;

/// Words of a child in its node.
const CHILD_WORDS: usize = ROWS + 1;

/// Words of the children of a node that has the most.
const REST_WORDS: usize = CHILD_WORDS * LANES;

/// Words behind the last node.
pub(super) const PADDING: usize = REST_WORDS;

/// Stands for a plane that a child does not have.
pub(super) const NO_PLANE: u32 = 6;

const BITS_A_PICK: usize = 3;
const COUNT_SHIFT: usize = LANES * BITS_A_PICK;

const IS_LEAF: u32 = 1 << 31;

/// The largest position of a node and the largest number of a leaf.
pub(super) const MAX_TARGET: usize = (IS_LEAF - 1) as usize;

/// Where a child is, in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct WidePointer(u32);

/// A [`WidePointer`] taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// The node at this word.
    Inner(u32),
    /// The leaf with this number.
    Leaf(u32),
}

impl WidePointer {
    /// Of a target that is at most [`MAX_TARGET`].
    pub(super) fn new(target: Target) -> Self {
        match target {
            Target::Inner(position) => Self(position),
            Target::Leaf(leaf) => Self(leaf | IS_LEAF),
        }
    }

    #[inline(always)]
    pub(super) fn target(self) -> Target {
        let number = self.0 & !IS_LEAF;
        if self.0 & IS_LEAF != 0 {
            Target::Leaf(number)
        } else {
            Target::Inner(number)
        }
    }
}

/// A node as it lies in memory.
#[derive(Clone, Copy, Debug)]
pub(super) struct WideNode<'a> {
    picks: &'a [u32; ROWS],
    /// The words of its children, and those that follow.
    rest: &'a [u32; REST_WORDS],
}

impl<'a> WideNode<'a> {
    /// In words that end with [`PADDING`].
    #[inline(always)]
    pub(super) fn at(words: &'a [u32], position: u32) -> Self {
        let position = position as usize;
        let own = &words[position..position + ROWS + REST_WORDS];
        let (picks, rest) = own.split_first_chunk().expect("the slice is longer");
        Self {
            picks,
            rest: rest.first_chunk().expect("the slice has that length"),
        }
    }

    /// How many children there are, 1 to 8: the mask tells the compiler, too, so that
    /// nothing below is out of range.
    #[inline(always)]
    pub(super) fn children(&self) -> u32 {
        (self.picks[0] >> COUNT_SHIFT & (LANES as u32 - 1)) + 1
    }

    /// Bytes of the node.
    pub(super) fn bytes(&self) -> u32 {
        4 * (ROWS as u32 + CHILD_WORDS as u32 * self.children())
    }

    /// Which planes of a box those of a row are, three bits each, and where they are.
    #[inline(always)]
    pub(super) fn row(&self, row: usize) -> (u32, &'a [u32; LANES]) {
        let first = row * self.children() as usize;
        let planes = self.rest[first..first + LANES].first_chunk();
        (self.picks[row], planes.expect("the slice has that length"))
    }

    #[inline(always)]
    pub(super) fn child(&self, lane: u32) -> WidePointer {
        let lane = lane as usize & (LANES - 1);
        WidePointer(self.rest[ROWS * self.children() as usize + lane])
    }

    /// What the planes of a child leave of the node's region.
    pub(super) fn region(&self, lane: u32, node_region: Aabb) -> Aabb {
        (0..ROWS).fold(node_region, |region, row| {
            let (picks, planes) = self.row(row);
            let pick = picks >> (BITS_A_PICK as u32 * lane) & 0b111;
            if pick == NO_PLANE {
                return region;
            }
            let position = f32::from_bits(planes[lane as usize]);
            BoxPlane::from_index(pick as usize).carve(region, position)
        })
    }
}

/// The planes of a child: which, and where.
#[derive(Clone, Copy, Debug)]
pub(super) struct ChildPlanes(pub [Option<(BoxPlane, f32)>; ROWS]);

/// Writes a node of one to eight children, but not where its children are, and returns where that goes: a word
/// a child, in order.
pub(super) fn push_node(words: &mut Vec<u32>, children: &[ChildPlanes]) -> usize {
    let mut picks = [0; ROWS];
    picks[0] = (children.len() as u32 - 1) << COUNT_SHIFT;
    for (row, picks) in picks.iter_mut().enumerate() {
        for lane in 0..LANES {
            let plane = children.get(lane).and_then(|child| child.0[row]);
            let pick = plane.map_or(NO_PLANE, |(plane, _)| plane.index() as u32);
            *picks |= pick << (BITS_A_PICK * lane);
        }
    }
    words.extend(picks);
    for row in 0..ROWS {
        let positions = children.iter().map(|child| child.0[row]);
        words.extend(positions.map(|plane| plane.map_or(0, |(_, at)| at.to_bits())));
    }
    let pointers = words.len();
    words.resize(pointers + children.len(), 0);
    pointers
}

/// Writes where a child is.
pub(super) fn set_pointer(words: &mut [u32], at: usize, pointer: WidePointer) {
    words[at] = pointer.0;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_survive_encoding() {
        let region = Aabb::new([0.0; 3], [8.0; 3]);
        for count in 1..=LANES {
            let planes = |lane: usize| {
                // Of six planes all but two, which two depends on the lane.
                let kept =
                    (0..6).filter(|index| index % 6 != lane % 6 && index % 6 != (lane + 2) % 6);
                let mut rows = [None; ROWS];
                for (row, index) in rows.iter_mut().zip(kept).skip(lane % 2) {
                    let plane = BoxPlane::from_index(index);
                    *row = Some((
                        plane,
                        if plane.is_high { 5.0 } else { 3.0 } + lane as f32 / 8.0,
                    ));
                }
                ChildPlanes(rows)
            };
            let children: Vec<_> = (0..count).map(planes).collect();
            let mut words = vec![7; 3];
            let pointers = push_node(&mut words, &children);
            for lane in 0..count {
                let target = if lane % 2 == 0 {
                    Target::Leaf(9)
                } else {
                    Target::Inner(11)
                };
                set_pointer(&mut words, pointers + lane, WidePointer::new(target));
            }
            let end = words.len();
            words.resize(end + PADDING, 5);
            let node = WideNode::at(&words, 3);
            assert_eq!(node.children() as usize, count);
            assert_eq!(node.bytes() as usize, 4 * (end - 3));
            for (lane, child) in (0..).zip(&children) {
                let carved = child
                    .0
                    .iter()
                    .flatten()
                    .fold(region, |region, &(plane, position)| {
                        plane.carve(region, position)
                    });
                assert_eq!(node.region(lane, region), carved);
                let is_leaf = matches!(node.child(lane).target(), Target::Leaf(9));
                assert_eq!(is_leaf, lane % 2 == 0);
            }
        }
    }
}
