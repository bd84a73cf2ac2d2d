//! Thin curved strands out of a ball: everything overlaps everything.

use accel_core::glam::Vec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::builder::MeshBuilder;
use crate::scene::Mesh;

const SEGMENTS: usize = 20;
const SIDES: usize = 3;

pub(super) fn mesh(triangles: usize) -> Mesh {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let mut builder = MeshBuilder::default();
    let strands = (triangles / (2 * SEGMENTS * SIDES)).max(1);
    for _ in 0..strands {
        let mut at = uniform(&mut random).normalize_or(Vec3::X) * 0.5;
        let mut heading = at.normalize();
        let mut path = vec![at];
        for _ in 0..SEGMENTS {
            heading = (heading + uniform(&mut random) * 0.55).normalize_or(Vec3::Y);
            at += heading * 0.06;
            path.push(at);
        }
        builder.tube(&path, |v| 0.009 * (1.0 - 0.7 * v), SIDES);
    }
    builder.finish()
}

fn uniform(random: &mut Pcg64Mcg) -> Vec3 {
    Vec3::from([(); 3].map(|()| random.random_range(-1.0_f32..1.0)))
}
