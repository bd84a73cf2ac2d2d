//! A hall of columns under arches and a barrel vault: long coarse walls beside
//! finely cut capitals, as in the atriums that renderers are tested with.

use std::f32::consts::{PI, TAU};

use accel_core::glam::Vec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::shapes::{MeshBuilder, TriangleBudget, cells, full_turn, turned_about_all_axes};
use crate::scene::{Mesh, camera::Camera};

const LENGTH: f32 = 40.0;
/// From the middle to the outer walls.
const HALF_WIDTH: f32 = 7.0;
/// From the middle to the columns.
const NAVE: f32 = 3.2;
const AISLE_HEIGHT: f32 = 6.8;
/// Where the arches begin.
const IMPOST: f32 = 4.0;
/// Where the vault begins.
const CORNICE: f32 = 7.4;
const WALL: f32 = 0.5;

/// The upright hall, its long axis along x. The seed turns each capital's leaves.
/// The number of bays grows with the count until there are 13, from there only
/// the detail.
pub fn colonnade(triangles: usize, seed: u64) -> Mesh {
    build(triangles, seed).finish()
}

/// The hall turned by 45 degrees about all three axes, as Stich 2009, section 5,
/// turns Sponza.
pub fn colonnade_45(triangles: usize, seed: u64) -> Mesh {
    let mut builder = build(triangles, seed);
    builder.transform(&turned_about_all_axes());
    builder.finish()
}

/// Along the nave, and across it from an aisle.
pub fn cameras() -> Vec<Camera> {
    vec![
        Camera::upright([-18.6, 2.3, 1.1], [0.0, 3.6, -0.6], 64.0),
        Camera::upright([-6.0, 1.8, 6.3], [2.0, 3.8, -3.0], 66.0),
    ]
}

/// The same views of the turned hall.
pub fn cameras_45() -> Vec<Camera> {
    let turn = turned_about_all_axes();
    let turned = |camera: Camera| Camera {
        eye: turn.transform_point3(camera.eye),
        look_at: turn.transform_point3(camera.look_at),
        up: turn.transform_vector3(camera.up),
        ..camera
    };
    cameras().into_iter().map(turned).collect()
}

fn build(triangles: usize, seed: u64) -> MeshBuilder {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut builder = MeshBuilder::default();
    let bays = (((triangles as f32).sqrt() / 12.0).round() as usize).clamp(2, 13);
    shell(&mut builder);
    let (columns, arches) = feet(bays);
    for &foot in &columns {
        slabs(&mut builder, foot);
    }
    // An arch gets a third of what a column gets.
    let weight = columns.len() as f32 + arches.len() as f32 / 3.0;
    let mut budget = TriangleBudget::new(triangles, weight);
    for &foot in &arches {
        let share = budget.share(builder.triangle_count(), 1.0 / 3.0);
        arch(&mut builder, foot, LENGTH / bays as f32, share);
    }
    for &foot in &columns {
        column(&mut builder, &mut budget, foot, random.random::<f32>());
    }
    builder
}

/// Where the columns stand, and where the arches begin.
fn feet(bays: usize) -> (Vec<Vec3>, Vec<Vec3>) {
    let place = |bay: usize, z: f32| {
        let x = (bay as f32 / bays as f32 - 0.5) * LENGTH;
        Vec3::new(x, 0.0, z)
    };
    let arches = [-NAVE, NAVE].map(|z| (0..bays).map(move |bay| place(bay, z)));
    let arches: Vec<_> = arches.into_iter().flatten().collect();
    let is_column = |foot: &Vec3| foot.x > -LENGTH / 2.0;
    (arches.iter().copied().filter(is_column).collect(), arches)
}

/// Floor, walls, ceilings, vault and cornices: few large triangles.
fn shell(builder: &mut MeshBuilder) {
    let start = Vec3::X * (-LENGTH / 2.0);
    let along = Vec3::X * LENGTH;
    let across = Vec3::Z * (2.0 * HALF_WIDTH);
    let top = Vec3::Y * (CORNICE + NAVE);
    let left = start - Vec3::Z * HALF_WIDTH;
    builder.quad(left, across, along, [3, 1]);
    builder.quad(left, top, across, [1, 1]);
    builder.quad(left + along, across, top, [1, 1]);
    let aisle = Vec3::Y * AISLE_HEIGHT;
    builder.quad(left, along, aisle, [1, 1]);
    builder.quad(left + across, aisle, along, [1, 1]);
    let roof = Vec3::Z * (HALF_WIDTH - NAVE);
    builder.quad(left + aisle, along, roof, [1, 1]);
    builder.quad(left + aisle + across - roof, along, roof, [1, 1]);
    builder.grid([1, 10], |u, v| {
        let (sin, cos) = (v * PI).sin_cos();
        start + along * u + Vec3::new(0.0, CORNICE + NAVE * sin, -NAVE * cos)
    });
    for side in [-1.0, 1.0] {
        let middle = Vec3::new(0.0, CORNICE - 0.15, side * (NAVE - WALL / 2.0));
        let half = Vec3::new(LENGTH / 2.0, 0.15, 0.2);
        builder.cuboid(middle - half, middle + half);
    }
}

/// A column's square plinth below and abacus above.
fn slabs(builder: &mut MeshBuilder, foot: Vec3) {
    for (half, bottom, top) in [(0.55, 0.0, 0.2), (0.52, IMPOST - 0.2, IMPOST)] {
        builder.cuboid(
            foot + Vec3::new(-half, bottom, -half),
            foot + Vec3::new(half, top, half),
        );
    }
}

/// Moulded base, fluted shaft of skinny triangles, and leaved capital.
fn column(builder: &mut MeshBuilder, budget: &mut TriangleBudget, foot: Vec3, turn: f32) {
    let base = cells(budget.share(builder.triangle_count(), 0.17), 4.0, [5, 1]);
    builder.revolution(foot + Vec3::Y * 0.2, base, |v| {
        (0.5 - 0.12 * v + 0.04 * (v * TAU * 1.5).sin(), v * 0.35)
    });
    let sides = (budget.share(builder.triangle_count(), 0.13) / 2).max(5);
    let flutes = if sides >= 32 { 0.02 } else { 0.0 };
    builder.grid([sides, 1], |u, v| {
        let (sin, cos) = full_turn(u);
        let radius = 0.38 - 0.06 * v + flutes * (u * TAU * 16.0).cos();
        foot + Vec3::new(radius * cos, 0.55 + 2.55 * v, -radius * sin)
    });
    let capital = cells(budget.share(builder.triangle_count(), 0.7), 2.5, [5, 2]);
    builder.grid(capital, |u, v| {
        let (sin, cos) = full_turn(u);
        let bell = 0.3 + 0.2 * v * v * v;
        // Two rows of eight leaves that bend outwards at their tips.
        let (row, tip) = ((v * 2.0).floor(), (v * 2.0).fract());
        let leaf = (TAU * (8.0 * u + 0.5 * row + turn)).cos().max(0.0);
        let radius = bell + 0.09 * leaf * tip * tip;
        foot + Vec3::new(radius * cos, 3.1 + 0.7 * v, -radius * sin)
    });
}

/// A round arch over one bay with the wall above it, and a moulding along its
/// rim towards the nave.
fn arch(builder: &mut MeshBuilder, from: Vec3, span: f32, triangles: usize) {
    const MOULDING_SIDES: usize = 4;
    let steps = (triangles.saturating_sub(12) / (6 + 2 * MOULDING_SIDES)).max(3);
    let radius = span / 2.0 - 0.35;
    let rise = radius.min(CORNICE - IMPOST - 0.9);
    let curve = (0..=steps).map(|i| {
        let (sin, cos) = (i as f32 / steps as f32 * PI).sin_cos();
        from + Vec3::new(span / 2.0 - radius * cos, IMPOST + rise * sin, 0.0)
    });
    let curve: Vec<_> = curve.collect();
    // The wall's lower edge: the curve, and what rests on the columns.
    let mut edge = vec![from + Vec3::Y * IMPOST];
    edge.extend(&curve);
    edge.push(edge[0] + Vec3::X * span);
    let parts = edge.len() - 1;
    let below = |u: f32, z: f32| edge[(u * parts as f32).round() as usize] + Vec3::Z * z;
    let wall = |u: f32, v: f32, z: f32| {
        let low = below(u, z);
        low.lerp(low.with_y(CORNICE), v)
    };
    builder.grid([parts, 1], |u, v| wall(u, v, WALL / 2.0));
    builder.grid([parts, 1], |u, v| wall(1.0 - u, v, -WALL / 2.0));
    builder.grid([parts, 1], |u, v| below(1.0 - u, WALL * (v - 0.5)));
    let to_the_nave = Vec3::Z * (-WALL / 2.0 * from.z.signum());
    let rim: Vec<_> = curve.iter().map(|&point| point + to_the_nave).collect();
    builder.tube(&rim, |_| 0.07, MOULDING_SIDES);
}
