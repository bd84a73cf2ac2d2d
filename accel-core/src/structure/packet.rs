//! Traversal of several rays at once.

use arrayvec::ArrayVec;

use super::{AccelerationStructure, for_each_batch};
use crate::query::{AllHits, AnyHit, ClosestHit, Hit, Query};
use crate::ray::{PacketRay, Ray};
use crate::simd::SimdLevel;
use crate::statistics::TraversalStatistics;

/// A structure that traces packets of `N` rays.
///
/// The provided traversal traces the rays one after the other: it is the
/// reference that faster ones must agree with, bit for bit, and what packets
/// that diverge fall back to.
///
/// Statistics count what a packet does once, whatever the number of its rays:
/// divided by the rays, nodes are those visited per ray.
pub trait PacketTraversal<const N: usize>: AccelerationStructure {
    /// Answers `queries[i]` for `rays[i]`, of which there are at most `N`, with
    /// the vectors of `level`. The queries of rays that can hit nothing are left
    /// as they are.
    ///
    /// # Panics
    /// If there are not as many queries as rays.
    fn traverse_packet_at<Q: Query, S: TraversalStatistics>(
        &self,
        level: SimdLevel,
        rays: &[PacketRay],
        queries: &mut [Q],
        statistics: &mut S,
    ) {
        let _ = level;
        assert_eq!(rays.len(), queries.len(), "one query per ray");
        for (ray, query) in rays.iter().zip(queries) {
            if let Some(ray) = ray.prepared() {
                self.traverse(ray, query, statistics);
            }
            statistics.finish_ray();
        }
    }

    /// As [`traverse_packet_at`](Self::traverse_packet_at), with the widest
    /// vectors of this machine.
    #[inline]
    fn traverse_packet<Q: Query, S: TraversalStatistics>(
        &self,
        rays: &[PacketRay],
        queries: &mut [Q],
        statistics: &mut S,
    ) {
        self.traverse_packet_at(SimdLevel::detect(), rays, queries, statistics);
    }

    /// Cuts `rays` into packets and gives `answer` the index and the answered
    /// query of each. `query` makes them; that of a ray that can hit nothing stays
    /// as it was made.
    ///
    /// Packets pay where neighbours in the slice are neighbours in the scene, as
    /// the rays of a tile of pixels are. Any others are answered as well.
    #[inline]
    fn query_packets<R: Ray, Q: Query, S: TraversalStatistics>(
        &self,
        level: SimdLevel,
        rays: &[R],
        statistics: &mut S,
        query: impl Fn(&R) -> Q,
        mut answer: impl FnMut(usize, Q),
    ) {
        // In the same place for all packets, so that nothing is moved.
        let mut packet: ArrayVec<PacketRay, N> = ArrayVec::new();
        let mut queries: ArrayVec<Q, N> = ArrayVec::new();
        for (index, rays) in rays.chunks(N).enumerate() {
            packet.clear();
            packet.extend(rays.iter().map(PacketRay::new));
            queries.extend(rays.iter().map(&query));
            self.traverse_packet_at(level, &packet, &mut queries, statistics);
            for (lane, query) in queries.drain(..).enumerate() {
                answer(index * N + lane, query);
            }
        }
    }

    /// The closest hits of many rays, as
    /// [`closest_hits`](AccelerationStructure::closest_hits) gives them, packet
    /// by packet, on all cores.
    fn closest_hits_packet<R: Ray + Sync>(&self, rays: &[R]) -> Vec<Option<Hit>> {
        let mut hits = vec![None; rays.len()];
        for_each_batch(rays, &mut hits, &|rays, hits| {
            self.trace_closest_packets(rays, hits);
        });
        hits
    }

    /// Whether each of many rays hits anything, packet by packet, on all cores.
    fn any_hits_packet<R: Ray + Sync>(&self, rays: &[R]) -> Vec<bool> {
        let mut answers = vec![false; rays.len()];
        for_each_batch(rays, &mut answers, &|rays, answers| {
            self.trace_any_packets(rays, answers);
        });
        answers
    }

    /// The closest hits of `rays`, packet by packet, on the calling thread.
    ///
    /// # Panics
    /// If `hits` is not as long as `rays`.
    fn trace_closest_packets<R: Ray>(&self, rays: &[R], hits: &mut [Option<Hit>]) {
        assert_eq!(rays.len(), hits.len(), "one answer per ray");
        self.query_packets(
            SimdLevel::detect(),
            rays,
            &mut (),
            ClosestHit::new,
            |index, query| hits[index] = query.best(),
        );
    }

    /// Whether each of `rays` hits anything, packet by packet, on the calling
    /// thread.
    ///
    /// # Panics
    /// If `answers` is not as long as `rays`.
    fn trace_any_packets<R: Ray>(&self, rays: &[R], answers: &mut [bool]) {
        assert_eq!(rays.len(), answers.len(), "one answer per ray");
        self.query_packets(
            SimdLevel::detect(),
            rays,
            &mut (),
            AnyHit::new,
            |index, query| answers[index] = query.found(),
        );
    }

    /// Every hit of each of `rays`, packet by packet, on the calling thread.
    ///
    /// # Panics
    /// If `hits` is not as long as `rays`.
    fn trace_all_packets<R: Ray>(&self, rays: &[R], hits: &mut [Vec<Hit>]) {
        assert_eq!(rays.len(), hits.len(), "one answer per ray");
        self.query_packets(
            SimdLevel::detect(),
            rays,
            &mut (),
            AllHits::new,
            |index, query| hits[index] = query.into_sorted(),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BruteForce, RaySegment, Sphere, TraversalCounters};

    fn spheres() -> BruteForce<Sphere> {
        let centers = [[0.0, 0.0, 5.0], [3.0, 0.0, 5.0]];
        BruteForce::new(&centers.map(|center| Sphere::new(center, 1.0))).unwrap()
    }

    #[test]
    fn queries_of_rays_that_can_hit_nothing_stay_as_they_are() {
        let good = RaySegment::new([0.0; 3], [0.0, 0.0, 1.0]);
        let rays = [good, RaySegment::new([0.0; 3], [0.0; 3]), good];
        let mut queries = rays.each_ref().map(ClosestHit::new);
        let mut counters = TraversalCounters::default();
        let packet = rays.each_ref().map(PacketRay::new);
        let traverse = PacketTraversal::<4>::traverse_packet;
        traverse(&spheres(), &packet, &mut queries, &mut counters);
        assert_eq!(counters.rays, 3);
        let found = queries.map(|query| query.best().is_some());
        assert_eq!(found, [true, false, true]);
    }

    #[test]
    fn slices_of_any_length_and_with_unusable_rays_are_answered_in_order() {
        let structure = spheres();
        let mut rays: Vec<RaySegment> = (0..11)
            .map(|x| RaySegment::new([x as f32 * 0.5, 0.0, 0.0], [0.0, 0.0, 1.0]))
            .collect();
        rays[3].direction.x = f32::NAN;
        rays.extend([RaySegment::new([f32::NAN; 3], [0.0; 3]); 5]);
        let single = structure.closest_hits(&rays);
        let packets = PacketTraversal::<4>::closest_hits_packet(&structure, &rays);
        assert_eq!(packets, single);
        let any = PacketTraversal::<8>::any_hits_packet(&structure, &rays);
        assert_eq!(any, structure.any_hits(&rays));
        let mut all = vec![Vec::new(); rays.len()];
        PacketTraversal::<16>::trace_all_packets(&structure, &rays, &mut all);
        let single: Vec<_> = rays.iter().map(|ray| structure.all_hits(ray)).collect();
        assert_eq!(all, single);
        let mut counters = TraversalCounters::default();
        let level = SimdLevel::BASELINE;
        let query = PacketTraversal::<4>::query_packets;
        query(
            &structure,
            level,
            &rays,
            &mut counters,
            ClosestHit::new,
            |_, _| (),
        );
        assert_eq!(counters.rays, rays.len() as u64);
    }
}
