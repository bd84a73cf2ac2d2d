//! City blocks: axis-aligned boxes from kiosks to towers on one large ground.

use accel_core::glam::Vec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::builder::MeshBuilder;
use crate::scene::Mesh;

/// Triangles of a building: body, roof house, ledges.
const PER_BUILDING: usize = 12 * 12;

pub(super) fn mesh(triangles: usize) -> Mesh {
    let mut random = Pcg64Mcg::seed_from_u64(71);
    let mut builder = MeshBuilder::default();
    builder.quad(
        Vec3::new(-60.0, 0.0, -60.0),
        Vec3::Z * 120.0,
        Vec3::X * 120.0,
        2,
    );
    let side = ((triangles as f32 / PER_BUILDING as f32).sqrt().round() as usize).max(1);
    let lot = 100.0 / side as f32;
    for row in 0..side {
        for column in 0..side {
            let corner = Vec3::new(column as f32 * lot - 50.0, 0.0, row as f32 * lot - 50.0);
            building(&mut builder, &mut random, corner, lot);
        }
    }
    builder.finish()
}

fn building(builder: &mut MeshBuilder, random: &mut Pcg64Mcg, corner: Vec3, lot: f32) {
    let [width, depth] = [(); 2].map(|()| lot * random.random_range(0.5_f32..0.85));
    // Few towers among many low houses.
    let height = 1.5 + 28.0 * random.random::<f32>().powi(5) + 4.0 * random.random::<f32>();
    let min = corner + Vec3::new((lot - width) / 2.0, 0.0, (lot - depth) / 2.0);
    let max = min + Vec3::new(width, height, depth);
    builder.cuboid(min, max);
    let roof = Vec3::new(min.x, height, min.z);
    let inset = Vec3::new(width * 0.3, 0.0, depth * 0.3);
    builder.cuboid(
        roof + inset,
        max - inset + Vec3::Y * random.random_range(0.3..1.5),
    );
    // Ledges at the storeys, thin and as wide as the building.
    for ledge in 0..10 {
        let y = height * (ledge as f32 + 0.7) / 10.5;
        let out = lot * 0.015;
        let low = Vec3::new(min.x - out, y, min.z - out);
        builder.cuboid(low, Vec3::new(max.x + out, y + 0.06, max.z + out));
    }
}
