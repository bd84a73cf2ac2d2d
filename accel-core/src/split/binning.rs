//! The quick search: references counted into bins, cuts between bins only.

use super::{Rank, SplitCandidate, SurfaceAreaHeuristic, keep_better};
use crate::geometry::{Aabb, Axis, GrowingBox};
use crate::reference::Reference;

/// The most bins per axis that a search can use.
pub const MAX_BINS: usize = 64;

/// Which bin a position along an axis falls into. One object answers for search
/// and partition, so that the two can't disagree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BinMapping {
    /// The axis.
    pub axis: Axis,
    /// How many bins there are.
    pub bins: usize,
    low: f32,
    scale: f32,
}

impl BinMapping {
    /// Equal bins over the centres' range on `axis`; `None` where that range is
    /// too small to divide.
    pub fn new(axis: Axis, centers: &Aabb, bins: usize) -> Option<Self> {
        let low = axis.of(centers.min);
        let width = f64::from(axis.of(centers.max)) - f64::from(low);
        let scale = (bins as f64 / width) as f32;
        let is_usable = width > 0.0 && scale > 0.0 && scale.is_finite();
        is_usable.then_some(Self {
            axis,
            bins,
            low,
            scale,
        })
    }

    /// The bin of a position, clamped to the bins there are.
    #[inline]
    pub fn bin(&self, position: f32) -> usize {
        // The cast saturates: nothing, not even infinity, falls outside.
        let bin = ((position - self.low) * self.scale) as u32;
        bin.min(self.bins as u32 - 1) as usize
    }

    /// The bin of a reference: that of its box's centre.
    #[inline]
    pub fn bin_of(&self, reference: &Reference) -> usize {
        self.bin(reference.bounds.center_along(self.axis))
    }
}

/// The references whose centres fall into one bin.
#[derive(Clone, Copy, Debug)]
struct Bin {
    bounds: GrowingBox,
    count: usize,
}

impl Bin {
    #[inline(always)]
    fn empty() -> Self {
        Self {
            bounds: GrowingBox::empty(),
            count: 0,
        }
    }

    #[inline(always)]
    fn add(&mut self, reference: &Reference) {
        self.bounds.add(&reference.bounds);
        self.count += 1;
    }

    #[inline(always)]
    fn merge(&mut self, other: &Self) {
        self.bounds.merge(&other.bounds);
        self.count += other.count;
    }
}

/// The bins of all three axes, with room for `N` on each: a small `N` saves the
/// clearing that would dominate in small nodes.
#[derive(Clone, Debug)]
pub struct Bins<const N: usize> {
    mappings: [Option<BinMapping>; 3],
    bins: [[Bin; N]; 3],
}

impl<const N: usize> Bins<N> {
    /// Empty bins over the range of `centers`, `bins` but at most `N` per axis.
    #[inline]
    pub fn new(centers: &Aabb, bins: usize) -> Self {
        Self {
            mappings: Axis::ALL.map(|axis| BinMapping::new(axis, centers, bins.min(N))),
            bins: [[Bin::empty(); N]; 3],
        }
    }

    /// Counts `references` in.
    pub fn fill<R: AsRef<Reference>>(&mut self, references: &[R]) {
        let [x, y, z] = &self.mappings;
        if let (Some(x), Some(y), Some(z)) = (x, y, z) {
            // The usual case, in one pass.
            for reference in references {
                let reference = reference.as_ref();
                self.bins[0][x.bin_of(reference)].add(reference);
                self.bins[1][y.bin_of(reference)].add(reference);
                self.bins[2][z.bin_of(reference)].add(reference);
            }
            return;
        }
        for (mapping, bins) in self.mappings.iter().zip(&mut self.bins) {
            let Some(mapping) = mapping else { continue };
            for reference in references {
                let reference = reference.as_ref();
                bins[mapping.bin_of(reference)].add(reference);
            }
        }
    }

    /// Adds what was counted elsewhere over the same range: the order does not
    /// matter, so parallel searches agree with serial ones.
    pub fn merge(&mut self, other: &Self) {
        for (bins, others) in self.bins.iter_mut().zip(&other.bins) {
            for (bin, other) in bins.iter_mut().zip(others) {
                bin.merge(other);
            }
        }
    }

    /// The cheapest cut between two bins of any axis, both sides occupied.
    /// `None` if all centres coincide.
    pub fn cheapest_cut(
        &self,
        parent_area: f64,
        heuristic: &SurfaceAreaHeuristic,
    ) -> Option<BinCut> {
        let mut best = None;
        for (mapping, bins) in self.mappings.iter().zip(&self.bins) {
            if let Some(mapping) = mapping {
                let candidate = cheapest_of_axis(*mapping, bins, parent_area, heuristic);
                if let Some(candidate) = candidate {
                    keep_better(&mut best, candidate);
                }
            }
        }
        best.map(|candidate| self.with_bounds(candidate))
    }

    fn with_bounds(&self, candidate: SplitCandidate<Boundary>) -> BinCut {
        let bins = &self.bins[candidate.axis.index()];
        let (left, right) = bins.split_at(candidate.position.first_right);
        let united = |bins: &[Bin]| {
            let mut bounds = GrowingBox::empty();
            for bin in bins {
                bounds.merge(&bin.bounds);
            }
            bounds.bounds()
        };
        BinCut {
            boundary: candidate.position,
            cost: candidate.cost,
            bounds: [united(left), united(right)],
        }
    }
}

/// A cut between two bins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BinCut {
    /// Where it is.
    pub boundary: Boundary,
    /// The expected cost of the node, cut there.
    pub cost: f64,
    /// The boxes of both sides.
    pub bounds: [Aabb; 2],
}

/// The boundary between two bins: references in bins before `first_right` go
/// left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boundary {
    /// How references fall into bins.
    pub mapping: BinMapping,
    /// The first bin of the right side.
    pub first_right: usize,
}

impl Boundary {
    /// Whether `reference` goes left.
    #[inline]
    pub fn is_left(&self, reference: &Reference) -> bool {
        self.mapping.bin_of(reference) < self.first_right
    }
}

fn cheapest_of_axis<const N: usize>(
    mapping: BinMapping,
    bins: &[Bin; N],
    parent_area: f64,
    heuristic: &SurfaceAreaHeuristic,
) -> Option<SplitCandidate<Boundary>> {
    let bins = &bins[..mapping.bins];
    let mut right_of = [(0.0, 0); N];
    let mut right = Bin::empty();
    for (bin, slot) in bins.iter().zip(&mut right_of).skip(1).rev() {
        right.merge(bin);
        *slot = (right.bounds.half_area(), right.count);
    }
    let node_cost = heuristic.of_node(parent_area, right.count + bins[0].count);
    let mut left = Bin::empty();
    let (mut best, mut found) = (Rank::WORST, None);
    for (before, (bin, &(right_area, right_count))) in bins.iter().zip(&right_of[1..]).enumerate() {
        left.merge(bin);
        let counts = [left.count, right_count];
        let rank = Rank::new(
            node_cost.split([left.bounds.half_area(), right_area], counts),
            counts,
        );
        if left.count > 0 && right_count > 0 && rank.beats(best) {
            (best, found) = (rank, Some((before + 1, counts)));
        }
    }
    found.map(|(first_right, counts)| SplitCandidate {
        axis: mapping.axis,
        position: Boundary {
            mapping,
            first_right,
        },
        cost: best.cost,
        counts,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::{bounds_of, centers_of};

    fn boxes(xs: &[f32]) -> Vec<Reference> {
        (0..)
            .zip(xs)
            .map(|(id, &x)| Reference {
                bounds: Aabb::new([x, 0.0, 0.0], [x + 1.0, 1.0, 1.0]),
                id,
            })
            .collect()
    }

    #[test]
    fn search_and_partition_agree_and_merging_equals_filling_at_once() {
        let references = boxes(&[0.0, 1.0, 2.0, 30.0, 31.0]);
        let centers = centers_of(&references);
        let area = bounds_of(&references).half_area();
        let mut at_once = Bins::<16>::new(&centers, 16);
        at_once.fill(&references);
        let (first, second) = references.split_at(2);
        let mut merged = Bins::<16>::new(&centers, 16);
        merged.fill(second);
        let mut other = Bins::<16>::new(&centers, 16);
        other.fill(first);
        merged.merge(&other);

        let heuristic = SurfaceAreaHeuristic::default();
        let cut = at_once.cheapest_cut(area, &heuristic).unwrap();
        assert_eq!(merged.cheapest_cut(area, &heuristic), Some(cut));
        let (left, right): (Vec<Reference>, Vec<Reference>) = references
            .iter()
            .partition(|reference| cut.boundary.is_left(reference));
        assert_eq!((left.len(), right.len()), (3, 2));
        assert_eq!(cut.bounds, [bounds_of(&left), bounds_of(&right)]);
    }

    #[test]
    fn coincident_centres_have_no_cut() {
        let references = boxes(&[4.0, 4.0, 4.0]);
        let bins = Bins::<16>::new(&centers_of(&references), 16);
        assert!(
            bins.cheapest_cut(1.0, &SurfaceAreaHeuristic::default())
                .is_none()
        );
    }

    #[test]
    fn bins_are_clamped_at_both_ends() {
        let range = Aabb::new([-1.0; 3], [f32::MAX; 3]);
        let mapping = BinMapping::new(Axis::X, &range, 8).unwrap();
        assert_eq!(mapping.bin(-2.0), 0);
        assert_eq!(mapping.bin(f32::MAX), 7);
        assert_eq!(mapping.bin(f32::INFINITY), 7);
    }
}
