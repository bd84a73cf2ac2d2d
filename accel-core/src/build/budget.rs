//! Limits on what a build may use.

use crate::error::BuildError;

/// Limits on what a build may use, checked before memory is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildBudget {
    /// The most bytes that the build may hold at once, working memory included;
    /// `None` for no limit. Builders that split primitives add fewer references, to stay
    /// within it. Over it the build ends with [`BuildError::BudgetExceeded`].
    pub max_bytes: Option<usize>,
    /// The most edges from the root to a leaf, 0 to [`Self::DEEPEST`]. Nodes at
    /// this depth become leaves, however many references they hold.
    pub max_depth: u32,
}

impl BuildBudget {
    /// The deepest tree that traversal stacks are made for.
    pub const DEEPEST: u32 = 120;

    /// Checks the settings.
    ///
    /// # Errors
    /// [`BuildError::InvalidSetting`] for a depth beyond [`Self::DEEPEST`].
    pub fn validate(&self) -> Result<(), BuildError> {
        if self.max_depth > Self::DEEPEST {
            return Err(BuildError::InvalidSetting {
                setting: "max_depth",
                value: self.max_depth.to_string(),
                allowed: "at most 120",
            });
        }
        Ok(())
    }

    /// Checks that `needed` bytes may be taken.
    ///
    /// # Errors
    /// [`BuildError::BudgetExceeded`] names both figures.
    pub fn check_bytes(&self, needed: usize) -> Result<(), BuildError> {
        match self.max_bytes {
            Some(limit) if needed > limit => Err(BuildError::BudgetExceeded {
                what: "bytes",
                needed,
                limit,
            }),
            _ => Ok(()),
        }
    }
}

impl Default for BuildBudget {
    fn default() -> Self {
        Self {
            max_bytes: None,
            max_depth: Self::DEEPEST,
        }
    }
}

/// The depth, `2 log2 n + 16`, beyond which a builder should split at the median
/// whatever the heuristic says: sizes in a geometric series make it peel off a
/// few references per level, which would cost quadratic time.
pub fn median_depth(references: usize) -> u32 {
    2 * references.max(1).ilog2() + 16
}

/// Divides what is left of a budget among two subtrees of these sizes, in
/// proportion: so that it is never exceeded, and what each may take does not
/// depend on which is built first.
pub fn share_by_size(left: usize, sizes: [usize; 2]) -> [usize; 2] {
    let total = (sizes[0] as u128 + sizes[1] as u128).max(1);
    // A share is at most `left`, which fits.
    sizes.map(|size| (left as u128 * size as u128 / total) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_proportional_and_never_more_than_what_is_left() {
        assert_eq!(share_by_size(10, [1, 4]), [2, 8]);
        assert_eq!(share_by_size(5, [1, 1]), [2, 2]);
        assert_eq!(share_by_size(7, [0, 0]), [0, 0]);
        assert_eq!(share_by_size(usize::MAX, [usize::MAX, 0]), [usize::MAX, 0]);
    }
}
