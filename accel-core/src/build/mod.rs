//! What builders share: settings, budgets, progress, and the recursion.

mod budget;
mod observer;
mod parallel;
mod recursion;
mod tree;

pub use budget::{BuildBudget, median_depth, share_by_size};
pub use observer::BuildObserver;
pub use parallel::{join, map_each};
pub use recursion::{Division, TopDown, build_top_down};
pub use tree::{BuildNode, BuildTree, Cursor};

/// What to do with primitives whose bounds are not finite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InvalidPrimitives {
    /// Refuse to build, naming the first of them.
    #[default]
    Reject,
    /// Leave them out: they are never hit, all others keep their ids, and the
    /// structure tells how many were left out.
    Skip,
}
