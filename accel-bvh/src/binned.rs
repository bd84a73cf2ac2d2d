//! The binned search: cuts between bins of equal width only.
//!
//! ```text
//! node:  count the references into bins along each axis, by their centres
//!        weigh the cuts between bins
//!        partition the references by the bin that the winner starts with
//! ```

use std::marker::PhantomData;

use accel_core::Aabb;
use accel_core::build::{Division, TopDown, join};
use accel_core::reference::{Reference, bounds_of, centers_of};
use accel_core::split::binning::{BinCut, Bins, MAX_BINS};
use accel_core::split::partition;

use crate::ChildBounds;
use crate::node_rules::NodeRules;

/// Larger sets are counted into bins in parallel.
const PARALLEL_BINNING: usize = 1 << 15;

/// The references of a node.
pub(crate) struct BinnedTask<'a> {
    references: &'a mut [Reference],
    bounds: Aabb,
    /// The box around the centres of the references' boxes.
    centers: Aabb,
}

/// The strategy, over references that live for `'a`.
pub(crate) struct BinnedSearch<'a> {
    rules: NodeRules,
    bins: usize,
    memory: PhantomData<fn(&'a ())>,
}

impl BinnedSearch<'_> {
    pub(crate) fn new(rules: NodeRules, bins: usize) -> Self {
        Self {
            rules,
            bins,
            memory: PhantomData,
        }
    }

    /// The cheapest cut, with fewer bins for small nodes, where handling them
    /// costs more than it finds.
    fn cheapest_cut(&self, task: &BinnedTask<'_>) -> Option<BinCut> {
        let bins = self.bins.min(4 + task.references.len() / 20);
        match bins {
            0..=8 => self.cheapest_cut_of::<8>(task, bins),
            9..=16 => self.cheapest_cut_of::<16>(task, bins),
            _ => self.cheapest_cut_of::<MAX_BINS>(task, bins),
        }
    }

    fn cheapest_cut_of<const N: usize>(
        &self,
        task: &BinnedTask<'_>,
        bins: usize,
    ) -> Option<BinCut> {
        let mut bins = Bins::<N>::new(&task.centers, bins);
        fill(&mut bins, task.references);
        bins.cheapest_cut(task.bounds.half_area(), &self.rules.heuristic)
    }
}

impl<'a> BinnedTask<'a> {
    pub(crate) const BYTES_PER_REFERENCE: usize = size_of::<Reference>();

    pub(crate) fn new(references: &'a mut [Reference], bounds: Aabb) -> Self {
        let centers = centers_of(references);
        Self {
            references,
            bounds,
            centers,
        }
    }

    fn halves(self, position: usize, bounds: Option<[Aabb; 2]>) -> [Self; 2] {
        let (left, right) = self.references.split_at_mut(position);
        let [left_bounds, right_bounds] =
            bounds.unwrap_or_else(|| [bounds_of(left), bounds_of(right)]);
        [Self::new(left, left_bounds), Self::new(right, right_bounds)]
    }
}

impl<'a> TopDown for BinnedSearch<'a> {
    type Task = BinnedTask<'a>;
    type Node = ChildBounds;

    fn size(&self, task: &BinnedTask<'a>) -> usize {
        task.references.len()
    }

    fn divide(&self, task: BinnedTask<'a>, depth: u32, leaf: &mut Vec<u32>) -> Division<Self> {
        match self.children(task, depth) {
            Err(task) => {
                leaf.extend(task.references.iter().map(|reference| reference.id));
                Division::Leaf
            }
            Ok(children) => Division::Inner {
                node: ChildBounds(children.each_ref().map(|child| child.bounds)),
                children,
            },
        }
    }
}

impl<'a> BinnedSearch<'a> {
    /// The two halves of a task, or the task itself if it is a leaf.
    fn children(
        &self,
        task: BinnedTask<'a>,
        depth: u32,
    ) -> Result<[BinnedTask<'a>; 2], BinnedTask<'a>> {
        let count = task.references.len();
        if self.rules.ends_before_search(count, depth) {
            return Err(task);
        }
        let halve = |task: BinnedTask<'a>| {
            let (_, position) = partition::at_median(task.references, &task.centers);
            Ok(task.halves(position, None))
        };
        if self.rules.must_halve(depth) {
            return halve(task);
        }
        match self.cheapest_cut(&task) {
            Some(cut) if self.rules.prefers_leaf(count, cut.cost) => Err(task),
            Some(cut) => {
                let is_left = |reference: &Reference| cut.boundary.is_left(reference);
                let position = partition::in_place(task.references, is_left);
                Ok(task.halves(position, Some(cut.bounds)))
            }
            // All centres coincide: no cut is better than any other.
            None if self.rules.prefers_leaf(count, f64::INFINITY) => Err(task),
            None => halve(task),
        }
    }
}

/// Counting is exact and the bins' boxes are minima and maxima, so the halves
/// can be counted apart without changing the result.
fn fill<const N: usize>(bins: &mut Bins<N>, references: &[Reference]) {
    if references.len() < PARALLEL_BINNING {
        bins.fill(references);
        return;
    }
    let (left, right) = references.split_at(references.len() / 2);
    let mut others = bins.clone();
    join(|| fill(bins, left), || fill(&mut others, right));
    bins.merge(&others);
}
