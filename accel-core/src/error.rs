//! What can go wrong, each error naming the item, its value and the limit.

use crate::geometry::Aabb;

/// Why a structure was not built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// A primitive has no finite bounds.
    #[error(
        "primitive {id} has no finite bounds (min {}, max {}): remove it, or build with \
         `invalid_primitives: Skip`",
        bounds.min, bounds.max
    )]
    InvalidPrimitive {
        /// Its position in the input.
        id: u32,
        /// Its bounds.
        bounds: Aabb,
    },
    /// There are more primitives than ids.
    #[error("{count} primitives are more than the {limit} that 31-bit ids can tell apart")]
    TooManyPrimitives {
        /// How many there are.
        count: usize,
        /// How many there may be.
        limit: usize,
    },
    /// A setting is out of its range.
    #[error("setting `{setting}` is {value}; it must be {allowed}")]
    InvalidSetting {
        /// The field's name.
        setting: &'static str,
        /// What it was set to.
        value: String,
        /// What it may be.
        allowed: &'static str,
    },
    /// The structure would exceed a budget.
    #[error("the build would take {needed} {what}, over the budget of {limit}")]
    BudgetExceeded {
        /// What is limited: "bytes", "references", "nodes".
        what: &'static str,
        /// How much the build needs, or would need at most.
        needed: usize,
        /// The budget.
        limit: usize,
    },
    /// The tree does not fit the offsets of its nodes.
    #[error("the tree needs offset {needed} in its nodes, but the layout reaches only {limit}")]
    OffsetOverflow {
        /// The offset that was needed, in units of the layout.
        needed: usize,
        /// The largest one.
        limit: usize,
    },
    /// The observer asked to stop.
    #[error("the build was cancelled")]
    Cancelled,
}

/// Why a structure was not refitted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RefitError {
    /// The slice is not the one built over.
    #[error("refit was given {given} primitives; the structure was built over {expected}")]
    CountMismatch {
        /// Primitives given.
        given: usize,
        /// Primitives at the build.
        expected: usize,
    },
    /// A primitive has lost its finite bounds.
    #[error("primitive {id} has no finite bounds any more (min {}, max {})", bounds.min, bounds.max)]
    InvalidPrimitive {
        /// Its position in the input.
        id: u32,
        /// Its bounds.
        bounds: Aabb,
    },
}

/// What is wrong with a tree: found by its `validate`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ValidationError {
    /// A child reaches out of its parent's box.
    #[error("node {node} reaches out of its parent's box")]
    NotEnclosed {
        /// The child's position in the tree's outline.
        node: usize,
    },
    /// A leaf's box does not enclose a primitive referenced there.
    #[error("leaf {node} does not enclose primitive {id}")]
    PrimitiveNotEnclosed {
        /// The leaf's position in the tree's outline.
        node: usize,
        /// The primitive.
        id: u32,
    },
    /// A primitive stands in no leaf, or in too many.
    #[error("primitive {id} is referenced {count} times")]
    ReferenceCount {
        /// The primitive.
        id: u32,
        /// How many references there are to it.
        count: usize,
    },
    /// Primitives were lost, or some that were skipped are referenced.
    #[error("{unreferenced} primitives stand in no leaf, but {skipped} were skipped")]
    Unreferenced {
        /// How many stand in no leaf.
        unreferenced: usize,
        /// How many the build left out.
        skipped: usize,
    },
    /// A leaf holds nothing.
    #[error("leaf {node} is empty")]
    EmptyLeaf {
        /// The leaf's position in the tree's outline.
        node: usize,
    },
    /// The recorded depth, from which stacks are sized, is wrong.
    #[error("the tree has depth {actual}, but {recorded} is recorded")]
    DepthMismatch {
        /// The depth found.
        actual: u32,
        /// The depth recorded.
        recorded: u32,
    },
}
