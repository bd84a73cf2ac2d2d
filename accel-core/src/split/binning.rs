//! The quick search: references counted into bins, cuts between bins only.

use super::{SplitCandidate, SurfaceAreaHeuristic, keep_better};
use arrayvec::ArrayVec;

use crate::geometry::{Aabb, Axis};
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
        let bin = ((position - self.low) * self.scale) as usize;
        bin.min(self.bins - 1)
    }

    /// The bin of a reference: that of its box's centre.
    #[inline]
    pub fn bin_of(&self, reference: &Reference) -> usize {
        self.bin(reference.bounds.center_along(self.axis))
    }
}

/// The references whose centres fall into one bin.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bin {
    bounds: Aabb,
    count: usize,
}

impl Bin {
    const EMPTY: Self = Self {
        bounds: Aabb::EMPTY,
        count: 0,
    };

    #[inline]
    fn merge(&mut self, other: &Self) {
        self.bounds = self.bounds.union(&other.bounds);
        self.count += other.count;
    }
}

/// The bins of all three axes, filled in one pass over the references.
#[derive(Clone, Debug, PartialEq)]
pub struct Bins {
    mappings: [Option<BinMapping>; 3],
    bins: [ArrayVec<Bin, MAX_BINS>; 3],
}

impl Bins {
    /// Empty bins over the range of `centers`, `bins` per axis.
    pub fn new(centers: &Aabb, bins: usize) -> Self {
        let bins = bins.min(MAX_BINS);
        // Only as many as are used: clearing all of them would dominate in small
        // nodes.
        let empty = || std::iter::repeat_n(Bin::EMPTY, bins).collect();
        Self {
            mappings: Axis::ALL.map(|axis| BinMapping::new(axis, centers, bins)),
            bins: [empty(), empty(), empty()],
        }
    }

    /// Counts `references` in.
    pub fn fill(&mut self, references: &[Reference]) {
        for (mapping, bins) in self.mappings.iter().zip(&mut self.bins) {
            let Some(mapping) = mapping else { continue };
            for reference in references {
                let bin = &mut bins[mapping.bin_of(reference)];
                bin.bounds = bin.bounds.union(&reference.bounds);
                bin.count += 1;
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

    /// The cheapest cut between two bins of any axis, both sides occupied; its
    /// position is the mapping and the first bin of the second side. `None` if
    /// all centres coincide.
    pub fn cheapest_cut(
        &self,
        parent_area: f64,
        heuristic: &SurfaceAreaHeuristic,
    ) -> Option<SplitCandidate<BinCut>> {
        let mut best = None;
        for (mapping, bins) in self.mappings.iter().zip(&self.bins) {
            if let Some(mapping) = mapping {
                cheapest_cut_of_axis(*mapping, bins, parent_area, heuristic, &mut best);
            }
        }
        best
    }
}

/// A cut between two bins: references in bins before `first_right` go left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BinCut {
    /// How references fall into bins.
    pub mapping: BinMapping,
    /// The first bin of the right side.
    pub first_right: usize,
}

impl BinCut {
    /// Whether `reference` goes left.
    #[inline]
    pub fn is_left(&self, reference: &Reference) -> bool {
        self.mapping.bin_of(reference) < self.first_right
    }
}

fn cheapest_cut_of_axis(
    mapping: BinMapping,
    bins: &[Bin],
    parent_area: f64,
    heuristic: &SurfaceAreaHeuristic,
    best: &mut Option<SplitCandidate<BinCut>>,
) {
    let mut right_of: ArrayVec<Bin, MAX_BINS> = bins.iter().copied().collect();
    for bin in (1..bins.len()).rev() {
        let after = right_of[bin];
        right_of[bin - 1].merge(&after);
    }
    let mut left = Bin::EMPTY;
    for first_right in 1..bins.len() {
        left.merge(&bins[first_right - 1]);
        let right = &right_of[first_right];
        if left.count == 0 || right.count == 0 {
            continue;
        }
        let areas = [left.bounds.half_area(), right.bounds.half_area()];
        let counts = [left.count, right.count];
        let candidate = SplitCandidate {
            axis: mapping.axis,
            position: BinCut {
                mapping,
                first_right,
            },
            cost: heuristic.split_cost(parent_area, areas, counts),
            bounds: [left.bounds, right.bounds],
            counts,
        };
        keep_better(best, candidate);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxes(xs: &[f32]) -> Vec<Reference> {
        (0..)
            .zip(xs)
            .map(|(id, &x)| Reference {
                bounds: Aabb::new([x, 0.0, 0.0], [x + 1.0, 1.0, 1.0]),
                id,
            })
            .collect()
    }

    fn centers(references: &[Reference]) -> Aabb {
        references.iter().fold(Aabb::EMPTY, |bounds, reference| {
            bounds.grown_to(reference.bounds.center())
        })
    }

    #[test]
    fn search_and_partition_agree_and_merging_equals_filling_at_once() {
        let references = boxes(&[0.0, 1.0, 2.0, 30.0, 31.0]);
        let centers = centers(&references);
        let mut at_once = Bins::new(&centers, 16);
        at_once.fill(&references);
        let (first, second) = references.split_at(2);
        let mut merged = Bins::new(&centers, 16);
        merged.fill(second);
        let mut other = Bins::new(&centers, 16);
        other.fill(first);
        merged.merge(&other);
        assert_eq!(merged, at_once);

        let area = crate::reference::bounds_of(&references).half_area();
        let cut = at_once
            .cheapest_cut(area, &SurfaceAreaHeuristic::default())
            .unwrap();
        assert_eq!(cut.counts, [3, 2]);
        let left = references
            .iter()
            .filter(|reference| cut.position.is_left(reference));
        assert_eq!(left.count(), 3);
    }

    #[test]
    fn coincident_centres_have_no_cut() {
        let references = boxes(&[4.0, 4.0, 4.0]);
        let bins = Bins::new(&centers(&references), 16);
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
