//! When a node becomes a leaf.

use accel_core::{BuildError, SurfaceAreaHeuristic};

/// When a node becomes a leaf. The papers differ, and trees are only comparable
/// under one rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeafRule {
    /// Split until a node holds this many references or fewer, whatever it
    /// costs (Stich 2009, section 5, with 8).
    StopAt(usize),
    /// Split until a leaf is no dearer than the best split, and in any case
    /// while a node holds more references than this (Lin 2019, section 5, with
    /// 8).
    SahUpTo(usize),
}

impl Default for LeafRule {
    fn default() -> Self {
        Self::SahUpTo(8)
    }
}

impl LeafRule {
    /// Checks the size.
    ///
    /// # Errors
    /// [`BuildError::InvalidSetting`] for a size of 0.
    pub fn validate(&self) -> Result<(), BuildError> {
        let (Self::StopAt(size) | Self::SahUpTo(size)) = self;
        if *size == 0 {
            return Err(BuildError::InvalidSetting {
                setting: "leaf_rule",
                value: format!("{self:?}"),
                allowed: "a size of at least 1",
            });
        }
        Ok(())
    }

    /// Whether a node of `count` references is a leaf without looking for a
    /// split.
    #[inline]
    pub fn ends_before_search(&self, count: usize) -> bool {
        match *self {
            Self::StopAt(size) => count <= size,
            Self::SahUpTo(_) => count <= 1,
        }
    }

    /// Whether a node of `count` references is a leaf rather than being split
    /// at `split_cost`.
    #[inline]
    pub fn prefers_leaf(
        &self,
        count: usize,
        split_cost: f64,
        heuristic: &SurfaceAreaHeuristic,
    ) -> bool {
        match *self {
            Self::StopAt(_) => false,
            Self::SahUpTo(size) => count <= size && heuristic.leaf_cost(count) <= split_cost,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rules_differ_below_their_size() {
        let heuristic = SurfaceAreaHeuristic::default();
        assert!(LeafRule::StopAt(8).ends_before_search(8));
        assert!(!LeafRule::SahUpTo(8).ends_before_search(8));
        assert!(LeafRule::SahUpTo(8).prefers_leaf(3, 3.0, &heuristic));
        assert!(!LeafRule::SahUpTo(8).prefers_leaf(3, 2.9, &heuristic));
        assert!(!LeafRule::SahUpTo(8).prefers_leaf(9, 100.0, &heuristic));
        assert!(LeafRule::StopAt(0).validate().is_err());
    }
}
