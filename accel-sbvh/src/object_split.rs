//! Step 1 of the partitioning: the object split candidate (Stich 2009, section
//! 4.1).

use accel_bvh::ObjectSplit;
use accel_core::build::join;
use accel_core::geometry::Axis;
use accel_core::reference::{Reference, SortKey, centers_of};
use accel_core::split::binning::{Bins, Boundary, MAX_BINS};
use accel_core::split::{SplitCandidate, keep_better, sweep};
use accel_core::{Aabb, SurfaceAreaHeuristic};

use crate::fragment::{Fragment, tight_bounds_of};
use crate::node::{Node, Placement};

/// Nodes of at least this many references are searched along all axes at once.
pub(crate) const PARALLEL_SEARCH: usize = 1 << 13;

/// A division of a node's references that duplicates none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ObjectCandidate {
    cut: ObjectCut,
    /// The expected cost of the node, divided so, from tight boxes.
    pub cost: f64,
    /// The tight boxes of both sides.
    pub bounds: [Aabb; 2],
}

/// What goes left.
#[derive(Clone, Copy, Debug)]
enum ObjectCut {
    /// References before this one in the order along an axis.
    Order(Axis, SortKey),
    /// References in bins before a boundary.
    Bins(Boundary),
}

impl ObjectCut {
    fn is_left(&self, reference: &Reference) -> bool {
        match self {
            Self::Order(axis, first_right) => reference.key(*axis) < *first_right,
            Self::Bins(boundary) => boundary.is_left(reference),
        }
    }
}

impl ObjectCandidate {
    /// The best object split of a node of at least two references.
    pub(crate) fn find(
        node: &Node,
        object_split: ObjectSplit,
        heuristic: &SurfaceAreaHeuristic,
    ) -> Self {
        let cut = match object_split {
            ObjectSplit::FullSweep => swept(node, heuristic),
            ObjectSplit::Binned { bins } => binned(node, bins, heuristic),
        };
        Self::new(node, cut.unwrap_or_else(|| median(node)), heuristic)
    }

    fn new(node: &Node, cut: ObjectCut, heuristic: &SurfaceAreaHeuristic) -> Self {
        let fragments = node.fragments.any_order();
        let side =
            |is_left: bool| move |fragment: &&Fragment| cut.is_left(&fragment.reference) == is_left;
        let bounds =
            [true, false].map(|is_left| tight_bounds_of(fragments.iter().filter(side(is_left))));
        let left = fragments.iter().filter(side(true)).count();
        let counts = [left, fragments.len() - left];
        let areas = bounds.each_ref().map(Aabb::half_area);
        let node_cost = heuristic.of_node(node.tight.half_area(), fragments.len());
        Self {
            cut,
            cost: node_cost.split(areas, counts),
            bounds,
        }
    }

    /// Divides the node.
    pub(crate) fn carry_out(&self, node: Node) -> [Node; 2] {
        let place = |fragment: &Fragment| {
            if self.cut.is_left(&fragment.reference) {
                Placement::Left
            } else {
                Placement::Right
            }
        };
        let halves = node.fragments.divide(place, [Vec::new(), Vec::new()]);
        Node::children(halves, node.depth, node.allowance)
    }
}

fn swept(node: &Node, heuristic: &SurfaceAreaHeuristic) -> Option<ObjectCut> {
    let parent_area = node.bounds.half_area();
    let along = |axis| {
        let order = node.fragments.along(axis)?;
        let mut areas = vec![0.0; order.len()];
        sweep::cheapest_cut(order, axis, parent_area, heuristic, &mut areas)
    };
    let [x, y, z] = Axis::ALL;
    let candidates = if node.count() >= PARALLEL_SEARCH {
        let (x, (y, z)) = join(|| along(x), || join(|| along(y), || along(z)));
        [x, y, z]
    } else {
        [x, y, z].map(along)
    };
    let mut best: Option<SplitCandidate<usize>> = None;
    for candidate in candidates.into_iter().flatten() {
        keep_better(&mut best, candidate);
    }
    let SplitCandidate { axis, position, .. } = best?;
    let first_right = node.fragments.along(axis)?[position].reference.key(axis);
    Some(ObjectCut::Order(axis, first_right))
}

fn binned(node: &Node, bins: usize, heuristic: &SurfaceAreaHeuristic) -> Option<ObjectCut> {
    let fragments = node.fragments.any_order();
    let mut counted = Bins::<MAX_BINS>::new(&centers_of(fragments), bins);
    counted.fill(fragments);
    let cut = counted.cheapest_cut(node.bounds.half_area(), heuristic)?;
    Some(ObjectCut::Bins(cut.boundary))
}

/// Half of the references on each side: for those that no search can tell apart.
fn median(node: &Node) -> ObjectCut {
    let fragments = node.fragments.any_order();
    let axis = centers_of(fragments).widest_axis();
    let mut keys: Vec<SortKey> = fragments
        .iter()
        .map(|fragment| fragment.reference.key(axis))
        .collect();
    let middle = keys.len() / 2;
    let (_, key, _) = keys.select_nth_unstable(middle);
    ObjectCut::Order(axis, *key)
}
