//! Thin curled strands out of a ball: every box overlaps many others, and no
//! plane parts them.

use std::f32::consts::TAU;

use accel_core::glam::{Quat, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::shapes::{MeshBuilder, cells};
use crate::scene::{Mesh, camera::Camera};

const BALL: f32 = 0.35;
const LENGTH: f32 = 1.3;
const SIDES: usize = 3;

/// Strands of 6 to 32 segments, more of them and finer ones for larger counts,
/// the last cut short. The seed curls them.
pub fn hairball(triangles: usize, seed: u64) -> Mesh {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut builder = MeshBuilder::default();
    builder.sphere(Vec3::ZERO, BALL, cells(triangles / 20, 2.0, [6, 4]));
    let segments = ((triangles as f32).cbrt() * 0.6).clamp(6.0, 32.0) as usize;
    let strands = triangles as f32 / (2 * SIDES * segments) as f32;
    let radius = (0.2 / strands.sqrt()).clamp(0.001, 0.012);
    loop {
        let left = triangles.saturating_sub(builder.triangle_count()) / (2 * SIDES);
        if left == 0 {
            return builder.finish();
        }
        let path = strand(&mut random, segments);
        let path = &path[..=left.min(segments)];
        builder.tube(path, |v| radius * (1.0 - 0.7 * v), SIDES);
    }
}

/// From the front, and close to its edge.
pub fn cameras() -> Vec<Camera> {
    vec![
        Camera::upright([0.0, 0.5, 3.6], [0.0, 0.0, 0.0], 40.0),
        Camera::upright([0.9, 0.5, 1.4], [0.35, 0.25, 0.0], 40.0),
    ]
}

/// A curl from the ball outwards that bends back before it gets too far.
fn strand(random: &mut Pcg64Mcg, segments: usize) -> Vec<Vec3> {
    let mut heading = direction(random);
    let mut at = heading * BALL;
    let curl = direction(random);
    let per_step = random.random_range(1.5..5.0) / segments as f32;
    let mut path = vec![at];
    for _ in 0..segments {
        at += heading * (LENGTH / segments as f32);
        path.push(at);
        let inwards = -at * (at.length() - 0.8).max(0.0);
        let turned = Quat::from_axis_angle(curl, per_step) * heading;
        heading = (turned + inwards * (6.0 / segments as f32)).normalize_or(heading);
    }
    path
}

/// A direction, all alike likely.
fn direction(random: &mut Pcg64Mcg) -> Vec3 {
    let height: f32 = random.random_range(-1.0..1.0);
    let (sin, cos) = (random.random::<f32>() * TAU).sin_cos();
    let ring = (1.0 - height * height).sqrt();
    Vec3::new(ring * cos, height, ring * sin)
}
