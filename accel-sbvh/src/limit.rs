//! How many references a tree may have, and where they are spent.

use accel_bvh::{INNER_NODE_BYTES, LEAF_NODE_BYTES};
use accel_core::BuildError;
use accel_core::layout::MAX_PRIMITIVES;

/// The most references that a tree may have: a hard limit (Stich 2009, section
/// 6.1). Never below one a primitive; primitives that are skipped don't count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReferenceLimit {
    /// As many as spatial splits make: many times the number of primitives where
    /// long ones cross each other, and more the fewer of them leaves may hold.
    /// [`BuildBudget::max_bytes`](accel_core::BuildBudget::max_bytes) holds all
    /// the same.
    Unlimited,
    /// This many times the number of primitives; finite and at least 1.
    Factor(f64),
    /// This many.
    Count(usize),
    /// As many as surely fit a tree of this many bytes, nodes, ids and stored
    /// primitives together: a bound on memory known before the build, in the
    /// way of Waechter and Keller 2007.
    TreeBytes(usize),
}

impl Default for ReferenceLimit {
    /// Two a primitive: spent by benefit, these gain nearly all that there is to
    /// gain in an atrium, rotated or not. Scenes of long primitives that cross each
    /// other everywhere gain from more, and ask for many times as many.
    fn default() -> Self {
        Self::Factor(2.0)
    }
}

impl ReferenceLimit {
    pub(crate) fn validate(&self) -> Result<(), BuildError> {
        match *self {
            // The negated range rejects NaN as well.
            Self::Factor(factor) if !(1.0..f64::INFINITY).contains(&factor) => {
                Err(BuildError::InvalidSetting {
                    setting: "limit",
                    value: format!("{self:?}"),
                    allowed: "a finite factor of at least 1",
                })
            }
            _ => Ok(()),
        }
    }

    /// How many references a tree over `primitives` valid ones, of this many bytes
    /// each, may have.
    ///
    /// # Errors
    /// [`BuildError::BudgetExceeded`] if not even one a primitive is allowed.
    pub fn references(
        &self,
        primitives: usize,
        primitive_bytes: usize,
    ) -> Result<usize, BuildError> {
        let (what, needed, limit, references) = match *self {
            Self::Unlimited => ("references", primitives, usize::MAX, MAX_PRIMITIVES),
            Self::Factor(factor) => {
                let references = (primitives as f64 * factor) as usize;
                ("references", primitives, references, references)
            }
            Self::Count(count) => ("references", primitives, count, count),
            Self::TreeBytes(bytes) => {
                let each = bytes_per_reference(primitive_bytes);
                (
                    "bytes",
                    primitives.saturating_mul(each),
                    bytes,
                    bytes / each,
                )
            }
        };
        if references < primitives {
            return Err(BuildError::BudgetExceeded {
                what,
                needed,
                limit,
            });
        }
        Ok(references.min(MAX_PRIMITIVES))
    }
}

/// The most that a reference adds to a tree: a leaf and an inner node of its
/// own, an id, a copy of the primitive and its place.
fn bytes_per_reference(primitive_bytes: usize) -> usize {
    INNER_NODE_BYTES + LEAF_NODE_BYTES + primitive_bytes + 2 * size_of::<u32>()
}

/// Which spatial splits are made where the limit does not allow all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spending {
    /// Those that save the most expected cost for each reference they add,
    /// wherever in the tree.
    #[default]
    ByBenefit,
    /// Level by level from the root, until the limit is reached: the simple
    /// scheme of Stich 2009, section 6.1.
    BreadthFirst,
    /// Every child gets a share in proportion to its references, and spends it
    /// on its own (Waechter and Keller 2007). Subtrees that need more than their
    /// share go without while others leave theirs unspent.
    Shares,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_counts_and_never_below_one_a_primitive() {
        let references = |limit: ReferenceLimit| limit.references(1000, 36);
        assert_eq!(references(ReferenceLimit::Factor(1.25)), Ok(1250));
        assert_eq!(references(ReferenceLimit::Count(1000)), Ok(1000));
        assert_eq!(references(ReferenceLimit::TreeBytes(110_000)), Ok(1100));
        assert_eq!(references(ReferenceLimit::Unlimited), Ok(MAX_PRIMITIVES));
        let error = references(ReferenceLimit::Count(999)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the build would take 1000 references, over the budget of 999"
        );
        let error = references(ReferenceLimit::TreeBytes(99_999)).unwrap_err();
        assert!(error.to_string().contains("100000 bytes"), "{error}");
    }

    #[test]
    fn factors_that_no_tree_can_keep_are_refused() {
        for factor in [0.99, f64::NAN, f64::INFINITY, -1.0] {
            assert!(ReferenceLimit::Factor(factor).validate().is_err());
        }
        assert!(ReferenceLimit::Factor(1.0).validate().is_ok());
    }
}
