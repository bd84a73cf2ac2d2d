//! Trees: stems that branch, and leaves.

use accel_core::glam::Vec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::builder::MeshBuilder;
use crate::scene::Mesh;

const TREES: usize = 7;

/// Triangles of a tree's stems.
const BRANCHES: u32 = 4;

pub(super) fn mesh(triangles: usize) -> Mesh {
    let mut random = Pcg64Mcg::seed_from_u64(37);
    let mut builder = MeshBuilder::default();
    builder.quad(
        Vec3::new(-6.0, 0.0, -6.0),
        Vec3::Z * 12.0,
        Vec3::X * 12.0,
        2,
    );
    let mut tips = Vec::new();
    for tree in 0..TREES {
        let angle = tree as f32 * 2.4;
        let foot = Vec3::new(angle.cos(), 0.0, angle.sin()) * (tree as f32).sqrt() * 1.5;
        branch(
            &mut builder,
            &mut random,
            foot,
            Vec3::Y * 1.3,
            0.11,
            BRANCHES,
            &mut tips,
        );
    }
    // What the stems leave over becomes leaves, two triangles each.
    let leaves = triangles.saturating_sub(builder.triangles()) / 2;
    for _ in 0..leaves {
        let tip = tips[random.random_range(0..tips.len())];
        leaf(&mut builder, &mut random, tip);
    }
    builder.finish()
}

fn branch(
    builder: &mut MeshBuilder,
    random: &mut Pcg64Mcg,
    from: Vec3,
    along: Vec3,
    radius: f32,
    levels: u32,
    tips: &mut Vec<Vec3>,
) {
    let to = from + along;
    builder.tube(&[from, to], |v| radius * (1.0 - 0.4 * v), 5);
    if levels == 0 {
        tips.push(to);
        return;
    }
    for _ in 0..3 {
        let bend = spread(random) * along.length() * 0.75;
        let next = (along + bend).normalize_or(Vec3::Y) * along.length() * 0.68;
        branch(builder, random, to, next, radius * 0.6, levels - 1, tips);
    }
}

fn leaf(builder: &mut MeshBuilder, random: &mut Pcg64Mcg, tip: Vec3) {
    let at = tip + spread(random) * 0.28;
    let along = spread(random).normalize_or(Vec3::X) * 0.12;
    let side = along.cross(spread(random)).normalize_or(Vec3::Z) * 0.03;
    let middle = at + along * 0.5;
    builder.triangle([at, middle + side, at + along]);
    builder.triangle([at, at + along, middle - side]);
}

fn spread(random: &mut Pcg64Mcg) -> Vec3 {
    Vec3::from([(); 3].map(|()| random.random_range(-1.0_f32..1.0)))
}
