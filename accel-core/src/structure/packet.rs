//! Traversal of several rays at once.

use super::AccelerationStructure;
use crate::query::Query;
use crate::ray::PreparedRay;
use crate::statistics::TraversalStatistics;

/// A structure that traces packets of `N` rays.
///
/// The provided method traces the rays one after the other: it is the reference
/// that faster ones must agree with, bit for bit, and what packets that diverge
/// fall back to.
pub trait PacketTraversal<const N: usize>: AccelerationStructure {
    /// Answers `queries[i]` for `rays[i]`. Lanes without a ray are left alone.
    fn traverse_packet<Q: Query, S: TraversalStatistics>(
        &self,
        rays: &[Option<PreparedRay>; N],
        queries: &mut [Q; N],
        statistics: &mut S,
    ) {
        for (ray, query) in rays.iter().zip(queries) {
            if let Some(ray) = ray {
                self.traverse(ray, query, statistics);
            }
            statistics.finish_ray();
        }
    }
}
