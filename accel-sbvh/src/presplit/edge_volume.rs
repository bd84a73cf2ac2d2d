//! The edge volume heuristic.

use accel_bvh::{Bvh, BvhBuilder};
use accel_core::geometry::DAabb;
use accel_core::glam::{DVec3, Vec3};
use accel_core::{Aabb, BuildError, BuildObserver, Polygonal};

use super::{Pipeline, PresplitStatistics, Subdivision, Threshold};
use crate::ReferenceLimit;

/// The edge volume heuristic (Dammertz and Keller, *The Edge Volume Heuristic -
/// Robust Triangle Subdivision for Improved BVH Performance*, 2008): a triangle
/// is divided at the middle of the edge whose box has the largest volume, again
/// and again, until no edge's volume is above the threshold, and a plain BVH is
/// built over the parts. The middle of an edge depends on that edge alone.
/// Edges in an axis-aligned plane have no volume, so such triangles stay whole.
///
/// Primitives of more than three corners stay whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeVolumeHeuristic {
    /// The volume of an edge's box, relative to that of the scene's box.
    pub threshold: Threshold,
    /// The most references; [`BuildError::BudgetExceeded`] if a given threshold
    /// makes more.
    pub limit: ReferenceLimit,
    /// Whether a leaf that holds several parts of a primitive references it only
    /// once, as published.
    pub remove_duplicates: bool,
    /// Builds the tree over the parts.
    pub bvh: BvhBuilder,
}

impl Default for EdgeVolumeHeuristic {
    /// A quarter more references than primitives, by the full sweep.
    fn default() -> Self {
        Self {
            threshold: Threshold::Factor(1.25),
            limit: super::DEFAULT_LIMIT,
            remove_duplicates: true,
            bvh: BvhBuilder {
                object_split: accel_bvh::ObjectSplit::FullSweep,
                ..BvhBuilder::default()
            },
        }
    }
}

impl EdgeVolumeHeuristic {
    /// Builds the tree of `primitives`.
    ///
    /// # Errors
    /// Any [`BuildError`] but `Cancelled`.
    pub fn build<P: Polygonal>(&self, primitives: &[P]) -> Result<Bvh<P>, BuildError> {
        Ok(self.build_with(primitives, &())?.0)
    }

    /// As [`build`](Self::build), watched by `observer`, with what was done.
    ///
    /// # Errors
    /// Any [`BuildError`].
    pub fn build_with<P: Polygonal>(
        &self,
        primitives: &[P],
        observer: &dyn BuildObserver,
    ) -> Result<(Bvh<P>, PresplitStatistics), BuildError> {
        let scene = primitives
            .iter()
            .map(P::bounds)
            .filter(Aabb::is_valid)
            .fold(Aabb::EMPTY, |all, bounds| all.union(&bounds));
        let pipeline = Pipeline {
            subdivision: EdgeSplitting {
                scene_volume: scene.extent().element_product(),
            },
            threshold: self.threshold,
            limit: self.limit,
            remove_duplicates: self.remove_duplicates,
            bvh: &self.bvh,
        };
        pipeline.build(primitives, observer)
    }
}

/// Recursive division of triangles at the middle of an edge.
struct EdgeSplitting {
    scene_volume: f64,
}

type Corners = [DVec3; 3];

impl<P: Polygonal> Subdivision<P> for EdgeSplitting {
    fn divide(&self, primitive: &P, threshold: f64, part: &mut dyn FnMut(DAabb) -> bool) {
        let corners: Vec<DVec3> = primitive.vertices().map(Vec3::as_dvec3).collect();
        let Ok(corners) = Corners::try_from(corners) else {
            part(primitive.bounds().into());
            return;
        };
        let mut pending = vec![corners];
        while let Some(triangle) = pending.pop() {
            let (edge, volume) = largest_edge(&triangle);
            // A scene without volume has no edges with any.
            if volume > threshold * self.scene_volume {
                pending.extend(halves(triangle, edge));
            } else if let Some(bounds) = DAabb::around(&triangle)
                && !part(bounds)
            {
                return;
            }
        }
    }

    fn largest_threshold(&self, _: &Aabb) -> f64 {
        1.0
    }
}

/// The edge, by its first corner, whose box has the largest volume; the first of
/// equals.
fn largest_edge(triangle: &Corners) -> (usize, f64) {
    let volume = |edge: usize| {
        let along = triangle[(edge + 1) % 3] - triangle[edge];
        along.abs().element_product()
    };
    let first = (0, volume(0));
    [1, 2].into_iter().fold(first, |largest, edge| {
        let volume = volume(edge);
        if volume > largest.1 {
            (edge, volume)
        } else {
            largest
        }
    })
}

/// The two triangles on both sides of an edge's middle.
fn halves(triangle: Corners, edge: usize) -> [Corners; 2] {
    let [from, to, opposite] = [edge, edge + 1, edge + 2].map(|corner| triangle[corner % 3]);
    // Addition does not depend on the order: neighbours find the same point.
    let middle = (from + to) * 0.5;
    [[middle, to, opposite], [from, middle, opposite]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use accel_core::Triangle;

    fn parts(triangle: &Triangle, threshold: f64) -> Vec<DAabb> {
        let mut parts = Vec::new();
        let splitting = EdgeSplitting { scene_volume: 1.0 };
        splitting.divide(triangle, threshold, &mut |part| {
            parts.push(part);
            parts.len() < 1000
        });
        parts
    }

    #[test]
    fn the_edge_with_the_largest_box_is_divided_in_the_middle() {
        let triangle = Triangle::new([0.0; 3], [4.0, 4.0, 4.0], [1.0, 0.0, 0.0]);
        assert_eq!(parts(&triangle, 64.0).len(), 1);
        let halves = parts(&triangle, 63.0);
        let expected = [
            Aabb::new([0.0; 3], [2.0, 2.0, 2.0]),
            Aabb::new([1.0, 0.0, 0.0], [4.0, 4.0, 4.0]),
        ];
        assert_eq!(halves, expected.map(DAabb::from));
    }

    #[test]
    fn axis_aligned_triangles_are_never_divided() {
        let triangle = Triangle::new([0.0; 3], [1e3, 0.0, 0.0], [0.0, 1e3, 0.0]);
        assert_eq!(parts(&triangle, 0.0).len(), 1);
    }
}
