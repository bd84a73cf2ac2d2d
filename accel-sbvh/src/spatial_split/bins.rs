//! Chopped binning (Stich 2009, section 4.2 and Figure 3).
//!
//! ```text
//! count:  for each reference, the bins where it begins and ends
//! bound:  from below, what a split at each plane costs; drop planes that cost
//!         more than a split that is known, or add too many references
//! chop:   for each reference, the box of its part between every two planes left
//! weigh:  unite boxes and add up counters from both ends
//! ```
//! Dropping planes is ours, not the paper's. It drops none that is cheaper than
//! the best, up to rounding, if primitives are connected; and in most nodes it
//! leaves few planes to chop at, or none.

use accel_core::geometry::{Axis, GrowingBox};
use accel_core::split::NodeCost;
use accel_core::{Aabb, Clip};

use super::{CandidateClipping, SpatialCandidate, SpatialSearch, SplitLimits};
use crate::fragment::Fragment;
use crate::node::Node;

/// Bins of equal width along an axis, with the numbers of references that begin
/// and end in each.
struct SpatialBins {
    axis: Axis,
    /// The planes around the bins, ascending: bin `i` lies between planes `i`
    /// and `i + 1`.
    planes: Vec<f32>,
    /// Bins per unit of length.
    scale: f64,
    bins: Vec<Bin>,
}

#[derive(Clone, Copy)]
struct Bin {
    entries: u32,
    exits: u32,
    /// Around all references that begin here.
    begun: GrowingBox,
    /// Around all references that end here.
    ended: GrowingBox,
}

/// A plane worth a closer look, and the references on both sides.
#[derive(Clone, Copy, Debug)]
struct CandidatePlane {
    /// The first bin on the right.
    bin: usize,
    position: f32,
    counts: [usize; 2],
}

impl<P: Clip> SpatialSearch<'_, P> {
    /// The cheapest plane orthogonal to `axis` within `limits`.
    pub(super) fn cheapest_along(
        &self,
        axis: Axis,
        node: &Node,
        cost: &NodeCost,
        limits: &SplitLimits,
    ) -> Option<SpatialCandidate> {
        let fragments = node.fragments.any_order();
        let mut bins = SpatialBins::new(axis, &node.tight, self.bins_of(fragments.len()))?;
        for fragment in fragments {
            bins.count(fragment);
        }
        let candidates = bins.planes_within(fragments.len(), cost, limits);
        if candidates.is_empty() {
            return None;
        }
        let parts = self.chop(fragments, &bins, &candidates);
        cheapest(axis, &candidates, &parts, cost, limits)
    }

    /// How many bins a node of `count` references has: two at least.
    fn bins_of(&self, count: usize) -> usize {
        let worthwhile = self.bins_per_reference.saturating_mul(count);
        self.bins.min(worthwhile.max(2))
    }

    /// The boxes of what lies before the first candidate plane, between every
    /// two, and after the last.
    fn chop(
        &self,
        fragments: &[Fragment],
        bins: &SpatialBins,
        candidates: &[CandidatePlane],
    ) -> Vec<GrowingBox> {
        let axis = bins.axis;
        let (first, last) = (bins.planes[0], bins.planes[bins.bins.len()]);
        let between = candidates.iter().map(|candidate| candidate.position);
        let planes: Vec<f32> = [first].into_iter().chain(between).chain([last]).collect();
        let part_of_bin = bins.parts_of_bins(candidates);
        let mut parts = vec![GrowingBox::empty(); candidates.len() + 1];
        for fragment in fragments {
            let [entry, exit] = bins.entry_and_exit(fragment).map(|bin| part_of_bin[bin]);
            if entry == exit {
                parts[entry].add(&fragment.tight);
            } else {
                let (planes, parts) = (&planes[entry..=exit + 1], &mut parts[entry..=exit]);
                self.chop_fragment(fragment, axis, planes, parts);
            }
        }
        parts
    }

    fn chop_fragment(
        &self,
        fragment: &Fragment,
        axis: Axis,
        planes: &[f32],
        parts: &mut [GrowingBox],
    ) {
        match self.clipping {
            CandidateClipping::Primitives => {
                let primitive = &self.primitives[fragment.reference.id as usize];
                primitive.chop(&fragment.tight, axis, planes, parts);
            }
            CandidateClipping::Boxes => {
                for (slab, part) in planes.windows(2).zip(parts) {
                    part.add(&fragment.tight.with_range(axis, slab[0], slab[1]));
                }
            }
        }
    }
}

impl SpatialBins {
    /// Empty bins over the extent of `bounds`; `None` where it has none.
    fn new(axis: Axis, bounds: &Aabb, bins: usize) -> Option<Self> {
        let (low, high) = (axis.of(bounds.min), axis.of(bounds.max));
        let width = f64::from(high) - f64::from(low);
        let scale = bins as f64 / width;
        if width <= 0.0 || !scale.is_finite() {
            return None;
        }
        let plane = |i: usize| (f64::from(low) + width * i as f64 / bins as f64) as f32;
        let mut planes: Vec<f32> = (0..=bins).map(plane).collect();
        planes[bins] = high;
        Some(Self {
            axis,
            planes,
            scale,
            bins: vec![Bin::empty(); bins],
        })
    }

    /// The bins where a fragment begins and ends.
    fn entry_and_exit(&self, fragment: &Fragment) -> [usize; 2] {
        let [low, high] = fragment.range(self.axis);
        let entry = self.last_bin_where(low, |plane| plane <= low);
        // What ends on a plane does not reach beyond it.
        let exit = self.last_bin_where(high, |plane| plane < high);
        [entry, exit.max(entry)]
    }

    /// The last bin whose first plane `is_before` the position, the first bin if
    /// there is none: guessed by arithmetic, decided by the planes themselves.
    fn last_bin_where(&self, position: f32, is_before: impl Fn(f32) -> bool) -> usize {
        let last = self.bins.len() - 1;
        let distance = f64::from(position) - f64::from(self.planes[0]);
        let mut bin = ((distance * self.scale) as usize).min(last);
        while bin > 0 && !is_before(self.planes[bin]) {
            bin -= 1;
        }
        while bin < last && is_before(self.planes[bin + 1]) {
            bin += 1;
        }
        bin
    }

    fn count(&mut self, fragment: &Fragment) {
        let [entry, exit] = self.entry_and_exit(fragment);
        self.bins[entry].entries += 1;
        self.bins[entry].begun.add(&fragment.tight);
        self.bins[exit].exits += 1;
        self.bins[exit].ended.add(&fragment.tight);
    }

    /// The planes with references on both sides at which a split may keep
    /// `limits`.
    fn planes_within(
        &self,
        count: usize,
        cost: &NodeCost,
        limits: &SplitLimits,
    ) -> Vec<CandidatePlane> {
        let right_of = self.begun_from_end();
        let mut left = GrowingBox::empty();
        let mut counts = [0, count];
        let mut planes = Vec::new();
        for (before, bin) in self.bins.iter().zip(1..).take(self.bins.len() - 1) {
            left.merge(&before.ended);
            counts[0] += before.entries as usize;
            counts[1] -= before.exits as usize;
            let added = counts[0] + counts[1] - count;
            if counts.contains(&0) || added > limits.added {
                continue;
            }
            let position = self.planes[bin];
            let is_cutting = added > 0;
            let least = [&left, &right_of[bin]]
                .map(|side| self.least_area(&side.bounds(), is_cutting, position));
            if cost.split(least, counts) < limits.cost {
                planes.push(CandidatePlane {
                    bin,
                    position,
                    counts,
                });
            }
        }
        planes
    }

    /// The least half area of a side, given the box around what lies on it as a
    /// whole: if the plane cuts anything, the side reaches up to the plane.
    fn least_area(&self, whole: &Aabb, is_cutting: bool, plane: f32) -> f64 {
        if whole.is_empty() {
            return 0.0;
        }
        let mut side = *whole;
        if is_cutting {
            let axis = self.axis.index();
            side.min[axis] = side.min[axis].min(plane);
            side.max[axis] = side.max[axis].max(plane);
        }
        side.half_area()
    }

    /// For each bin the box around all that begins in it or after it.
    fn begun_from_end(&self) -> Vec<GrowingBox> {
        united_from_end(self.bins.iter().map(|bin| bin.begun).collect())
    }

    /// For each bin the number of candidate planes before it: the part that it
    /// belongs to.
    fn parts_of_bins(&self, candidates: &[CandidatePlane]) -> Vec<usize> {
        let mut parts = vec![0; self.bins.len()];
        for candidate in candidates {
            parts[candidate.bin] = 1;
        }
        for bin in 1..parts.len() {
            parts[bin] += parts[bin - 1];
        }
        parts
    }
}

impl Bin {
    fn empty() -> Self {
        Self {
            entries: 0,
            exits: 0,
            begun: GrowingBox::empty(),
            ended: GrowingBox::empty(),
        }
    }
}

/// The cheapest of the candidate planes within `limits`; the first of equals.
fn cheapest(
    axis: Axis,
    candidates: &[CandidatePlane],
    parts: &[GrowingBox],
    cost: &NodeCost,
    limits: &SplitLimits,
) -> Option<SpatialCandidate> {
    let right_of = united_from_end(parts.to_vec());
    let mut left = GrowingBox::empty();
    let (mut least, mut best) = (limits.cost, None);
    for (i, candidate) in candidates.iter().enumerate() {
        left.merge(&parts[i]);
        let position = candidate.position;
        // Rounding of the parts must not reach over the plane.
        let bounds = [
            left.bounds().with_range(axis, f32::MIN, position),
            right_of[i + 1]
                .bounds()
                .with_range(axis, position, f32::MAX),
        ];
        let split_cost = cost.split(bounds.each_ref().map(Aabb::half_area), candidate.counts);
        if split_cost < least {
            least = split_cost;
            best = Some(SpatialCandidate {
                axis,
                position,
                cost: split_cost,
                counts: candidate.counts,
                bounds,
            });
        }
    }
    best
}

/// Each box united with all after it.
fn united_from_end(mut boxes: Vec<GrowingBox>) -> Vec<GrowingBox> {
    for i in (1..boxes.len()).rev() {
        let after = boxes[i];
        boxes[i - 1].merge(&after);
    }
    boxes
}

#[cfg(test)]
mod tests {
    use super::*;
    use accel_core::SurfaceAreaHeuristic;
    use accel_core::Triangle;
    use accel_core::reference::Reference;

    use crate::node::Fragments;

    const NO_LIMITS: SplitLimits = SplitLimits {
        cost: f64::INFINITY,
        added: usize::MAX,
    };

    fn node(triangles: &[Triangle]) -> Node {
        let whole = |(id, triangle): (u32, &Triangle)| {
            let bounds = accel_core::Primitive::bounds(triangle).gate();
            Fragment::whole(Reference { bounds, id }, triangles)
        };
        let fragments = (0..).zip(triangles).map(whole).collect();
        Node::new(Fragments::unsorted(fragments), 0, None)
    }

    fn search(triangles: &[Triangle], clipping: CandidateClipping) -> SpatialSearch<'_, Triangle> {
        SpatialSearch {
            primitives: triangles,
            clipping,
            bins: 4,
            bins_per_reference: usize::MAX,
        }
    }

    #[test]
    fn entries_and_exits_are_those_of_figure_3() {
        // Four bins from 0 to 4: one triangle over all, one in the second bin,
        // one that ends on a plane, and a flat one on a plane.
        let at = |low: f32, high: f32| {
            Triangle::new([low, 0.0, 0.0], [high, 1.0, 0.0], [high, 0.0, 1.0])
        };
        let triangles = [at(0.0, 4.0), at(1.25, 1.75), at(1.5, 3.0), at(2.0, 2.0)];
        let node = node(&triangles);
        let mut bins = SpatialBins::new(Axis::X, &node.tight, 4).unwrap();
        let fragments = node.fragments.any_order();
        let counted: Vec<_> = fragments
            .iter()
            .map(|fragment| bins.entry_and_exit(fragment))
            .collect();
        assert_eq!(counted, [[0, 3], [1, 1], [1, 2], [2, 2]]);
        for fragment in fragments {
            bins.count(fragment);
        }
        let counters: Vec<_> = bins
            .bins
            .iter()
            .map(|bin| (bin.entries, bin.exits))
            .collect();
        assert_eq!(counters, [(1, 0), (2, 1), (1, 2), (0, 1)]);
    }

    #[test]
    fn two_crossing_triangles_are_divided_without_overlap() {
        // Figure 2 (d): an object split overlaps, a spatial split does not.
        let triangles = [
            Triangle::new([0.0; 3], [4.0, 4.0, 0.0], [4.0, 4.1, 0.0]),
            Triangle::new([0.0, 4.0, 0.0], [4.0, 0.0, 0.0], [4.0, 0.1, 0.0]),
        ];
        let node = node(&triangles);
        let heuristic = SurfaceAreaHeuristic::default();
        let clipped = search(&triangles, CandidateClipping::Primitives);
        let found = clipped.find(&node, &heuristic, &NO_LIMITS).unwrap();
        assert_eq!((found.axis, found.counts), (Axis::X, [2, 2]));
        assert_eq!(found.bounds[0].max.x, found.position);
        assert_eq!(found.bounds[1].min.x, found.position);
    }

    #[test]
    fn clipping_primitives_gives_tighter_boxes_than_clipping_boxes() {
        let triangles = [
            Triangle::new([0.0; 3], [4.0, 4.0, 0.0], [4.0, 4.1, 0.0]),
            Triangle::new([0.0; 3], [4.0, 4.0, 0.5], [4.0, 4.1, 0.5]),
        ];
        let node = node(&triangles);
        let heuristic = SurfaceAreaHeuristic::default();
        let cost = |clipping| {
            let search = search(&triangles, clipping);
            search.find(&node, &heuristic, &NO_LIMITS).unwrap().cost
        };
        assert!(cost(CandidateClipping::Primitives) < 0.8 * cost(CandidateClipping::Boxes));
    }

    #[test]
    fn an_axis_without_extent_has_no_bins() {
        let flat = Aabb::new([0.0, 0.0, 1.0], [1.0, 1.0, 1.0]);
        assert!(SpatialBins::new(Axis::Z, &flat, 4).is_none());
        assert!(SpatialBins::new(Axis::X, &flat, 4).is_some());
    }
}
