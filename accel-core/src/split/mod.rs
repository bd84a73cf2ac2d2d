//! Finding where to split a node, and carrying the split out.

pub mod binning;
mod heuristic;
pub mod partition;
pub mod sweep;

pub use heuristic::SurfaceAreaHeuristic;

use crate::geometry::{Aabb, Axis};

/// A way to divide the references of a node into two sets without duplicating
/// any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitCandidate<Position> {
    /// The axis along which references are ordered.
    pub axis: Axis,
    /// Where the order is cut; what it means is up to the search.
    pub position: Position,
    /// The expected cost of the node, split this way, by the surface area
    /// heuristic.
    pub cost: f64,
    /// The boxes of both sides.
    pub bounds: [Aabb; 2],
    /// The number of references on both sides.
    pub counts: [usize; 2],
}

impl<Position> SplitCandidate<Position> {
    /// Whether this candidate is to be preferred: cheaper, or as cheap and more
    /// balanced, which keeps trees over coincident primitives shallow.
    #[inline]
    pub fn beats(&self, other: &Self) -> bool {
        self.cost < other.cost || (self.cost == other.cost && self.imbalance() < other.imbalance())
    }

    fn imbalance(&self) -> usize {
        self.counts[0].abs_diff(self.counts[1])
    }
}

/// Keeps the better of `best` and `candidate`; the earlier of equals.
#[inline]
pub fn keep_better<Position>(
    best: &mut Option<SplitCandidate<Position>>,
    candidate: SplitCandidate<Position>,
) {
    if best.as_ref().is_none_or(|best| candidate.beats(best)) {
        *best = Some(candidate);
    }
}
