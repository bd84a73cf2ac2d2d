//! Step 2 of the partitioning: the spatial split candidate (Stich 2009, sections
//! 4.1 and 4.2).

mod bins;
mod division;

use accel_core::build::join;
use accel_core::geometry::Axis;
use accel_core::{Aabb, Clip, SurfaceAreaHeuristic};

use crate::node::Node;
use crate::object_split::PARALLEL_SEARCH;

pub(crate) use division::{Division, Divisor};

/// How the references of a spatial split candidate are clipped against the bins
/// (section 4.2). Once a split is chosen, primitives are clipped in any case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CandidateClipping {
    /// Primitives: the boxes of bins are tight.
    #[default]
    Primitives,
    /// The boxes of references only: quicker to build, not as good.
    Boxes,
}

/// A division of a node's references by a plane, those that it cuts going to
/// both sides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpatialCandidate {
    pub axis: Axis,
    pub position: f32,
    /// The expected cost of the node, divided so, without unsplitting.
    pub cost: f64,
    /// References on both sides, cut ones on both.
    pub counts: [usize; 2],
    /// The tight boxes of both sides.
    pub bounds: [Aabb; 2],
}

/// What a spatial split must keep to be of use.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SplitLimits {
    /// It costs less than this.
    pub cost: f64,
    /// It adds no more references than this.
    pub added: usize,
}

/// The search for spatial splits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpatialSearch<'a, P> {
    pub primitives: &'a [P],
    pub clipping: CandidateClipping,
    /// The most bins along an axis.
    pub bins: usize,
    /// No more bins than this for each reference of a node.
    pub bins_per_reference: usize,
}

impl<P: Clip> SpatialSearch<'_, P> {
    /// The cheapest plane between two bins of any axis that leaves references on
    /// both sides and is within `limits`; `None` if there is none.
    pub(crate) fn find(
        &self,
        node: &Node,
        heuristic: &SurfaceAreaHeuristic,
        limits: &SplitLimits,
    ) -> Option<SpatialCandidate> {
        let cost = heuristic.of_node(node.tight.half_area(), node.count());
        let along = |axis| self.cheapest_along(axis, node, &cost, limits);
        let [x, y, z] = Axis::ALL;
        let candidates = if node.count() >= PARALLEL_SEARCH {
            let (x, (y, z)) = join(|| along(x), || join(|| along(y), || along(z)));
            [x, y, z]
        } else {
            [x, y, z].map(along)
        };
        // The first of equals, whatever the order of computation.
        candidates
            .into_iter()
            .flatten()
            .reduce(|best, other| if other.cost < best.cost { other } else { best })
    }
}
