//! A query that ignores some hits.

use std::ops::ControlFlow;

use super::{Hit, Query};

/// Offers only hits that pass a filter: alpha test, skip the primitive that a
/// ray starts on, masks, backface culling.
///
/// The filter must be pure: it may see the same hit several times, in any
/// order, and hits that are not the closest.
#[derive(Clone, Debug)]
pub struct Filtered<Q, F> {
    query: Q,
    filter: F,
}

impl<Q: Query, F: Fn(&Hit) -> bool> Filtered<Q, F> {
    /// `query` for the hits for which `filter` is true.
    pub fn new(query: Q, filter: F) -> Self {
        Self { query, filter }
    }

    /// The query with what it has seen.
    pub fn into_inner(self) -> Q {
        self.query
    }
}

impl<Q: Query, F: Fn(&Hit) -> bool> Query for Filtered<Q, F> {
    #[inline]
    fn t_max(&self) -> f32 {
        self.query.t_max()
    }

    #[inline]
    fn offer(&mut self, hit: &Hit) -> ControlFlow<()> {
        if (self.filter)(hit) {
            self.query.offer(hit)
        } else {
            ControlFlow::Continue(())
        }
    }
}
