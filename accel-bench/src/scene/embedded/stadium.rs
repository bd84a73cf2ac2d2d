//! A dense figure in a coarse stadium: the case that Stich 2009, section 5,
//! shows with the scene Bubs. The figure holds 95 % of the triangles in a
//! ten-thousandth of the volume, and the few long triangles around it, of cables
//! that cross the pitch in all directions, spoil the boxes near the root.

use accel_core::glam::Vec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::figure;
use super::shapes::{MeshBuilder, full_turn};
use crate::scene::{Mesh, camera::Camera};

/// The figure at the centre of the pitch. The seed shapes its skin and strings
/// the cables.
pub fn stadium(triangles: usize, seed: u64) -> Mesh {
    let mut builder = figure::build(triangles * 95 / 100, seed);
    let rest = triangles.saturating_sub(builder.triangle_count());
    surroundings(&mut builder, rest, seed);
    builder.finish()
}

/// The figure before the stands, and the whole stadium from its upper tier.
pub fn cameras() -> Vec<Camera> {
    vec![
        Camera::upright([1.5, 1.0, 4.6], [0.0, 1.25, 0.0], 42.0),
        Camera::upright([-58.0, 17.0, 22.0], [0.0, 1.0, -6.0], 60.0),
    ]
}

/// The ground and the stands on it; from 400 triangles on with masts, goals and
/// cables.
fn surroundings(builder: &mut MeshBuilder, triangles: usize, seed: u64) {
    let goal = builder.triangle_count() + triangles;
    let corner = Vec3::new(-92.0, 0.0, -72.0);
    builder.quad(corner, Vec3::Z * 144.0, Vec3::X * 184.0, [1, 1]);
    if triangles >= 400 {
        for side in [-1.0, 1.0] {
            goal_frame(builder, side * 50.0);
            mast(builder, Vec3::new(side * 72.0, 0.0, -60.0));
            mast(builder, Vec3::new(side * 72.0, 0.0, 60.0));
        }
        cables(builder, (triangles / 70).min(48), seed);
    }
    let left = goal.saturating_sub(builder.triangle_count());
    let tiers = ((left as f32 / 16.0).sqrt() as usize).clamp(1, 12);
    stands(builder, tiers, left);
}

fn goal_frame(builder: &mut MeshBuilder, x: f32) {
    let [left, right] = [-3.66, 3.66].map(|z| Vec3::new(x, 0.0, z));
    let up = Vec3::Y * 2.44;
    for bar in [
        [left, left + up],
        [left + up, right + up],
        [right, right + up],
    ] {
        builder.tube(&bar, |_| 0.06, 4);
    }
}

/// A floodlight turned to the centre.
fn mast(builder: &mut MeshBuilder, foot: Vec3) {
    let head = foot + Vec3::Y * 34.0;
    builder.tube(&[foot, head], |v| 0.7 - 0.4 * v, 5);
    builder.cuboid(
        head - Vec3::new(3.0, 2.0, 0.3),
        head + Vec3::new(3.0, 2.0, 0.3),
    );
}

/// Cables from anywhere in the stands to anchors anywhere on and over the pitch.
fn cables(builder: &mut MeshBuilder, count: usize, seed: u64) {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    for _ in 0..count {
        let (sin, cos) = full_turn(random.random());
        let height = random.random_range(4.0..24.0);
        let stand = Vec3::new(66.0 * cos, height, 46.0 * sin);
        let (sin, cos) = full_turn(random.random());
        let out = 40.0 * random.random::<f32>().sqrt();
        let anchor = Vec3::new(out * cos, random.random_range(0.0..2.5), out * sin);
        builder.tube(&[stand, anchor], |_| 0.05, 4);
    }
}

/// Oval tiers, each a riser and a tread, an outer wall and a roof over the upper
/// half; a single tier is a plain slope.
fn stands(builder: &mut MeshBuilder, tiers: usize, triangles: usize) {
    let at = |u: f32, out: f32, y: f32| {
        let (sin, cos) = full_turn(u);
        Vec3::new((64.0 + out) * cos, y, (44.0 + out) * sin)
    };
    let (depth, height) = (26.0, 16.0);
    if tiers == 1 {
        let around = (triangles / 2).max(3);
        builder.grid([around, 1], |u, v| at(u, depth * v, height * v));
        return;
    }
    let around = (triangles / (4 * tiers + 4)).max(3);
    let (tread, riser) = (depth / tiers as f32, height / tiers as f32);
    for tier in 0..tiers {
        let (out, y) = (tier as f32 * tread, tier as f32 * riser);
        builder.grid([around, 1], |u, v| at(u, out, y + riser * v));
        builder.grid([around, 1], |u, v| at(u, out + tread * v, y + riser));
    }
    builder.grid([around, 1], |u, v| at(u, depth, 24.0 * v));
    builder.grid([around, 1], |u, v| at(u, depth - 15.0 * v, 24.0 + 2.5 * v));
}
