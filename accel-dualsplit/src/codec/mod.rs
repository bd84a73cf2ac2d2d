//! The codec of nodes (Lin 2019, section 4.1). Only the files of this folder know
//! bits.
//!
//! A node's first word holds a header in its upper 6 bits and an offset in its
//! lower 26. A leaf without carving planes is this word alone; every other node
//! is followed by planes in single precision, two but for the bounding nodes of
//! an H-tree. The offset of an inner node leads from the node to its first child,
//! in words; that of a leaf is the number of the leaf in the storage: the index of
//! its first reference.
//!
//! The paper's Figure 6 is a drawing; these are our codes, `a` an axis (00 x, 01
//! y, 10 z), `p` a pair of axes (00 xy, 01 xz, 11 yz), `l` whether the node is a
//! leaf, `s` the words of the first child, `c` the corner:
//!
//! | bits | node | planes | codes |
//! |---|---|---|---|
//! | `0 0 aa ss` | splitting, ss = 01 or 11 | high bound of the first child, low bound of the second | 6 |
//! | `0 l aa 10` | single-axis carving | high bound, low bound | 6 |
//! | `0 1 00 00` | leaf | none | 1 |
//! | `1 l pc pc` | dual-axis carving | a bound on the first axis, one on the second | 24 |
//!
//! These 37 are the nodes of a dual-split tree; 13 of them, those of the first
//! three rows, are the nodes of a BIH. An H-tree has these 13 and, in codes that a
//! dual-split tree leaves unused, 14 others:
//!
//! | bits | node | planes | codes |
//! |---|---|---|---|
//! | `0 1 aa ss` | splitting, the first child has ss + 4 words: 5 or 7 | as above | 6 |
//! | `1 l 1x 0x` | bounding on axes xy (00), xz (01), xyz (10), yz (11) | high and low bound on each | 8 |
//!
//! The first bit of a corner says that the plane on the first axis is a high bound,
//! the second bit the same of the second axis. Each stands behind the bit that tells
//! its axis, so that both together are the place of the plane among those of a box.
//!
//! The planes of single-axis carving stand in the order of those of splitting:
//! so a ray leaves through the same one and enters through the same other one in
//! both kinds of node, and the traversal computes both before it knows the kind.

mod first_word;
mod header;
mod node;
mod words;

pub(crate) use first_word::{FirstWord, HeaderSet};
pub(crate) use header::{BoundedAxes, BoxPlane, CarvingPlanes, Header};
pub(crate) use node::Node;
pub(crate) use words::{MAX_WORDS, NodeWords};

/// Bytes of a splitting node, and of a carving node with two planes.
pub const NODE_BYTES: usize = NODE_WORDS * 4;

/// Bytes of a leaf without planes.
pub const LEAF_BYTES: usize = LEAF_WORDS * 4;

pub(crate) const NODE_WORDS: usize = 3;
pub(crate) const LEAF_WORDS: usize = 1;

/// Words behind the last node, so that planes can be read before it is known
/// whether there are any.
pub(crate) const PADDING: usize = NODE_WORDS - LEAF_WORDS;

/// Planes of the node with most of them.
pub(crate) const MOST_PLANES: usize = 6;

const OFFSET_BITS: u32 = 26;
const OFFSET_MASK: u32 = (1 << OFFSET_BITS) - 1;

/// The largest offset and the largest number of a leaf.
pub(crate) const MAX_OFFSET: usize = OFFSET_MASK as usize;

/// Carves on several axes.
const SEVERAL_AXES: u32 = 1 << 5;
const LEAF: u32 = 1 << 4;
/// In the lowest bits: single-axis carving.
const SINGLE: u32 = 0b10;
/// In the lowest bit: splitting, asked of nodes that do not carve on several axes.
const SPLITTING: u32 = 0b01;
const KIND_MASK: u32 = 0b11;
/// Of a node that carves on several axes: which pair of axes.
const AXES_MASK: u32 = 0b1010;
/// The pair that no dual-axis node has, yx.
const BOUNDING_AXES: u32 = 0b1000;

const _: () = assert!(NODE_BYTES == 12 && LEAF_BYTES == 4);
const _: () = assert!(SEVERAL_AXES << 1 == 1 << (u32::BITS - OFFSET_BITS));
