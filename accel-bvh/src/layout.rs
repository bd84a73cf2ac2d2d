//! From a build tree to words.

use accel_core::build::{BuildNode, BuildTree, Cursor};
use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::{Aabb, BuildBudget, BuildError, Primitive};

use crate::bvh::{Bvh, Root};
use crate::node::{INNER_WORDS, InnerNode, LEAF_WORDS, MAX_OFFSET, NodePointer, Siblings};

/// What a builder records of an inner node: the boxes of its left and right
/// child.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChildBounds(pub [Aabb; 2]);

impl<P: Primitive> Bvh<P> {
    /// The tree over nothing that can be hit.
    pub(crate) fn empty(primitives: &[P], skipped: usize) -> Self {
        Self {
            words: Vec::new(),
            stored: StoredPrimitives::new(primitives, skipped, 0),
            root: None,
            depth: 0,
        }
    }

    /// Packs a build tree: for builders outside this crate. `bounds` encloses
    /// all of it; `skipped` primitives are in no leaf.
    ///
    /// # Errors
    /// [`BuildError::OffsetOverflow`] if the tree is too large for the layout,
    /// [`BuildError::BudgetExceeded`] if it is too large for `budget`.
    pub fn from_build_tree(
        primitives: &[P],
        tree: &BuildTree<ChildBounds>,
        bounds: Aabb,
        skipped: usize,
        budget: &BuildBudget,
    ) -> Result<Self, BuildError> {
        let (inner, leaves) = tree.count();
        let words = inner * INNER_WORDS + leaves * LEAF_WORDS;
        if words > MAX_OFFSET {
            return Err(BuildError::OffsetOverflow {
                needed: words,
                limit: MAX_OFFSET,
            });
        }
        let references = tree.references();
        let storage = references * (size_of::<P>() + 2 * size_of::<u32>());
        budget.check_bytes(tree.bytes() + words * size_of::<u32>() + storage)?;
        let mut packing = Packing {
            primitives,
            words: Vec::with_capacity(words),
            stored: StoredPrimitives::new(primitives, skipped, references),
        };
        let (pointer, depth) = packing.pack(tree.root());
        Ok(Self {
            words: packing.words,
            stored: packing.stored,
            root: Some(Root { bounds, pointer }),
            depth,
        })
    }
}

struct Packing<'a, P: Primitive> {
    primitives: &'a [P],
    words: Vec<u32>,
    stored: StoredPrimitives<P>,
}

impl<P: Primitive> Packing<'_, P> {
    /// Writes all nodes in depth-first order, each pair of siblings at the end
    /// of what is written when their parent is, and returns the root and the
    /// depth.
    fn pack(&mut self, root: Cursor<'_, ChildBounds>) -> (NodePointer, u32) {
        let root_pointer = NodePointer::new(0, is_leaf(root));
        self.reserve(if is_leaf(root) {
            LEAF_WORDS
        } else {
            INNER_WORDS
        });
        let mut deepest = 0;
        let mut pending = vec![(root, 0, 0)];
        while let Some((cursor, offset, depth)) = pending.pop() {
            deepest = deepest.max(depth);
            match cursor.node() {
                BuildNode::Leaf(ids) => {
                    self.words[offset] = self.stored.leaves_mut().push_leaf(self.primitives, ids);
                }
                BuildNode::Inner { node, children } => {
                    let siblings = Siblings {
                        offset: self.words.len() as u32,
                        are_leaves: children.map(is_leaf),
                    };
                    let encoded = InnerNode::encode(&node.0, siblings);
                    self.words[offset..offset + INNER_WORDS].copy_from_slice(&encoded);
                    let left = self.reserve(siblings.words());
                    let right = left
                        + if siblings.are_leaves[0] {
                            LEAF_WORDS
                        } else {
                            INNER_WORDS
                        };
                    pending.push((children[1], right, depth + 1));
                    pending.push((children[0], left, depth + 1));
                }
            }
        }
        (root_pointer, deepest)
    }

    fn reserve(&mut self, words: usize) -> usize {
        let offset = self.words.len();
        self.words.resize(offset + words, 0);
        offset
    }
}

fn is_leaf(cursor: Cursor<'_, ChildBounds>) -> bool {
    matches!(cursor.node(), BuildNode::Leaf(_))
}
