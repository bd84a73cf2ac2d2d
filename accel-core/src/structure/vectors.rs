//! From vectors of rays to packets of any number.

use super::{AccelerationStructure, PacketTraversal};
use crate::query::Query;
use crate::ray::PacketRay;
use crate::simd::{F32x4, InstructionSet, Lanes, SimdLevel, SimdWork};
use crate::statistics::TraversalStatistics;

/// Vectors in a group.
const GROUP: usize = 8;

/// A structure that traces rays in vectors of lanes: all that it needs to trace
/// packets of any number. Up to 4, 8 and 16 rays are one vector of so many lanes;
/// more go in groups of 64, eight vectors of eight lanes.
pub trait VectorTraversal: AccelerationStructure {
    /// Answers `queries[i]` for `rays[i]`, of which there are no more than
    /// `VECTORS` vectors have lanes.
    ///
    /// It must be `#[inline(always)]`, so that it uses the vectors of the machine.
    fn traverse_vectors<L: Lanes, Q, S, const VECTORS: usize>(
        &self,
        rays: &[PacketRay],
        queries: &mut [Q],
        statistics: &mut S,
    ) where
        Q: Query,
        S: TraversalStatistics;

    /// Answers `queries[i]` for `rays[i]` one after the other: in a call of its
    /// own, compiled as for single rays.
    #[inline(never)]
    fn traverse_each<Q: Query, S: TraversalStatistics>(
        &self,
        rays: &[PacketRay],
        queries: &mut [Q],
        statistics: &mut S,
    ) {
        for (ray, query) in rays.iter().zip(queries) {
            if let Some(ray) = ray.prepared() {
                self.traverse(ray, query, statistics);
            }
        }
    }
}

impl<A: VectorTraversal, const N: usize> PacketTraversal<N> for A {
    #[inline]
    fn traverse_packet_at<Q: Query, S: TraversalStatistics>(
        &self,
        level: SimdLevel,
        rays: &[PacketRay],
        queries: &mut [Q],
        statistics: &mut S,
    ) {
        assert_eq!(rays.len(), queries.len(), "one query per ray");
        level.run(TracePacket::<_, _, _, N> {
            structure: self,
            rays,
            queries,
            statistics,
        });
    }
}

struct TracePacket<'a, A, Q, S, const N: usize> {
    structure: &'a A,
    rays: &'a [PacketRay],
    queries: &'a mut [Q],
    statistics: &'a mut S,
}

impl<A, Q, S, const N: usize> SimdWork for TracePacket<'_, A, Q, S, N>
where
    A: VectorTraversal,
    Q: Query,
    S: TraversalStatistics,
{
    type Output = ();

    #[inline(always)]
    fn run<I: InstructionSet>(self) {
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

impl<A: VectorTraversal, Q: Query, S: TraversalStatistics, const N: usize>
    TracePacket<'_, A, Q, S, N>
{
    #[inline(always)]
    fn trace<L: Lanes, const VECTORS: usize>(self) {
        let size = VECTORS * L::COUNT;
        for (rays, queries) in self.rays.chunks(size).zip(self.queries.chunks_mut(size)) {
            let structure = self.structure;
            structure.traverse_vectors::<L, Q, S, VECTORS>(rays, queries, self.statistics);
            (0..rays.len()).for_each(|_| self.statistics.finish_ray());
        }
    }
}
