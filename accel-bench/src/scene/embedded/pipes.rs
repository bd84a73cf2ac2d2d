//! Conduits along a grid that is turned against the axes: long thin triangles
//! whose boxes are nearly empty.

use accel_core::glam::Vec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::builder::{MeshBuilder, turned};
use crate::scene::Mesh;

/// Grid cells from the middle to the border.
const HALF: i32 = 6;
const SIDES: usize = 8;

pub(super) fn mesh(triangles: usize) -> Mesh {
    let mut random = Pcg64Mcg::seed_from_u64(23);
    let mut builder = MeshBuilder::default();
    while builder.triangles() + SIDES * 10 <= triangles.max(SIDES * 10) {
        conduit(&mut builder, &mut random);
    }
    builder.rotate(turned());
    builder.finish()
}

/// A run of pipe with a few right angles.
fn conduit(builder: &mut MeshBuilder, random: &mut Pcg64Mcg) {
    let place = |random: &mut Pcg64Mcg| {
        let cell = Vec3::from([(); 3].map(|()| random.random_range(-HALF..=HALF) as f32));
        cell + Vec3::from([(); 3].map(|()| random.random_range(-0.3_f32..0.3)))
    };
    let mut path = vec![place(random)];
    let mut axis = random.random_range(0..3);
    for _ in 0..5 {
        let mut next = path[path.len() - 1];
        next[axis] = random.random_range(-HALF as f32..HALF as f32);
        path.push(next);
        axis = (axis + random.random_range(1..3)) % 3;
    }
    let radius = random.random_range(0.01..0.05);
    // Each straight run on its own, so that bends stay sharp.
    for run in path.windows(2) {
        builder.tube(run, |_| radius, SIDES);
    }
}
