//! What a build did.

use std::ops::AddAssign;

/// What the build of an SBVH did (Stich 2009, Table 1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SplitStatistics {
    /// Primitives in the tree.
    pub primitives: usize,
    /// References to them in all leaves.
    pub references: usize,
    /// Nodes for which a spatial split was searched: those whose best object
    /// split overlaps enough (section 4.5).
    pub spatial_split_attempts: usize,
    /// Nodes divided by a spatial split.
    pub spatial_splits: usize,
    /// References that a spatial split's plane cuts, but that went to one side
    /// whole (section 4.4).
    pub unsplits: usize,
    /// Nodes whose spatial split was found, but would have exceeded the limit
    /// when its turn came.
    pub refused_splits: usize,
}

impl SplitStatistics {
    /// References in percent of the primitives: 100 where none is duplicated.
    pub fn reference_percentage(&self) -> f64 {
        if self.primitives == 0 {
            return 100.0;
        }
        100.0 * self.references as f64 / self.primitives as f64
    }
}

impl AddAssign for SplitStatistics {
    fn add_assign(&mut self, other: Self) {
        self.primitives += other.primitives;
        self.references += other.references;
        self.spatial_split_attempts += other.spatial_split_attempts;
        self.spatial_splits += other.spatial_splits;
        self.unsplits += other.unsplits;
        self.refused_splits += other.refused_splits;
    }
}
