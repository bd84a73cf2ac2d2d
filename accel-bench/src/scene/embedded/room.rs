//! A furnished room: walls, a table with chairs, a full bookshelf, a lamp, and
//! things on the table.

use std::f32::consts::PI;

use accel_core::glam::{Mat3, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::builder::MeshBuilder;
use crate::scene::Mesh;

pub(super) fn mesh(triangles: usize) -> Mesh {
    let mut builder = MeshBuilder::default();
    walls(&mut builder);
    table(&mut builder);
    for (x, z) in [(-0.9, -1.2), (-0.2, -1.2), (-0.9, 0.1), (-0.2, 0.1)] {
        chair(&mut builder, Vec3::new(x, 0.0, z));
    }
    shelf(&mut builder, triangles / 400);
    // The rest goes into the round things.
    let rest = triangles.saturating_sub(builder.triangles());
    let detail = ((rest as f32 / 26.0).sqrt() as usize).max(3);
    crockery(&mut builder, detail);
    lamp(&mut builder, detail);
    builder.finish()
}

fn walls(builder: &mut MeshBuilder) {
    let (min, size) = (Vec3::new(-3.0, 0.0, -3.0), Vec3::new(6.0, 2.8, 6.0));
    let [x, y, z] = [Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z];
    for (corner, along, up) in [
        (min, z, x),
        (min + y, x, z),
        (min, x, y),
        (min + z, y, x),
        (min, y, z),
        (min + x, z, y),
    ] {
        builder.quad(corner, along, up, 2);
    }
    // Skirting boards, and a window frame on the far wall.
    builder.cuboid(Vec3::new(-3.0, 0.0, -3.0), Vec3::new(3.0, 0.1, -2.97));
    builder.cuboid(Vec3::new(-3.0, 0.0, -3.0), Vec3::new(-2.97, 0.1, 3.0));
    for (x, width, y, height) in [
        (0.6, 1.7, 0.9, 0.06),
        (0.6, 1.7, 2.2, 0.06),
        (0.6, 0.06, 0.9, 1.3),
        (2.24, 0.06, 0.9, 1.3),
        (1.42, 0.06, 0.9, 1.3),
    ] {
        let min = Vec3::new(x, y, -3.0);
        builder.cuboid(min, min + Vec3::new(width, height, 0.05));
    }
}

fn table(builder: &mut MeshBuilder) {
    builder.cuboid(Vec3::new(-1.4, 0.72, -1.0), Vec3::new(0.4, 0.76, -0.1));
    for x in [-1.35, 0.3] {
        for z in [-0.95, -0.2] {
            builder.cuboid(Vec3::new(x, 0.0, z), Vec3::new(x + 0.05, 0.72, z + 0.05));
        }
    }
}

fn chair(builder: &mut MeshBuilder, at: Vec3) {
    let cuboid = |builder: &mut MeshBuilder, min: [f32; 3], max: [f32; 3]| {
        builder.cuboid(at + Vec3::from(min), at + Vec3::from(max));
    };
    cuboid(builder, [0.0, 0.43, 0.0], [0.42, 0.47, 0.42]);
    for x in [0.0, 0.38] {
        for z in [0.0, 0.38] {
            cuboid(builder, [x, 0.0, z], [x + 0.04, 0.43, z + 0.04]);
        }
    }
    let back = if at.z < -0.5 { 0.0 } else { 0.38 };
    for slat in 0..5 {
        let x = slat as f32 * 0.095;
        cuboid(builder, [x, 0.47, back], [x + 0.04, 0.95, back + 0.03]);
    }
}

/// A shelf on the left wall with about `books` books, some leaning.
fn shelf(builder: &mut MeshBuilder, books: usize) {
    let mut random = Pcg64Mcg::seed_from_u64(11);
    let per_board = (books / 5).max(8);
    for board in 0..6 {
        let y = 0.1 + board as f32 * 0.38;
        builder.cuboid(Vec3::new(-2.97, y, -2.4), Vec3::new(-2.65, y + 0.03, 1.2));
        if board == 5 {
            continue;
        }
        let mut z = -2.35;
        for _ in 0..per_board {
            let thickness = 3.4 / per_board as f32 * random.random_range(0.6..1.0);
            let height = random.random_range(0.2..0.32);
            let depth = random.random_range(0.16..0.24);
            let min = Vec3::new(-2.95, y + 0.03, z);
            builder.cuboid(min, min + Vec3::new(depth, height, thickness * 0.94));
            z += thickness;
        }
    }
    for z in [-2.43, 1.2] {
        builder.cuboid(Vec3::new(-2.97, 0.0, z), Vec3::new(-2.65, 2.1, z + 0.03));
    }
}

/// A teapot, cups and a bowl with fruit.
fn crockery(builder: &mut MeshBuilder, detail: usize) {
    let top = 0.76;
    let pot = Vec3::new(-0.5, top, -0.55);
    builder.revolution(pot, detail * 2, detail * 2, |v| {
        (
            (0.02 + 0.13 * (v * PI).sin().max(0.0).powf(0.6)) * (1.0 - 0.2 * v),
            v * 0.2,
        )
    });
    let spout = [(0.1, 0.06), (0.17, 0.09), (0.2, 0.15), (0.24, 0.19)]
        .map(|(x, y)| pot + Vec3::new(x, y, 0.0));
    builder.tube(&spout, |v| 0.03 - 0.018 * v, detail);
    let handle: Vec<Vec3> = (0..=8)
        .map(|i| {
            let angle = i as f32 / 8.0 * PI;
            pot + Vec3::new(-0.09 - 0.09 * angle.sin(), 0.1 + 0.06 * angle.cos(), 0.0)
        })
        .collect();
    builder.tube(&handle, |_| 0.012, detail);
    for (x, z) in [(-1.1, -0.8), (-0.1, -0.8), (-1.1, -0.3), (-0.1, -0.3)] {
        builder.revolution(Vec3::new(x, top, z), detail, detail / 2 + 2, |v| {
            // Up the outside and down the inside.
            let outside = v < 0.6;
            let s = if outside {
                v / 0.6
            } else {
                1.0 - (v - 0.6) / 0.4
            };
            let radius = 0.025 + 0.025 * s.sqrt();
            if outside {
                (radius, s * 0.07)
            } else {
                (radius - 0.004, 0.005 + s * 0.065)
            }
        });
    }
    for (x, y, z) in [
        (0.12, 0.05, -0.55),
        (0.22, 0.05, -0.5),
        (0.16, 0.05, -0.42),
        (0.17, 0.12, -0.49),
    ] {
        builder.sphere(Vec3::new(x, top + y, z), 0.05, detail / 2 + 2);
    }
}

/// A standing lamp with a pleated shade.
fn lamp(builder: &mut MeshBuilder, detail: usize) {
    let foot = Vec3::new(1.9, 0.0, -2.3);
    builder.tube(&[foot, foot + Vec3::Y * 0.03], |v| 0.16 - 0.1 * v, detail);
    builder.tube(&[foot, foot + Vec3::Y * 1.55], |_| 0.012, 12);
    let lean = Mat3::from_rotation_z(0.06);
    builder.grid(detail * 4, detail / 2 + 1, |u, v| {
        let pleat = 1.0 + 0.04 * (u * 40.0 * PI).sin();
        let angle = if u < 1.0 { u * 2.0 * PI } else { 0.0 };
        let radius = (0.26 - 0.1 * v) * pleat;
        foot + Vec3::Y * 1.45
            + lean * Vec3::new(radius * angle.cos(), v * 0.32, radius * angle.sin())
    });
}
