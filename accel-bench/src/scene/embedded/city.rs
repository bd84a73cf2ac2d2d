//! City blocks: axis-aligned buildings from kiosks to towers, with setbacks,
//! ledges, and small things on their roofs, on one large ground.

use accel_core::glam::Vec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::shapes::{MeshBuilder, TriangleBudget};
use crate::scene::{Mesh, camera::Camera};

/// From the middle to the border of the built-up area.
const HALF: f32 = 50.0;
/// Triangles of a usual lot.
const PER_LOT: usize = 130;
/// Triangles of a box.
const BOX: usize = 12;
/// Lots between two wide streets.
const LOTS_PER_BLOCK: usize = 3;

/// A square of lots that become smaller as the count grows; one in eighteen is a
/// park. The seed plans it.
pub fn city(triangles: usize, seed: u64) -> Mesh {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut builder = MeshBuilder::default();
    let ground = HALF * 1.2;
    builder.quad(
        Vec3::new(-ground, 0.0, -ground),
        Vec3::Z * (2.0 * ground),
        Vec3::X * (2.0 * ground),
        [2, 2],
    );
    let side = ((triangles as f32 / PER_LOT as f32).sqrt().round() as usize).max(2);
    let mut budget = TriangleBudget::new(triangles, (side * side) as f32);
    for row in 0..side {
        for column in 0..side {
            let lot = Lot::new(row, column, side);
            let limit = builder.triangle_count() + budget.share(builder.triangle_count(), 1.0);
            if random.random_ratio(1, 18) {
                park(&mut builder, &mut random, &lot, limit);
            } else {
                building(&mut builder, &mut random, &lot, limit);
            }
        }
    }
    builder.finish()
}

/// From above a corner, and down a street.
pub fn cameras() -> Vec<Camera> {
    vec![
        Camera::upright([58.0, 36.0, 70.0], [2.0, 5.0, 0.0], 42.0),
        Camera::upright([7.2, 2.2, 56.0], [6.0, 5.0, 0.0], 60.0),
    ]
}

/// A square piece of ground.
struct Lot {
    center: Vec3,
    size: f32,
    /// 1 in the middle of the city, 0 at its corners.
    centrality: f32,
}

impl Lot {
    fn new(row: usize, column: usize, side: usize) -> Self {
        // Streets between blocks are as wide as a third of a lot.
        let streets = (side - 1) / LOTS_PER_BLOCK;
        let size = 2.0 * HALF / (side as f32 + streets as f32 / 3.0);
        let place = |i: usize| {
            let street = (i / LOTS_PER_BLOCK) as f32 / 3.0;
            (i as f32 + street + 0.5) * size - HALF
        };
        let center = Vec3::new(place(column), 0.0, place(row));
        Self {
            center,
            size,
            centrality: 1.0 - center.length() / (HALF * 1.42),
        }
    }
}

/// An axis-aligned box by the middle of its foot.
fn block(builder: &mut MeshBuilder, foot: Vec3, size: Vec3) {
    let half = Vec3::new(size.x / 2.0, 0.0, size.z / 2.0);
    builder.cuboid(foot - half, foot + half + Vec3::Y * size.y);
}

/// One to three storeys stacked with setbacks; what is left of the count goes to
/// the roof and to ledges around the walls.
fn building(builder: &mut MeshBuilder, random: &mut Pcg64Mcg, lot: &Lot, limit: usize) {
    let boxes_left = |builder: &MeshBuilder| limit.saturating_sub(builder.triangle_count()) / BOX;
    let [width, depth] = [(); 2].map(|()| lot.size * random.random_range(0.6..0.88));
    // Few towers among many low houses, the highest in the middle.
    let tall = random.random::<f32>().powi(4) * lot.centrality;
    let height = lot.size * (0.25 + 0.7 * random.random::<f32>() + 6.0 * tall);
    let stages = if height > 1.6 * lot.size { 3 } else { 1 };
    let mut size = Vec3::new(width, height * 0.6, depth);
    let mut foot = lot.center;
    for stage in 0..stages {
        if stages == 1 {
            size.y = height;
        }
        block(builder, foot, size);
        let for_ledges = boxes_left(builder) / 2 / (stages - stage);
        ledges(builder, foot, size, for_ledges.min(8), lot.size);
        foot.y += size.y;
        if stage + 1 < stages {
            size *= Vec3::new(0.72, 0.5, 0.72);
        }
    }
    roof(builder, random, foot, size, boxes_left(builder));
}

/// Thin slabs around a building's walls, a little wider than these.
fn ledges(builder: &mut MeshBuilder, foot: Vec3, size: Vec3, count: usize, lot: f32) {
    let out = Vec3::new(0.03 * lot, 0.0, 0.03 * lot);
    for ledge in 0..count {
        let y = size.y * (ledge + 1) as f32 / (count + 1) as f32;
        let slab = Vec3::new(size.x, 0.012 * lot, size.z) + out;
        block(builder, foot + Vec3::Y * y, slab);
    }
}

/// A parapet of four, then a house for the stairs, then an antenna, then what
/// hums on roofs.
fn roof(builder: &mut MeshBuilder, random: &mut Pcg64Mcg, roof: Vec3, size: Vec3, boxes: usize) {
    let small = size.x.min(size.z);
    let wall = 0.04 * small;
    let (x, z) = ((size.x - wall) / 2.0, (size.z - wall) / 2.0);
    let rails = [(x, 0.0), (-x, 0.0), (0.0, z), (0.0, -z)];
    for &(x, z) in rails.iter().take(boxes) {
        let along_z = x != 0.0;
        let rail = if along_z {
            Vec3::new(wall, 0.08 * small, size.z)
        } else {
            Vec3::new(size.x - 2.0 * wall, 0.08 * small, wall)
        };
        block(builder, roof + Vec3::new(x, 0.0, z), rail);
    }
    for thing in 4..boxes {
        let [dx, dz] = [(); 2].map(|()| random.random_range(-0.36_f32..0.36));
        let foot = roof + Vec3::new(dx * size.x, 0.0, dz * size.z);
        let shape = match thing {
            4 => Vec3::new(0.3, 0.22, 0.25),
            5 => Vec3::new(0.015, 0.7, 0.015),
            _ => Vec3::from([(); 3].map(|()| random.random_range(0.05..0.13))),
        };
        block(builder, foot, shape * small);
    }
}

/// Trees: a trunk of a box and a crown like a spindle.
fn park(builder: &mut MeshBuilder, random: &mut Pcg64Mcg, lot: &Lot, limit: usize) {
    const CROWN_SIDES: usize = 6;
    let tree = BOX + 2 * CROWN_SIDES + 2 * CROWN_SIDES;
    while builder.triangle_count() + tree <= limit {
        let [dx, dz] = [(); 2].map(|()| random.random_range(-0.4_f32..0.4));
        let foot = lot.center + Vec3::new(dx, 0.0, dz) * lot.size;
        let height = lot.size * random.random_range(0.16..0.3);
        block(builder, foot, Vec3::new(0.08, 0.35, 0.08) * height);
        let crown = foot + Vec3::Y * (0.3 * height);
        builder.revolution(crown, [CROWN_SIDES, 3], |v| {
            let radius = [0.0, 0.34, 0.24, 0.0][(v * 3.0).round() as usize];
            (radius * height, v * 0.8 * height)
        });
    }
}
