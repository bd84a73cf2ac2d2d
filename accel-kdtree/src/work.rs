//! What a build did, counted: growth is judged by it, not by time.

/// How much a build did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Comparisons: of events while they are sorted, merged and swept, of parts
    /// with planes, and of parts with bins.
    pub comparisons: u64,
    /// References that splits created beyond one for each primitive.
    pub references_created: u64,
}
