//! Structures behind a pointer, chosen at run time.

use super::AccelerationStructure;
use crate::geometry::Aabb;
use crate::query::Hit;
use crate::ray::RaySegment;
use crate::split::SurfaceAreaHeuristic;
use crate::statistics::{BytesByPart, TraversalCounters, TreeOutline, TreeStatistics};

/// An [`AccelerationStructure`] as a trait object. It takes rays in slices, so
/// that the call through the pointer is paid once for many rays, and answers
/// them on the calling thread. Implemented for every structure.
///
/// # Panics
/// The methods that fill a slice panic if it is not as long as `rays`.
pub trait DynStructure: Send + Sync {
    /// The closest hit of each ray.
    fn trace_closest(&self, rays: &[RaySegment], hits: &mut [Option<Hit>]);

    /// Whether each ray hits anything.
    fn trace_any(&self, rays: &[RaySegment], answers: &mut [bool]);

    /// Every hit of each ray.
    fn trace_all(&self, rays: &[RaySegment], hits: &mut [Vec<Hit>]);

    /// [`trace_closest`](Self::trace_closest) of one ray, counted.
    fn count_closest(&self, ray: &RaySegment, counters: &mut TraversalCounters) -> Option<Hit>;

    /// [`trace_any`](Self::trace_any) of one ray, counted.
    fn count_any(&self, ray: &RaySegment, counters: &mut TraversalCounters) -> bool;

    /// [`trace_all`](Self::trace_all) of one ray, counted.
    fn count_all(&self, ray: &RaySegment, counters: &mut TraversalCounters) -> Vec<Hit>;

    /// The box around everything that can be hit; `None` for an empty scene.
    fn scene_bounds(&self) -> Option<Aabb>;

    /// Bytes by part.
    fn bytes_by_part(&self) -> BytesByPart;

    /// The tree as a list of nodes.
    fn tree_outline(&self) -> TreeOutline;

    /// Figures that describe the tree.
    fn describe(&self, heuristic: &SurfaceAreaHeuristic) -> TreeStatistics;
}

impl<T: AccelerationStructure> DynStructure for T {
    fn trace_closest(&self, rays: &[RaySegment], hits: &mut [Option<Hit>]) {
        fill(rays, hits, |ray| self.closest_hit(ray));
    }

    fn trace_any(&self, rays: &[RaySegment], answers: &mut [bool]) {
        fill(rays, answers, |ray| self.any_hit(ray));
    }

    fn trace_all(&self, rays: &[RaySegment], hits: &mut [Vec<Hit>]) {
        fill(rays, hits, |ray| self.all_hits(ray));
    }

    fn count_closest(&self, ray: &RaySegment, counters: &mut TraversalCounters) -> Option<Hit> {
        self.closest_hit_with(ray, counters)
    }

    fn count_any(&self, ray: &RaySegment, counters: &mut TraversalCounters) -> bool {
        self.any_hit_with(ray, counters)
    }

    fn count_all(&self, ray: &RaySegment, counters: &mut TraversalCounters) -> Vec<Hit> {
        self.all_hits_with(ray, counters)
    }

    fn scene_bounds(&self) -> Option<Aabb> {
        self.bounds()
    }

    fn bytes_by_part(&self) -> BytesByPart {
        self.bytes()
    }

    fn tree_outline(&self) -> TreeOutline {
        self.outline()
    }

    fn describe(&self, heuristic: &SurfaceAreaHeuristic) -> TreeStatistics {
        self.tree_statistics(heuristic)
    }
}

#[inline]
fn fill<A>(rays: &[RaySegment], answers: &mut [A], answer: impl Fn(&RaySegment) -> A) {
    assert_eq!(rays.len(), answers.len(), "one answer per ray");
    for (ray, slot) in rays.iter().zip(answers) {
        *slot = answer(ray);
    }
}
