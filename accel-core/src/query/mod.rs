//! What a caller wants to know of a ray, and what it gets.

mod all_hits;
mod any_hit;
mod closest_hit;
mod filtered;

use std::ops::ControlFlow;

pub use all_hits::AllHits;
pub use any_hit::AnyHit;
pub use closest_hit::ClosestHit;
pub use filtered::Filtered;

/// A primitive hit by a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The ray parameter, in lengths of the ray's direction.
    pub t: f32,
    /// First surface coordinate; for a triangle, the weight of its second corner.
    pub u: f32,
    /// Second surface coordinate; for a triangle, the weight of its third corner.
    pub v: f32,
    /// The primitive's position in the slice that the structure was built over.
    pub id: u32,
}

impl Hit {
    /// Whether this hit comes before `other`: by `t`, then by id, so that ties
    /// never depend on a tree.
    #[inline]
    pub fn precedes(&self, other: &Self) -> bool {
        self.t < other.t || (self.t == other.t && self.id < other.id)
    }
}

/// Receives the hits that a traversal finds. The traversal is written once and
/// serves every query.
///
/// A query must accept the same hit offered again (a primitive may stand in
/// several leaves), and hits in any order.
pub trait Query {
    /// Hits beyond this `t` can't matter any more: nothing farther is visited
    /// or offered. May shrink from offer to offer, never grow.
    fn t_max(&self) -> f32;

    /// Takes a hit with `t <= t_max()`; breaks when no further hit can change
    /// the answer.
    fn offer(&mut self, hit: &Hit) -> ControlFlow<()>;
}
