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

use accel_core::layout::LeafStorage;
use accel_core::query::Query;
use accel_core::simd::{F32x4, InstructionSet, Lanes, SimdWork};
use accel_core::statistics::TraversalStatistics;
use accel_core::{PreparedRay, Primitive};

use crate::Bvh;
use crate::traversal::traverse;

/// Vectors in a group.
const GROUP: usize = 8;

/// A packet of `N` rays, to be traced with the vectors of the machine.
pub(crate) struct TracePacket<'a, P: Primitive, Q, S, const N: usize> {
    pub bvh: &'a Bvh<P>,
    pub rays: &'a [Option<PreparedRay>; N],
    pub queries: &'a mut [Q; N],
    pub statistics: &'a mut S,
}

impl<P: Primitive, Q: Query, S: TraversalStatistics, const N: usize> SimdWork
    for TracePacket<'_, P, Q, S, N>
{
    type Output = ();

    #[inline(always)]
    fn run<I: InstructionSet>(mut self) {
        if N <= 4 {
            self.trace::<F32x4, 1>();
        } else if N <= 8 {
            self.trace::<I::Eight, 1>();
        } else if N <= 16 {
            self.trace::<I::Sixteen, 1>();
        } else {
            self.trace::<I::Eight, GROUP>();
        }
    }
}

impl<P: Primitive, Q: Query, S: TraversalStatistics, const N: usize> TracePacket<'_, P, Q, S, N> {
    #[inline(always)]
    fn trace<L: Lanes, const VECTORS: usize>(&mut self) {
        let size = VECTORS * L::COUNT;
        for (rays, queries) in self.rays.chunks(size).zip(self.queries.chunks_mut(size)) {
            let count = rays.iter().flatten().count();
            if count > 0 {
                trace_or_divide::<L, P, Q, S, VECTORS>(self.bvh, rays, queries, self.statistics);
            }
            (0..count).for_each(|_| self.statistics.finish_ray());
        }
    }
}

/// Traces a packet; one whose directions differ in sign falls apart, a group
/// into its vectors, a vector into its rays.
#[inline(always)]
fn trace_or_divide<L: Lanes, P, Q, S, const VECTORS: usize>(
    bvh: &Bvh<P>,
    rays: &[Option<PreparedRay>],
    queries: &mut [Q],
    statistics: &mut S,
) where
    P: Primitive,
    Q: Query,
    S: TraversalStatistics,
{
    if group::trace::<L, P, Q, S, VECTORS>(bvh, rays, queries, statistics) {
        return;
    }
    for (rays, queries) in rays.chunks(L::COUNT).zip(queries.chunks_mut(L::COUNT)) {
        let is_tried = VECTORS == 1 || rays.iter().all(Option::is_none);
        if is_tried || !group::trace::<L, P, Q, S, 1>(bvh, rays, queries, statistics) {
            trace_alone(bvh, rays, queries, statistics);
        }
    }
}

/// Ray by ray, in a call of its own, compiled as for single rays.
#[inline(never)]
fn trace_alone<P: Primitive, Q: Query, S: TraversalStatistics>(
    bvh: &Bvh<P>,
    rays: &[Option<PreparedRay>],
    queries: &mut [Q],
    statistics: &mut S,
) {
    for (ray, query) in rays.iter().zip(queries) {
        if let Some(ray) = ray {
            traverse(bvh, ray, query, statistics);
        }
    }
}

/// Tests one leaf for the rays of `mask`.
#[inline(always)]
fn intersect_leaf<L: Lanes, P: Primitive, Q: Query, S: TraversalStatistics>(
    bvh: &Bvh<P>,
    leaf: u32,
    mask: u32,
    mut rays: accel_core::ray::PacketVector<'_, L>,
    queries: &mut [Q],
    statistics: &mut S,
) {
    let leaves = bvh.stored.leaves();
    leaves.intersect_leaf_packet(leaf, mask, &mut rays, queries, statistics);
}
