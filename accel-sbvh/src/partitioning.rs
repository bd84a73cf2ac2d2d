//! The partitioning of one node, in the three steps of Stich 2009, section 4.1.

use accel_bvh::{NodeRules, ObjectSplit};
use accel_core::Clip;

use crate::fragment::overlap;
use crate::node::Node;
use crate::object_split::ObjectCandidate;
use crate::spatial_split::{Divisor, SpatialCandidate, SpatialSearch, SplitLimits};

/// What is decided alike for all nodes.
#[derive(Debug)]
pub(crate) struct Partitioning<'a, P> {
    pub rules: NodeRules,
    pub object_split: ObjectSplit,
    pub spatial: SpatialSearch<'a, P>,
    pub divisor: Divisor<'a, P>,
    /// The overlap above which a spatial split is attempted, as half an area:
    /// alpha times that of the root (section 4.5).
    pub tolerated_overlap: f64,
}

/// What becomes of a node.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Choice {
    Leaf,
    /// Neither the node nor any below it can attempt a spatial split.
    ObjectSplitsOnly,
    Object(ObjectCandidate),
    /// The object split is the one to fall back on.
    Spatial(SpatialCandidate, ObjectCandidate),
}

/// A choice, and whether a spatial split was attempted for it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chosen {
    pub choice: Choice,
    pub is_attempt: bool,
}

impl<P: Clip> Partitioning<'_, P> {
    /// Decides about a node that may add `spare` references.
    pub(crate) fn choose(&self, node: &Node, spare: usize) -> Chosen {
        let without_attempt = |choice| Chosen {
            choice,
            is_attempt: false,
        };
        let count = node.count();
        if self.rules.ends_before_search(count, node.depth) {
            return without_attempt(Choice::Leaf);
        }
        // The overlap of two boxes is no larger than the box around them.
        let cannot_attempt = spare == 0 || node.tight.half_area() <= self.tolerated_overlap;
        if cannot_attempt || self.rules.must_halve(node.depth) {
            return without_attempt(Choice::ObjectSplitsOnly);
        }
        let object = ObjectCandidate::find(node, self.object_split, &self.rules.heuristic);
        let is_attempt = overlap(&object.bounds) > self.tolerated_overlap;
        let spatial = if is_attempt {
            let limits = SplitLimits {
                cost: object.cost,
                added: spare,
            };
            self.spatial.find(node, &self.rules.heuristic, &limits)
        } else {
            None
        };
        Chosen {
            choice: self.winner(count, object, spatial),
            is_attempt,
        }
    }

    /// Step 3: the cheaper candidate, if a leaf is not cheaper still. A spatial
    /// candidate is only found where it is cheaper than the object candidate.
    fn winner(
        &self,
        count: usize,
        object: ObjectCandidate,
        spatial: Option<SpatialCandidate>,
    ) -> Choice {
        match spatial {
            Some(spatial) if self.rules.prefers_leaf(count, spatial.cost) => Choice::Leaf,
            Some(spatial) => Choice::Spatial(spatial, object),
            None => self.without_spatial_split(count, object),
        }
    }

    /// What becomes of a node whose spatial split is not to be.
    pub(crate) fn without_spatial_split(&self, count: usize, object: ObjectCandidate) -> Choice {
        if self.rules.prefers_leaf(count, object.cost) {
            Choice::Leaf
        } else {
            Choice::Object(object)
        }
    }
}
