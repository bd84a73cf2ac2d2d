//! The words of a tree's nodes.

use super::{LEAF_WORDS, PADDING};

/// The most words that a tree may have: positions take 31 bits.
pub(crate) const MAX_WORDS: usize = (1 << 31) - 1;

/// The words of a tree's nodes, and a few more behind them: a traversal may read as
/// many words of a leaf as other nodes have.
#[derive(Clone, Debug)]
pub(crate) struct NodeWords(Vec<u32>);

impl NodeWords {
    /// Of at most [`MAX_WORDS`] words.
    pub(crate) fn new(mut words: Vec<u32>) -> Self {
        debug_assert!(words.len() <= MAX_WORDS, "sizes are checked before");
        words.reserve_exact(PADDING);
        words.extend([0; PADDING]);
        Self(words)
    }

    /// The nodes.
    #[inline(always)]
    pub(crate) fn nodes(&self) -> &[u32] {
        &self.0[..self.0.len() - PADDING]
    }

    /// Moves the planes of the node at `position`.
    pub(crate) fn set_planes(&mut self, position: usize, planes: &[f32]) {
        let own = &mut self.0[position + LEAF_WORDS..];
        for (word, plane) in own.iter_mut().zip(planes) {
            *word = plane.to_bits();
        }
    }

    /// The nodes and the padding.
    #[inline(always)]
    pub(crate) fn padded(&self) -> &[u32] {
        &self.0
    }
}
