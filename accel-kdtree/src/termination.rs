//! When a node becomes a leaf.

use accel_core::BuildError;

/// When a node becomes a leaf, besides at the depth and reference limits of
/// [`KdTreeBuilder`](crate::KdTreeBuilder).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Termination {
    /// Where no split is cheaper than a leaf (Wald and Havran 2006, section 3.3).
    Automatic,
    /// As `Automatic`, but up to `allowed` splits in a row from the root to a
    /// leaf may be dearer than leaves, in hope of cheaper ones below; none that
    /// is more than four times as dear in a node of fewer than 16 primitives
    /// (Pharr, Jakob and Humphreys, *Physically Based Rendering*).
    BadRefines {
        /// How many, at least 1.
        allowed: u32,
    },
    /// At this many primitives, whatever splits would cost. Nodes that no plane
    /// divides become leaves as well.
    Manual {
        /// The most primitives that a leaf holds where planes can help it.
        max_leaf_size: usize,
    },
}

impl Termination {
    pub(crate) fn validate(&self) -> Result<(), BuildError> {
        if *self == (Self::BadRefines { allowed: 0 }) {
            return Err(BuildError::InvalidSetting {
                setting: "allowed",
                value: "0".into(),
                allowed: "1 or more",
            });
        }
        Ok(())
    }

    /// Whether `count` primitives make a leaf before any plane is weighed.
    pub(crate) fn is_leaf(&self, count: usize) -> bool {
        match *self {
            Self::Manual { max_leaf_size } => count <= max_leaf_size,
            _ => count == 0,
        }
    }

    /// Whether to split at this cost, and the number of bad refines then;
    /// `bad_refines` is the number above.
    pub(crate) fn accepts(
        &self,
        cost: f64,
        leaf_cost: f64,
        count: usize,
        bad_refines: u32,
    ) -> Option<u32> {
        let is_good = cost < leaf_cost;
        match *self {
            Self::Automatic => is_good.then_some(0),
            Self::Manual { .. } => Some(0),
            Self::BadRefines { .. } if is_good => Some(bad_refines),
            Self::BadRefines { allowed } => {
                let is_hopeless = cost > 4.0 * leaf_cost && count < 16;
                (!is_hopeless && bad_refines < allowed).then_some(bad_refines + 1)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_refines_are_counted_and_used_up() {
        let rule = Termination::BadRefines { allowed: 2 };
        assert_eq!(rule.accepts(1.0, 2.0, 9, 1), Some(1));
        assert_eq!(rule.accepts(2.0, 2.0, 9, 1), Some(2));
        assert_eq!(rule.accepts(2.0, 2.0, 9, 2), None);
        assert_eq!(rule.accepts(9.0, 2.0, 9, 0), None);
        assert_eq!(rule.accepts(9.0, 2.0, 16, 0), Some(1));
    }

    #[test]
    fn automatic_termination_splits_only_where_that_is_cheaper() {
        let rule = Termination::Automatic;
        assert_eq!(rule.accepts(1.9, 2.0, 9, 0), Some(0));
        assert_eq!(rule.accepts(2.0, 2.0, 9, 0), None);
        assert!(rule.is_leaf(0) && !rule.is_leaf(1));
    }

    #[test]
    fn manual_termination_goes_by_size_alone() {
        let rule = Termination::Manual { max_leaf_size: 4 };
        assert!(rule.is_leaf(4) && !rule.is_leaf(5));
        assert_eq!(rule.accepts(9e9, 1.0, 5, 0), Some(0));
    }
}
