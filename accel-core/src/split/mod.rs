//! Finding where to split a node, and carrying the split out.

pub mod binning;
mod heuristic;
pub mod partition;
pub mod sweep;

pub use heuristic::{NodeCost, SurfaceAreaHeuristic};

use crate::geometry::Axis;

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
    /// The number of references on both sides.
    pub counts: [usize; 2],
}

/// How good a split is: the cheaper one is better, and of equally dear ones the
/// more balanced one, which keeps trees over coincident primitives shallow.
#[derive(Clone, Copy, Debug)]
struct Rank {
    cost: f64,
    imbalance: usize,
}

impl Rank {
    /// Worse than any split.
    const WORST: Self = Self {
        cost: f64::INFINITY,
        imbalance: usize::MAX,
    };

    #[inline(always)]
    fn new(cost: f64, counts: [usize; 2]) -> Self {
        Self {
            cost,
            imbalance: counts[0].abs_diff(counts[1]),
        }
    }

    #[inline(always)]
    fn beats(self, other: Self) -> bool {
        self.cost < other.cost || (self.cost == other.cost && self.imbalance < other.imbalance)
    }
}

/// Keeps the better of `best` and `candidate`: the cheaper one, of equally dear
/// ones the more balanced one, of equals the earlier one.
#[inline]
pub fn keep_better<Position>(
    best: &mut Option<SplitCandidate<Position>>,
    candidate: SplitCandidate<Position>,
) {
    let rank = |candidate: &SplitCandidate<Position>| Rank::new(candidate.cost, candidate.counts);
    if best
        .as_ref()
        .is_none_or(|best| rank(&candidate).beats(rank(best)))
    {
        *best = Some(candidate);
    }
}
