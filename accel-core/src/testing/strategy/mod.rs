//! Proptest strategies over the scene families and the rays at them.
//!
//! Failures shrink to few rays and few triangles: long stretches are left out
//! first, then shorter ones, down to single items. What is left stays as it
//! was, since moving vertices would lose the very coincidence that made a
//! test fail.

mod case;
mod subset;

use proptest::prelude::*;
use proptest::sample::select;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::rays::{RayKind, rays};
use crate::{RaySegment, Triangle};

/// A drawn scene, named after where it comes from.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The name of the [family](super::families::Family), or `"arbitrary"`.
    pub family: &'static str,
    /// The triangles, or those that shrinking has left.
    pub triangles: Vec<Triangle>,
}

impl Scene {
    /// Whether some triangle has NaN or infinite coordinates.
    pub fn has_invalid(&self) -> bool {
        let mut vertices = self.triangles.iter().flat_map(Triangle::vertices);
        vertices.any(|vertex| !vertex.is_finite())
    }
}

/// Scenes of every family, and of arbitrary finite coordinates, of at most
/// `max_triangles` triangles.
pub fn any_scene(max_triangles: usize) -> impl Strategy<Value = Scene> {
    any_case(max_triangles, 0).prop_map(|(scene, _)| scene)
}

/// Finite rays of every kind at `triangles`.
pub fn any_ray(triangles: Vec<Triangle>) -> impl Strategy<Value = RaySegment> {
    (select(&RayKind::FINITE), any::<u64>())
        .prop_map(move |(kind, seed)| {
            let mut rng = Pcg64Mcg::seed_from_u64(seed);
            rays(kind, &triangles, &mut rng, 1)[0]
        })
        .no_shrink()
}

/// A scene as of [`any_scene`] and `rays` finite rays of all kinds at it,
/// which stay the same while triangles are left out.
pub fn any_case(
    max_triangles: usize,
    rays: usize,
) -> impl Strategy<Value = (Scene, Vec<RaySegment>)> {
    case::Cases {
        max_triangles,
        rays,
    }
}

#[cfg(test)]
mod tests;
