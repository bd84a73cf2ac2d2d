//! The paper's BSP-tri: hits taken from the traversal, not from a kernel (Ize
//! 2008, section 4.3).
//!
//! ```text
//! each part of the ray knows where it begins and ends, and at which depth the
//! planes stand that it begins and ends at
//! leaf whose plane stands at that depth: the hit is that end
//! ```

use accel_core::statistics::TraversalStatistics;
use accel_core::{ClosestHit, Polygonal, PreparedRay, Ray};

use crate::BspTree;
use crate::crossing::Tolerance;
use crate::plane_tracking::{LeafAnswer, PlaneTracking};
use crate::traversal::traverse;

/// A hit that no kernel has confirmed: without surface coordinates, and beside an
/// edge perhaps of a neighbour, or of nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnconfirmedHit {
    /// The ray parameter, in lengths of the ray's direction.
    pub t: f32,
    /// The primitive, by its position in the input.
    pub id: u32,
}

impl<P: Polygonal> BspTree<P> {
    /// The closest hit as BSP-tri of the paper finds it: in leaves that
    /// [`SingleLeaves::Bounded`](crate::SingleLeaves::Bounded) has marked, where
    /// the ray crosses the plane; in others by the kernel.
    ///
    /// Unlike every other query this may differ from brute force: near edges, in the
    /// last digits of `t`, and where a ray starts or ends on a surface or near it, which
    /// it may hit or pass. On trees without marked leaves it does not.
    pub fn closest_hit_unconfirmed(&self, ray: &impl Ray) -> Option<UnconfirmedHit> {
        self.closest_hit_unconfirmed_with(ray, &mut ())
    }

    /// As [`closest_hit_unconfirmed`](Self::closest_hit_unconfirmed), telling
    /// `statistics` what it does: a leaf that needs no kernel counts a plane test.
    pub fn closest_hit_unconfirmed_with<S: TraversalStatistics>(
        &self,
        ray: &impl Ray,
        statistics: &mut S,
    ) -> Option<UnconfirmedHit> {
        let best = PreparedRay::new(ray).and_then(|ray| {
            let mut query = ClosestHit::new(&ray);
            traverse::<_, BoundingPlanes, _, _>(
                self,
                &ray,
                &mut query,
                statistics,
                Tolerance::SAFE,
            );
            query.best()
        });
        statistics.finish_ray();
        best.map(|hit| UnconfirmedHit {
            t: hit.t,
            id: hit.id,
        })
    }
}

/// The planes that a part of the ray lies between.
#[derive(Clone, Copy, Debug)]
struct BoundingPlanes {
    near: End,
    far: End,
    /// Of the node.
    depth: u32,
}

/// An end of a part of the ray.
#[derive(Clone, Copy, Debug)]
struct End {
    /// Where it is, without the tolerance that the traversal adds.
    at: f64,
    /// The depth of the plane there, if it is not the scene's box.
    depth: Option<u32>,
}

impl PlaneTracking for BoundingPlanes {
    fn of_ray(near: f64, far: f64) -> Self {
        let [near, far] = [near, far].map(|at| End { at, depth: None });
        Self {
            near,
            far,
            depth: 0,
        }
    }

    fn on_one_side(self) -> Self {
        Self {
            depth: self.depth + 1,
            ..self
        }
    }

    /// One of the two may be left with its ends in the wrong order: it is visited
    /// for the sake of the tolerance alone.
    fn divided(self, at: impl FnOnce() -> f64) -> [Self; 2] {
        let at = at();
        let plane = End {
            at,
            depth: Some(self.depth),
        };
        let [mut nearer, mut farther] = [self.on_one_side(); 2];
        if at < self.far.at {
            nearer.far = plane;
        }
        if at > self.near.at {
            farther.near = plane;
        }
        [nearer, farther]
    }

    fn leaf_answer(&self, depth: u32) -> LeafAnswer {
        let ends = [self.near, self.far];
        let hit = ends.into_iter().find(|end| end.depth == Some(depth));
        match hit {
            Some(end) if self.near.at <= self.far.at => LeafAnswer::Hit(end.at),
            _ => LeafAnswer::Miss,
        }
    }
}
