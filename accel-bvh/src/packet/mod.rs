//! Traversal of packets (Wald, Boulos and Shirley 2007, *Ray tracing deformable
//! scenes using dynamic bounding volume hierarchies*, section 4).
//!
//! A packet is one vector of rays, or a group of several. A group goes down the
//! tree as long as any of its rays meets a node, and which do is found out as
//! late as possible:
//!
//! ```text
//! node:  the first vector that met the parent is tested against both children
//!            a ray meets the box:     go in, whatever the others do  (early hit)
//!        bounds of all rays miss it:  leave it                       (early miss)
//!        otherwise test the other vectors until one meets it
//!        put the child that most rays of the vector enter later off, go to the other
//! leaf:  the rays of each vector, from the first on, that meet its box
//! one ray left of a vector, or of the last of a group: it goes on alone
//! ```
//!
//! A vector that missed a node misses everything in it, so the search for the
//! first one goes on where it ended at the parent.
//!
//! Rays whose directions differ in sign go different ways: a group of them falls
//! apart into vectors, and a vector into single rays.

mod cull;
mod group;

use accel_core::Primitive;
use accel_core::query::Query;
use accel_core::ray::PacketRay;
use accel_core::simd::Lanes;
use accel_core::statistics::TraversalStatistics;
use accel_core::structure::VectorTraversal;

use crate::Bvh;

impl<P: Primitive> VectorTraversal for Bvh<P> {
    #[inline(always)]
    fn traverse_vectors<L: Lanes, Q, S, const VECTORS: usize>(
        &self,
        rays: &[PacketRay],
        queries: &mut [Q],
        statistics: &mut S,
    ) where
        Q: Query,
        S: TraversalStatistics,
    {
        if group::trace::<L, P, Q, S, VECTORS>(self, rays, queries, statistics) {
            return;
        }
        for (rays, queries) in rays.chunks(L::COUNT).zip(queries.chunks_mut(L::COUNT)) {
            let is_tried = VECTORS == 1;
            if is_tried || !group::trace::<L, P, Q, S, 1>(self, rays, queries, statistics) {
                self.traverse_each(rays, queries, statistics);
            }
        }
    }
}
