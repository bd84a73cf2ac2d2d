//! Carrying a spatial split out, with reference unsplitting (Stich 2009, section
//! 4.4).

use accel_core::{Aabb, Clip};

use super::SpatialCandidate;
use crate::fragment::{Fragment, FragmentSide};
use crate::node::{Node, Placement};

/// What carries spatial splits out.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Divisor<'a, P> {
    pub primitives: &'a [P],
    /// Whether references that the plane cuts may go to one side whole.
    pub unsplitting: bool,
}

/// A node divided by a spatial split.
#[derive(Debug)]
pub(crate) struct Division {
    pub children: [Node; 2],
    /// References that went to both sides.
    pub duplicated: usize,
    /// References cut by the plane that went to one side whole.
    pub unsplits: usize,
}

/// The two sides while references that the plane cuts are distributed.
struct Sides {
    bounds: [Aabb; 2],
    /// References on each side, those still to be distributed on both.
    counts: [usize; 2],
    /// The fragments that take the place of those that the plane cuts.
    parts: [Vec<Fragment>; 2],
    unsplits: usize,
}

impl<P: Clip> Divisor<'_, P> {
    /// Divides the node, or gives it back where all references would end up on
    /// one side.
    pub(crate) fn divide(
        &self,
        node: Node,
        candidate: &SpatialCandidate,
    ) -> Result<Division, Node> {
        let SpatialCandidate { axis, position, .. } = *candidate;
        let mut sides = Sides {
            bounds: candidate.bounds,
            counts: candidate.counts,
            parts: [Vec::new(), Vec::new()],
            unsplits: 0,
        };
        let fragments = node.fragments.any_order();
        let is_cut =
            |fragment: &&Fragment| fragment.side(axis, position) == FragmentSide::Straddling;
        for fragment in fragments.iter().filter(is_cut) {
            self.distribute(fragment, candidate, &mut sides);
        }
        let duplicated = sides.counts[0] + sides.counts[1] - fragments.len();
        if sides.counts.contains(&0) {
            return Err(node);
        }
        let place = |fragment: &Fragment| match fragment.side(axis, position) {
            FragmentSide::Left => Placement::Left,
            FragmentSide::Right => Placement::Right,
            FragmentSide::Straddling => Placement::Replaced,
        };
        let allowance = node.allowance.map(|allowance| allowance - duplicated);
        let halves = node.fragments.divide(place, sides.parts);
        Ok(Division {
            children: Node::children(halves, node.depth, allowance),
            duplicated,
            unsplits: sides.unsplits,
        })
    }

    fn distribute(&self, fragment: &Fragment, candidate: &SpatialCandidate, sides: &mut Sides) {
        if self.unsplitting
            && let Some(side) = sides.cheaper_whole(&fragment.tight)
        {
            sides.unsplits += 1;
            return sides.add_whole(*fragment, side);
        }
        match fragment.split(self.primitives, candidate.axis, candidate.position) {
            [Some(left), Some(right)] => {
                sides.parts[0].push(left);
                sides.parts[1].push(right);
            }
            // Within rounding nothing lies on the other side. The fragment stays
            // whole, so that nothing at all is lost.
            [Some(_), None] => sides.add_whole(*fragment, 0),
            [None, _] => sides.add_whole(*fragment, 1),
        }
    }
}

impl Sides {
    /// The side that a fragment with the tight box `part` should go to whole,
    /// if that costs no more than splitting it. The box of the other side is
    /// not recomputed, so the costs are estimated high.
    fn cheaper_whole(&self, part: &Aabb) -> Option<usize> {
        let areas = self.bounds.each_ref().map(Aabb::half_area);
        let grown = |side: usize| self.bounds[side].union(part).half_area();
        let [n_1, n_2] = self.counts.map(|count| count as f64);
        let c_split = areas[0] * n_1 + areas[1] * n_2;
        let c_1 = grown(0) * n_1 + areas[1] * (n_2 - 1.0);
        let c_2 = areas[0] * (n_1 - 1.0) + grown(1) * n_2;
        // A side that would lose its last reference keeps it.
        let allowed = |cost: f64, other: usize| cost <= c_split && self.counts[other] > 1;
        match (allowed(c_1, 1), allowed(c_2, 0)) {
            (true, true) if c_2 < c_1 => Some(1),
            (true, _) => Some(0),
            (false, true) => Some(1),
            (false, false) => None,
        }
    }

    fn add_whole(&mut self, fragment: Fragment, side: usize) {
        self.bounds[side] = self.bounds[side].union(&fragment.tight);
        self.counts[1 - side] -= 1;
        self.parts[side].push(fragment);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sides(counts: [usize; 2]) -> Sides {
        Sides {
            bounds: [
                Aabb::new([0.0; 3], [1.0; 3]),
                Aabb::new([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]),
            ],
            counts,
            parts: [Vec::new(), Vec::new()],
            unsplits: 0,
        }
    }

    #[test]
    fn the_cheapest_of_the_three_costs_wins() {
        // Half areas are 3 and 3. A reference that reaches 0.1 into the left
        // costs: split 3 * 10 + 3 * 10, left whole 5 * 10 + 3 * 9, right whole
        // 3 * 9 + 3.2 * 10.
        let reaching = Aabb::new([0.9, 0.0, 0.0], [2.0, 1.0, 1.0]);
        assert_eq!(sides([10, 10]).cheaper_whole(&reaching), Some(1));
        // Reaching far into both, it is split.
        let large = Aabb::new([0.0; 3], [2.0, 1.0, 1.0]);
        assert_eq!(sides([10, 10]).cheaper_whole(&large), None);
    }

    #[test]
    fn no_side_loses_its_last_reference() {
        let reaching = Aabb::new([0.9, 0.0, 0.0], [2.0, 1.0, 1.0]);
        assert_eq!(sides([1, 1]).cheaper_whole(&reaching), None);
        assert_eq!(sides([1, 10]).cheaper_whole(&reaching), Some(0));
    }
}
