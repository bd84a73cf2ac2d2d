//! The best plane to split a node by (Ize 2008, sections 3.3 to 3.5).
//!
//! ```text
//! axis-aligned planes tangent to the pieces: counts from sorted ends
//! planes of the primitives:                  counts from the sphere hierarchy
//! a candidate whose counts alone are too dear is dropped; areas decide the rest
//! best by the linear C_BSP, if it beats the leaf; else best by the fixed one
//! ```

use accel_core::build::join;
use accel_core::geometry::Axis;
use accel_core::{BuildObserver, Polygonal};

use crate::allowance::Allowance;
use crate::builder::BspBuilder;
use crate::candidates::{Neighbors, RELATIVE_PLACEMENT, planes_of};
use crate::ends::Ends;
use crate::pieces::{Counts, Pieces};
use crate::polytope::Polytope;
use crate::sphere_hierarchy::SphereHierarchy;
use crate::split_plane::SplitPlane;

/// The most that the slack of an axis-aligned plane follows large primitives,
/// relative to the extent of what the node holds.
const LARGEST_SLACK: f64 = 1.0 / 4096.0;

/// How many candidates are weighed before the observer is asked again whether the build
/// is cancelled.
const CANDIDATES_PER_QUESTION: usize = 64;

/// How many planes are made before they are weighed.
const PLANES_AT_ONCE: usize = 1 << 12;

/// How many tests of planes against pieces are worth a task of their own.
const TESTS_OF_A_TASK: usize = 1 << 18;

/// A split, and what it costs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Split {
    pub plane: SplitPlane,
    pub planar_in_front: bool,
    /// What visiting the node costs.
    pub visit: f64,
    cost: f64,
}

/// The splits worth carrying out, best first.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Splits {
    linear: Option<Split>,
    fixed: Option<Split>,
    axis_aligned: Option<Split>,
}

impl Splits {
    /// Those cheaper than a leaf, in the order to try them: where the best one's
    /// plane cuts the cell badly, the best axis-aligned one.
    pub(crate) fn cheaper_than(self, leaf_cost: f64) -> impl Iterator<Item = Split> {
        let worthwhile = move |split: &Split| split.cost < leaf_cost;
        let best = self
            .linear
            .filter(worthwhile)
            .or(self.fixed.filter(worthwhile));
        best.into_iter().chain(self.axis_aligned.filter(worthwhile))
    }

    /// Of these and later ones the best, the earlier of equals.
    fn keep_cheaper(&mut self, later: Self) {
        let kinds = [
            (&mut self.linear, later.linear),
            (&mut self.fixed, later.fixed),
            (&mut self.axis_aligned, later.axis_aligned),
        ];
        for (best, later) in kinds {
            if let Some(split) = later {
                keep_cheaper(best, split);
            }
        }
    }
}

/// The search in one node.
pub(crate) struct Search<'a, P> {
    builder: &'a BspBuilder,
    primitives: &'a [P],
    pieces: &'a Pieces,
    cell: &'a Polytope,
    /// What is left of it; every candidate takes one.
    allowance: Allowance,
    observer: &'a dyn BuildObserver,
    best: Splits,
    distances: Vec<f64>,
}

impl<'a, P: Polygonal> Search<'a, P> {
    pub(crate) fn new(
        builder: &'a BspBuilder,
        primitives: &'a [P],
        pieces: &'a Pieces,
        cell: &'a Polytope,
        allowance: Allowance,
        observer: &'a dyn BuildObserver,
    ) -> Self {
        Self {
            builder,
            primitives,
            pieces,
            cell,
            allowance,
            observer,
            best: Splits::default(),
            distances: Vec::new(),
        }
    }

    /// The best splits, and how many candidates are left to others.
    pub(crate) fn run(mut self) -> (Splits, usize) {
        let [low, high] = self.pieces.bounds();
        let extent = (high - low).max_element();
        let local = self.builder.epsilon * extent;
        let placement = RELATIVE_PLACEMENT * low.abs().max(high.abs()).max_element();
        // A piece ends at a plane only if the slack covers its pad, and that of a large
        // primitive exceeds what suits a small node.
        let touching = (1.25 * self.pieces.largest_pad()).min(LARGEST_SLACK * extent);
        for axis in Axis::ALL {
            self.sweep(axis, local.max(placement).max(touching));
        }
        let candidates = self.builder.candidate_planes;
        if candidates
            .general
            .are_tried(self.pieces.len(), || self.gain())
        {
            self.try_general(local);
        }
        (self.best, self.allowance.candidates)
    }

    /// What part of the cost of a leaf the best plane so far saves.
    fn gain(&self) -> f64 {
        let best = self.best.linear;
        best.map_or(0.0, |split| 1.0 - split.cost / self.leaf_cost())
    }

    /// Weighs the planes of the primitives.
    fn try_general(&mut self, local: f64) {
        let hierarchy = SphereHierarchy::new(self.pieces);
        let neighbors = Neighbors {
            primitives: self.primitives,
            pieces: self.pieces,
            stride: self.stride(),
            slack: local,
        };
        let ids = self.pieces.ids().iter().step_by(neighbors.stride);
        let primitives = ids.map(|&id| &self.primitives[id as usize]);
        let own = primitives.flat_map(|primitive| planes_of(primitive, local));
        let common = self.builder.candidate_planes.of_neighbors(&neighbors);
        let mut planes = own.chain(common);
        loop {
            let count = self.allowance.candidates.min(PLANES_AT_ONCE);
            let some: Vec<SplitPlane> = planes.by_ref().take(count).collect();
            if some.is_empty() {
                return;
            }
            self.allowance.candidates -= some.len();
            self.weigh_each(&some, &hierarchy);
        }
    }

    /// Weighs planes, many of them on all cores: the first of the cheapest is kept. What
    /// is halved follows from the counts, so that the choice is the same for any number
    /// of threads.
    fn weigh_each(&mut self, planes: &[SplitPlane], hierarchy: &SphereHierarchy<'_>) {
        let tests = planes.len().saturating_mul(self.pieces.len());
        if planes.len() > 1 && tests > TESTS_OF_A_TASK {
            let (first, second) = planes.split_at(planes.len() / 2);
            let mut other = self.with_the_same_best();
            join(
                || self.weigh_each(first, hierarchy),
                || other.weigh_each(second, hierarchy),
            );
            return self.best.keep_cheaper(other.best);
        }
        for planes in planes.chunks(CANDIDATES_PER_QUESTION) {
            if self.observer.is_cancelled() {
                return;
            }
            for plane in planes {
                let counts = hierarchy.count(plane, |counts| self.may_pay(plane, counts));
                if let Some(counts) = counts {
                    self.weigh(plane, counts);
                }
            }
        }
    }

    fn with_the_same_best(&self) -> Self {
        Self {
            distances: Vec::new(),
            ..*self
        }
    }

    /// Every how many pieces one offers its planes. In the largest nodes fewer
    /// than asked for do, so that planes that every piece is near cost no more
    /// than a constant in all.
    fn stride(&self) -> usize {
        const MOST_TESTS: usize = 1 << 22;
        let count = self.pieces.len();
        match self.builder.sampled_primitives {
            Some(limit) => count.div_ceil(limit.min(MOST_TESTS / count).max(1)),
            None => 1,
        }
    }

    /// Weighs the planes tangent to the pieces on one axis.
    fn sweep(&mut self, axis: Axis, slack: f64) {
        let ends = Ends::new(self.pieces, axis, slack);
        for position in ends.positions() {
            if !self.takes_candidate() {
                return;
            }
            let plane = SplitPlane::axis_aligned(axis, position, slack);
            let counts = ends.count(f64::from(position));
            if self.builder.axis_aligned_nodes {
                self.weigh(&plane, counts);
            } else if let Some(plane) = plane.generalised() {
                self.weigh(&plane, counts);
            }
        }
    }

    /// Takes one candidate from the allowance, if any is left and the build goes on.
    fn takes_candidate(&mut self) -> bool {
        let left = self.allowance.candidates.checked_sub(1);
        self.allowance.candidates = left.unwrap_or(0);
        let asks = self
            .allowance
            .candidates
            .is_multiple_of(CANDIDATES_PER_QUESTION);
        left.is_some() && !(asks && self.observer.is_cancelled())
    }

    /// Whether a plane with at least these counts on its sides can be the best, by
    /// the counts alone: both parts have together at least the area of the whole.
    fn may_pay(&self, plane: &SplitPlane, counts: &Counts) -> bool {
        let smaller_side = counts.straddling + counts.behind.min(counts.in_front);
        let least = self.builder.costs.intersection * smaller_side as f64;
        counts.straddling <= self.allowance.duplicates && self.may_improve(plane, least)
    }

    /// What visiting the node costs, linear and fixed.
    fn visit_costs(&self, plane: &SplitPlane) -> [f64; 2] {
        let costs = &self.builder.costs;
        match plane.axis() {
            Some(_) => [costs.axis_aligned; 2],
            None => [costs.linear_general(self.pieces.len()), costs.general],
        }
    }

    /// Keeps the plane if it is the best so far, planar pieces going where it is
    /// cheaper.
    fn weigh(&mut self, plane: &SplitPlane, counts: Counts) {
        if !self.may_pay(plane, &counts) {
            return;
        }
        let costs = &self.builder.costs;
        let [linear, fixed] = self.visit_costs(plane);
        let behind = counts.behind + counts.straddling;
        let in_front = counts.in_front + counts.straddling;
        let is_on_plane = counts.planar > 0;
        let reach = self.builder.reach();
        let areas = (self.cell).split_areas(plane, reach, is_on_plane, &mut self.distances);
        let Some(areas) = areas else { return };
        for planar_in_front in [false, true] {
            if planar_in_front && counts.planar == 0 {
                continue;
            }
            let mut sides = [behind, in_front];
            sides[usize::from(planar_in_front)] += counts.planar;
            let node = (self.cell.area(), self.pieces.len());
            let children = costs.of_children(node, areas, sides);
            let split = |visit| Split {
                plane: *plane,
                planar_in_front,
                visit,
                cost: visit + children,
            };
            keep_cheaper(&mut self.best.linear, split(linear));
            keep_cheaper(&mut self.best.fixed, split(fixed));
            if plane.axis().is_some() {
                keep_cheaper(&mut self.best.axis_aligned, split(fixed));
            }
        }
    }

    /// Whether a plane whose children cost at least so much can be the best. The
    /// fixed cost is of interest only while the linear one finds nothing.
    fn may_improve(&self, plane: &SplitPlane, children: f64) -> bool {
        let improves =
            |best: &Option<Split>, visit: f64| best.is_none_or(|best| visit + children < best.cost);
        let [linear, fixed] = self.visit_costs(plane);
        let needs_fixed = self
            .best
            .linear
            .is_none_or(|best| best.cost >= self.leaf_cost());
        improves(&self.best.linear, linear)
            || (needs_fixed && improves(&self.best.fixed, fixed))
            || (plane.axis().is_some() && improves(&self.best.axis_aligned, fixed))
    }

    fn leaf_cost(&self) -> f64 {
        let heuristic = self.builder.costs.heuristic(0.0);
        heuristic.leaf_cost(self.pieces.len())
    }
}

fn keep_cheaper(best: &mut Option<Split>, split: Split) {
    if best.is_none_or(|best| split.cost < best.cost) {
        *best = Some(split);
    }
}
