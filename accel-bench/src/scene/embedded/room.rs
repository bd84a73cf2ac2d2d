//! A furnished room: boxes of every proportion (walls, table, chairs, shelves
//! with books) beside smooth things of fine triangles (teapot, cups, fruit, lamp,
//! curtains, globe).

use std::f32::consts::TAU;

use accel_core::glam::{Affine3A, Quat, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::room_smooth;
use super::shapes::{MeshBuilder, TriangleBudget};
use crate::scene::{Mesh, camera::Camera};

/// Below this count the room has two chairs, half the shelves and few things.
const SPARSE_BELOW: usize = 2000;

/// The room, 6 by 6 by 2.8 with the floor at y = 0. The seed chooses the books.
pub fn room(triangles: usize, seed: u64) -> Mesh {
    let sparse = triangles < SPARSE_BELOW;
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut builder = MeshBuilder::default();
    walls(&mut builder, sparse);
    table(&mut builder);
    let seats: &[_] = &[
        (-0.9, -1.35, 0.1),
        (0.0, 0.45, 3.4),
        (-1.0, 0.4, 3.0),
        (0.0, -1.4, -0.15),
    ];
    for &(x, z, turn) in if sparse { &seats[..2] } else { seats } {
        chair(&mut builder, Vec3::new(x, 0.0, z), turn, sparse);
    }
    let left = triangles.saturating_sub(builder.triangle_count());
    let boards = if sparse { 3 } else { 6 };
    shelf(&mut builder, &mut random, boards, (left / 72).min(300));
    let things = room_smooth::things(sparse);
    let weight = things.iter().map(|thing| thing.weight).sum();
    let mut budget = TriangleBudget::new(triangles, weight);
    for thing in things {
        let share = budget.share(builder.triangle_count(), thing.weight);
        (thing.build)(&mut builder, share);
    }
    builder.finish()
}

/// From a corner over the table to the window, and close to the table.
pub fn cameras() -> Vec<Camera> {
    vec![
        Camera::upright([2.6, 1.75, 2.3], [-0.3, 0.8, -1.4], 60.0),
        Camera::upright([1.0, 1.35, 0.3], [-0.6, 0.8, -0.6], 50.0),
    ]
}

fn walls(builder: &mut MeshBuilder, sparse: bool) {
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
        builder.quad(corner, along, up, [1, 1]);
    }
    if sparse {
        return;
    }
    // Skirting boards, and a window frame on the far wall.
    builder.cuboid(Vec3::new(-3.0, 0.0, -3.0), Vec3::new(3.0, 0.1, -2.97));
    builder.cuboid(Vec3::new(-3.0, 0.0, -3.0), Vec3::new(-2.97, 0.1, 3.0));
    for (x, y, width, height) in [
        (-0.5, 0.9, 1.7, 0.06),
        (-0.5, 2.2, 1.7, 0.06),
        (-0.5, 0.96, 0.06, 1.24),
        (1.14, 0.96, 0.06, 1.24),
        (0.32, 0.96, 0.06, 1.24),
    ] {
        let min = Vec3::new(x, y, -3.0);
        builder.cuboid(min, min + Vec3::new(width, height, 0.06));
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

/// A chair around `at`, turned about the vertical; its back is behind it.
fn chair(builder: &mut MeshBuilder, at: Vec3, turn: f32, sparse: bool) {
    let placement = Affine3A::from_rotation_translation(Quat::from_rotation_y(turn), at);
    let mut part = |min: [f32; 3], max: [f32; 3]| {
        builder.placed_cuboid(&placement, min.into(), max.into());
    };
    part([-0.21, 0.43, -0.21], [0.21, 0.47, 0.21]);
    for x in [-0.21, 0.17] {
        for z in [-0.21, 0.17] {
            part([x, 0.0, z], [x + 0.04, 0.43, z + 0.04]);
        }
    }
    if sparse {
        part([-0.21, 0.47, -0.21], [0.21, 0.95, -0.18]);
        return;
    }
    for slat in 0..5 {
        let x = -0.21 + slat as f32 * 0.095;
        part([x, 0.47, -0.21], [x + 0.04, 0.9, -0.18]);
    }
    part([-0.21, 0.9, -0.21], [0.21, 0.98, -0.18]);
}

/// A shelf on the left wall with about `books` books, some of them leaning.
fn shelf(builder: &mut MeshBuilder, random: &mut Pcg64Mcg, boards: usize, books: usize) {
    const LENGTH: f32 = 3.4;
    let step = 2.0 / (boards - 1) as f32;
    for board in 0..boards {
        let y = 0.1 + board as f32 * step;
        builder.cuboid(Vec3::new(-2.97, y, -2.3), Vec3::new(-2.62, y + 0.03, 1.1));
    }
    for z in [-2.33, 1.1] {
        builder.cuboid(Vec3::new(-2.97, 0.0, z), Vec3::new(-2.62, 2.13, z + 0.03));
    }
    for book in 0..books {
        let board = book % (boards - 1);
        let on_board = books.div_ceil(boards - 1);
        let room = (LENGTH / on_board as f32).min(0.08);
        let thickness = room * random.random_range(0.55..0.9);
        let foot = Vec3::new(
            -2.94,
            0.13 + board as f32 * step,
            -2.28 + (book / (boards - 1)) as f32 * room,
        );
        let lean = if random.random_bool(0.1) { 0.08 } else { 0.0 };
        let turn = Quat::from_rotation_x(lean);
        let size = Vec3::new(
            random.random_range(0.17..0.25),
            random.random_range(0.22..0.32),
            thickness,
        );
        let placement = Affine3A::from_rotation_translation(turn, foot);
        builder.placed_cuboid(&placement, Vec3::ZERO, size);
    }
}

/// A wave of `periods` over a fraction, for pleats and folds.
pub(super) fn folds(fraction: f32, periods: f32) -> f32 {
    (fraction * periods * TAU).sin()
}
