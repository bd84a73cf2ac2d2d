//! The paper's BSP-tri as a structure like the others.

use accel_bsp::BspTree;
use accel_core::statistics::{BytesByPart, TreeOutline};
use accel_core::{
    Aabb, DynStructure, Hit, RaySegment, SurfaceAreaHeuristic, TraversalCounters, TreeStatistics,
    Triangle,
};

/// Answers closest hits without a kernel where the traversal can (section 4.3);
/// such hits have no surface coordinates. Other questions are answered as ever.
pub(super) struct Unconfirmed(pub BspTree<Triangle>);

fn without_coordinates(hit: accel_bsp::UnconfirmedHit) -> Hit {
    Hit {
        t: hit.t,
        u: 0.0,
        v: 0.0,
        id: hit.id,
    }
}

impl DynStructure for Unconfirmed {
    fn trace_closest(&self, rays: &[RaySegment], hits: &mut [Option<Hit>]) {
        assert_eq!(rays.len(), hits.len(), "one answer per ray");
        for (ray, slot) in rays.iter().zip(hits) {
            let hit = self.0.closest_hit_unconfirmed(ray);
            *slot = hit.map(without_coordinates);
        }
    }

    fn trace_any(&self, rays: &[RaySegment], answers: &mut [bool]) {
        self.0.trace_any(rays, answers);
    }

    fn trace_all(&self, rays: &[RaySegment], hits: &mut [Vec<Hit>]) {
        self.0.trace_all(rays, hits);
    }

    fn count_closest(&self, ray: &RaySegment, counters: &mut TraversalCounters) -> Option<Hit> {
        let hit = self.0.closest_hit_unconfirmed_with(ray, counters);
        hit.map(without_coordinates)
    }

    fn count_any(&self, ray: &RaySegment, counters: &mut TraversalCounters) -> bool {
        self.0.count_any(ray, counters)
    }

    fn count_all(&self, ray: &RaySegment, counters: &mut TraversalCounters) -> Vec<Hit> {
        self.0.count_all(ray, counters)
    }

    fn scene_bounds(&self) -> Option<Aabb> {
        self.0.scene_bounds()
    }

    fn bytes_by_part(&self) -> BytesByPart {
        self.0.bytes_by_part()
    }

    fn tree_outline(&self) -> TreeOutline {
        self.0.tree_outline()
    }

    fn describe(&self, heuristic: &SurfaceAreaHeuristic) -> TreeStatistics {
        self.0.describe(heuristic)
    }
}

/// How many rays the traversal answers otherwise than the kernel does: another
/// triangle, or a place a ten-thousandth of the way off.
pub(super) fn mismatches(
    unconfirmed: &dyn DynStructure,
    exact: &dyn DynStructure,
    rays: &[RaySegment],
) -> usize {
    let trace = |structure: &dyn DynStructure| {
        let mut hits = vec![None; rays.len()];
        structure.trace_closest(rays, &mut hits);
        hits
    };
    let pairs = trace(unconfirmed).into_iter().zip(trace(exact));
    pairs
        .filter(|(hit, expected)| differs(*hit, *expected))
        .count()
}

fn differs(hit: Option<Hit>, expected: Option<Hit>) -> bool {
    match (hit, expected) {
        (Some(hit), Some(expected)) => {
            hit.id != expected.id || (hit.t - expected.t).abs() > 1e-4 * expected.t
        }
        (hit, expected) => hit.is_some() != expected.is_some(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hit_differs_by_triangle_or_place_but_not_by_its_last_digits() {
        let hit = |t, id| {
            Some(Hit {
                t,
                u: 0.0,
                v: 0.0,
                id,
            })
        };
        assert!(!differs(hit(1.00001, 3), hit(1.0, 3)) && !differs(None, None));
        assert!(differs(hit(1.0, 4), hit(1.0, 3)) && differs(hit(1.01, 3), hit(1.0, 3)));
        assert!(differs(None, hit(1.0, 3)) && differs(hit(1.0, 3), None));
    }
}
