//! What can be wrong with the words of a tree.

use accel_core::archive::LoadError;

/// Why a saved tree was not loaded.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PlaneTreeLoadError {
    /// The archive is not sound.
    #[error(transparent)]
    Archive(#[from] LoadError),
    /// The words of its nodes are not those of a tree.
    #[error("the archive holds no tree of this kind: {0}")]
    Words(#[from] WordsError),
}

/// What is wrong with the words of a tree that come from elsewhere.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum WordsError {
    /// A header means nothing.
    #[error("the node at word {position} has the header {code:06b}, which is not in use")]
    UnusedCode {
        /// The node's first word.
        position: usize,
        /// The six bits.
        code: u32,
    },
    /// A node is of a kind that this tree does not have.
    #[error("the node at word {position} has the header {code:06b}, of a node of other trees")]
    ForeignNode {
        /// The node's first word.
        position: usize,
        /// The six bits.
        code: u32,
    },
    /// A node reaches over the end.
    #[error("the node at word {position} reaches over the end of the {words} words")]
    BeyondEnd {
        /// The node's first word.
        position: usize,
        /// How many words there are.
        words: usize,
    },
    /// An offset leads to the node itself.
    #[error("the node at word {position} has its first child at offset {offset}, inside itself")]
    NotForward {
        /// The node's first word.
        position: usize,
        /// The offset, in words.
        offset: usize,
    },
    /// A plane is no number.
    #[error("the node at word {position} has a plane that is not a number")]
    NanPlane {
        /// The node's first word.
        position: usize,
    },
    /// Two nodes share words.
    #[error("two nodes share word {position}")]
    Shared {
        /// The first word that they share.
        position: usize,
    },
    /// A first child has another size than its parent says.
    #[error("the node at word {position} has {actual} words, but its parent says {recorded}")]
    ChildSize {
        /// The child's first word.
        position: usize,
        /// Its words.
        actual: usize,
        /// Its words by its parent.
        recorded: usize,
    },
    /// A path has more splitting nodes than traversal has room for.
    #[error("a path has {depth} splitting nodes; at most {limit} are allowed")]
    TooDeep {
        /// Splitting nodes on the path.
        depth: u32,
        /// The limit.
        limit: u32,
    },
    /// There is no leaf of this number.
    #[error("the node at word {position} names leaf {leaf}, which there is not")]
    UnknownLeaf {
        /// The node's first word.
        position: usize,
        /// The leaf.
        leaf: usize,
    },
}
