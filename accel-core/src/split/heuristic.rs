//! The surface area heuristic.

use crate::error::BuildError;

/// The surface area heuristic (SAH): the expected cost of a ray through a node
/// is what the node costs itself plus what its children cost, each weighted by
/// the probability, a ratio of areas, that the ray meets it (Goldsmith and
/// Salmon 1987; MacDonald and Booth 1990; Stich 2009, section 2.1).
///
/// Works on areas, not on boxes, so that it serves boxes and polytopes alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceAreaHeuristic {
    /// The cost of visiting an inner node, C_t. Only its ratio to
    /// `intersection_cost` matters. Finite and at least 0.
    pub traversal_cost: f64,
    /// The cost of testing one primitive, C_i. Finite and above 0.
    pub intersection_cost: f64,
}

impl Default for SurfaceAreaHeuristic {
    /// Both costs 1, as in Lin 2019, section 5.
    fn default() -> Self {
        Self {
            traversal_cost: 1.0,
            intersection_cost: 1.0,
        }
    }
}

impl SurfaceAreaHeuristic {
    /// Checks that both costs are usable.
    ///
    /// # Errors
    /// [`BuildError::InvalidSetting`] names the cost that is not.
    pub fn validate(&self) -> Result<(), BuildError> {
        let reject = |setting, value: f64, allowed| {
            Err(BuildError::InvalidSetting {
                setting,
                value: value.to_string(),
                allowed,
            })
        };
        // The negated ranges reject NaN as well.
        if !(0.0..f64::INFINITY).contains(&self.traversal_cost) {
            return reject(
                "traversal_cost",
                self.traversal_cost,
                "a finite number, 0 or more",
            );
        }
        if self.intersection_cost <= 0.0 || !self.intersection_cost.is_finite() {
            return reject(
                "intersection_cost",
                self.intersection_cost,
                "a finite number above 0",
            );
        }
        Ok(())
    }

    /// The probability that a random line through the parent meets the child.
    /// A parent without area is met by nothing or by everything: then 1.
    #[inline]
    pub fn probability(child_area: f64, parent_area: f64) -> f64 {
        if parent_area > 0.0 {
            (child_area / parent_area).min(1.0)
        } else {
            1.0
        }
    }

    /// The cost of testing `references` primitives one after the other.
    #[inline]
    pub fn leaf_cost(&self, references: usize) -> f64 {
        self.intersection_cost * references as f64
    }

    /// The costs of all splits of a node of `count` references and this half
    /// area.
    #[inline]
    pub fn of_node(&self, parent_area: f64, count: usize) -> NodeCost {
        if parent_area > 0.0 {
            NodeCost {
                base: self.traversal_cost,
                per_area: self.intersection_cost / parent_area,
            }
        } else {
            // Every child is met with probability 1.
            NodeCost {
                base: self.traversal_cost + self.leaf_cost(count),
                per_area: 0.0,
            }
        }
    }
}

/// The heuristic for one node, its division by the node's area done once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeCost {
    base: f64,
    per_area: f64,
}

impl NodeCost {
    /// The expected cost of the node if its children have these half areas and
    /// numbers of references:
    /// `C_t + SA(B_1) / SA(B) |P_1| C_i + SA(B_2) / SA(B) |P_2| C_i`.
    #[inline]
    pub fn split(&self, areas: [f64; 2], counts: [usize; 2]) -> f64 {
        let weighted = areas[0] * counts[0] as f64 + areas[1] * counts[1] as f64;
        self.base + weighted * self.per_area
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cost_is_that_worked_out_by_hand() {
        let heuristic = SurfaceAreaHeuristic {
            traversal_cost: 1.5,
            intersection_cost: 2.0,
        };
        let cost = heuristic.of_node(8.0, 8).split([4.0, 6.0], [3, 5]);
        assert_eq!(cost, 1.5 + 0.5 * 3.0 * 2.0 + 0.75 * 5.0 * 2.0);
        assert_eq!(heuristic.leaf_cost(8), 16.0);
    }

    #[test]
    fn a_parent_without_area_gives_probability_one_not_nan() {
        assert_eq!(SurfaceAreaHeuristic::probability(0.0, 0.0), 1.0);
        assert_eq!(SurfaceAreaHeuristic::probability(3.0, 2.0), 1.0);
        let cost = SurfaceAreaHeuristic::default().of_node(0.0, 5);
        assert_eq!(cost.split([0.0, 0.0], [2, 3]), 6.0);
    }

    #[test]
    fn unusable_costs_are_named() {
        for (traversal_cost, intersection_cost, name) in [
            (-1.0, 1.0, "traversal_cost"),
            (f64::NAN, 1.0, "traversal_cost"),
            (1.0, 0.0, "intersection_cost"),
            (1.0, f64::INFINITY, "intersection_cost"),
        ] {
            let heuristic = SurfaceAreaHeuristic {
                traversal_cost,
                intersection_cost,
            };
            let message = heuristic.validate().unwrap_err().to_string();
            assert!(message.contains(name), "{message}");
        }
        assert!(SurfaceAreaHeuristic::default().validate().is_ok());
    }
}
