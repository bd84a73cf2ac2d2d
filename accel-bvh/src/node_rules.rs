//! What all searches decide alike.

use accel_core::SurfaceAreaHeuristic;
use accel_core::build::median_depth;

use crate::{BvhBuilder, LeafRule};

/// When to stop, and when to give up on the heuristic: the decisions that every
/// search makes alike, whatever it searches.
#[derive(Clone, Copy, Debug)]
pub struct NodeRules {
    /// The costs that splits are weighed by.
    pub heuristic: SurfaceAreaHeuristic,
    leaf_rule: LeafRule,
    max_depth: u32,
    median_depth: u32,
}

impl NodeRules {
    /// The rules that a builder's settings make for a tree over this many
    /// references.
    pub fn new(builder: &BvhBuilder, references: usize) -> Self {
        Self {
            heuristic: builder.heuristic,
            leaf_rule: builder.leaf_rule,
            max_depth: builder.budget.max_depth,
            median_depth: median_depth(references),
        }
    }

    /// The same rules for a tree whose leaves are put together afterwards: with
    /// as few references in each as the leaf rule allows.
    pub(crate) fn with_fine_leaves(mut self) -> Self {
        if let LeafRule::SahUpTo(_) = self.leaf_rule {
            self.leaf_rule = LeafRule::StopAt(1);
        }
        self
    }

    /// The most edges from the root to a leaf.
    pub(crate) fn max_depth(&self) -> u32 {
        self.max_depth
    }

    /// Whether a node is a leaf without looking for a split.
    #[inline]
    pub fn ends_before_search(&self, count: usize, depth: u32) -> bool {
        depth >= self.max_depth || count <= 1 || self.leaf_rule.ends_before_search(count)
    }

    /// Whether a node this deep must be halved, to bound the depth.
    #[inline]
    pub fn must_halve(&self, depth: u32) -> bool {
        depth >= self.median_depth
    }

    /// Whether a node is a leaf rather than being split at this cost.
    #[inline]
    pub fn prefers_leaf(&self, count: usize, split_cost: f64) -> bool {
        self.leaf_rule
            .prefers_leaf(count, split_cost, &self.heuristic)
    }
}
