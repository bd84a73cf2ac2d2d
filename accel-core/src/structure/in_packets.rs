//! A structure that answers in packets, behind a pointer.

use super::{DynStructure, PacketTraversal};
use crate::geometry::Aabb;
use crate::query::Hit;
use crate::ray::RaySegment;
use crate::split::SurfaceAreaHeuristic;
use crate::statistics::{BytesByPart, TraversalCounters, TreeOutline, TreeStatistics};

/// A structure as a [`DynStructure`] that traces slices of rays in packets of
/// `N`. Single rays are counted as such.
#[derive(Clone, Debug)]
pub struct InPackets<A, const N: usize>(pub A);

impl<A: PacketTraversal<N>, const N: usize> DynStructure for InPackets<A, N> {
    fn trace_closest(&self, rays: &[RaySegment], hits: &mut [Option<Hit>]) {
        self.0.trace_closest_packets(rays, hits);
    }

    fn trace_any(&self, rays: &[RaySegment], answers: &mut [bool]) {
        self.0.trace_any_packets(rays, answers);
    }

    fn trace_all(&self, rays: &[RaySegment], hits: &mut [Vec<Hit>]) {
        self.0.trace_all_packets(rays, hits);
    }

    fn count_closest(&self, ray: &RaySegment, counters: &mut TraversalCounters) -> Option<Hit> {
        self.0.closest_hit_with(ray, counters)
    }

    fn count_any(&self, ray: &RaySegment, counters: &mut TraversalCounters) -> bool {
        self.0.any_hit_with(ray, counters)
    }

    fn count_all(&self, ray: &RaySegment, counters: &mut TraversalCounters) -> Vec<Hit> {
        self.0.all_hits_with(ray, counters)
    }

    fn scene_bounds(&self) -> Option<Aabb> {
        self.0.bounds()
    }

    fn bytes_by_part(&self) -> BytesByPart {
        self.0.bytes()
    }

    fn tree_outline(&self) -> TreeOutline {
        self.0.outline()
    }

    fn describe(&self, heuristic: &SurfaceAreaHeuristic) -> TreeStatistics {
        self.0.tree_statistics(heuristic)
    }
}
