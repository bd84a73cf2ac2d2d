//! Rays that bring out what packets do: go together, fall apart, have empty lanes.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::testing::rays::{self, RayKind};
use crate::{RaySegment, Triangle};

/// Sets of rays for a scene, with their names.
pub fn ray_sets(scene: &[Triangle], seed: u64) -> [(&'static str, Vec<RaySegment>); 3] {
    [
        ("spoiled", spoiled(scene, seed)),
        ("sheaves", sheaves(scene, seed)),
        ("from one origin", from_one_origin(scene, seed)),
    ]
}

/// All finite kinds in turn, every seventh ray replaced by one that is none, and
/// a run of those: packets with empty lanes and packets without a ray.
fn spoiled(scene: &[Triangle], seed: u64) -> Vec<RaySegment> {
    let mut rays = rays::mixed(scene, seed, 160);
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let none = rays::rays(RayKind::NonFinite, scene, &mut random, rays.len());
    for (index, ray) in rays.iter_mut().enumerate() {
        if index % 7 == 3 || (80..150).contains(&index) {
            *ray = none[index];
        }
    }
    rays
}

/// Sheaves of rays about those of all finite kinds: of one origin and nearly
/// one direction, zero components kept.
fn sheaves(scene: &[Triangle], seed: u64) -> Vec<RaySegment> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let middles = rays::mixed(scene, seed, 6);
    let sheaves = middles.iter().flat_map(|middle| [*middle; 16]);
    let sheaves = sheaves.map(|mut ray| {
        for axis in 0..3 {
            ray.direction[axis] *= 1.0 + random.random_range(-0.02..0.02_f32);
        }
        ray
    });
    sheaves.collect()
}

/// From one origin in all directions, straight through vertices.
fn from_one_origin(scene: &[Triangle], seed: u64) -> Vec<RaySegment> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut rays = rays::rays(RayKind::ThroughVertices, scene, &mut random, 96);
    let origin = rays[0].origin;
    for ray in &mut rays {
        ray.direction = ray.origin + ray.direction - origin;
        ray.origin = origin;
    }
    rays
}
