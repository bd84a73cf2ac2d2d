//! What a subtree may use. Shared out from the root down, by size, so that the
//! limits hold and the tree is the same for any number of threads.

use accel_core::Polygonal;
use accel_core::build::share_by_size;

use crate::BspBuilder;
use crate::builder::BYTES_PER_PIECE;
use crate::layout::BYTES_PER_NODE;
use crate::node::MAX_INDEX;

/// What a subtree may use, its root included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Allowance {
    /// References that splits add.
    pub duplicates: usize,
    /// Nodes, at least 1.
    pub nodes: usize,
    /// Planes that are weighed.
    pub candidates: usize,
}

impl Allowance {
    /// Of a whole tree. Pieces are gone when the tree is packed, so that what they took is
    /// left to nodes.
    pub(crate) fn new<P: Polygonal>(builder: &BspBuilder, primitives: usize) -> Self {
        let bytes = builder.budget.max_bytes;
        let references = bytes.map_or(usize::MAX, |bytes| bytes / builder.working_bytes::<P>(1));
        let within_bytes = references.saturating_mul(BYTES_PER_PIECE) / BYTES_PER_NODE;
        let by_setting = (builder.max_duplication * primitives as f64) as usize;
        Self {
            duplicates: by_setting.min(references - primitives),
            nodes: (builder.max_nodes.unwrap_or(MAX_INDEX))
                .min(MAX_INDEX)
                .min(within_bytes),
            candidates: builder.max_candidates.saturating_mul(primitives),
        }
    }

    /// Of both children that hold so many pieces, by a parent that has not more
    /// than this left, its own node aside.
    pub(crate) fn shared(self, pieces: [usize; 2]) -> [Self; 2] {
        // A single piece is not cut any further, and an empty part is a leaf.
        let divisible = pieces.map(|count| count.saturating_sub(1));
        let duplicates = share_by_size(self.duplicates, divisible);
        let candidates = share_by_size(self.candidates, pieces);
        let nodes = share_by_size(self.nodes.saturating_sub(3), pieces);
        [0, 1].map(|side: usize| Self {
            duplicates: duplicates[side],
            nodes: 1 + nodes[side],
            candidates: candidates[side],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn children_share_what_is_left_and_never_more() {
        let parent = Allowance {
            duplicates: 10,
            nodes: 9,
            candidates: 100,
        };
        let [small, large] = parent.shared([2, 5]);
        assert_eq!((small.duplicates, large.duplicates), (2, 8));
        assert_eq!((small.candidates, large.candidates), (28, 71));
        assert_eq!((small.nodes, large.nodes), (2, 5));
        let [empty, single] = parent.shared([0, 1]);
        assert_eq!((empty.nodes, single.nodes), (1, 7));
        assert_eq!((empty.duplicates, single.duplicates), (0, 0));
    }
}
