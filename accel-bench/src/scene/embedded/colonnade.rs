//! A hall of columns under arches: long coarse walls beside fine capitals, as
//! in the atriums that renderers are tested with.

use std::f32::consts::PI;

use accel_core::glam::Vec3;

use super::builder::{MeshBuilder, turned};
use crate::scene::Mesh;

const LENGTH: f32 = 40.0;
const WIDTH: f32 = 14.0;
const HEIGHT: f32 = 8.0;
const COLUMNS: usize = 12;
const ROWS: [f32; 4] = [-4.5, -2.0, 2.0, 4.5];

/// Upright.
pub(super) fn mesh(triangles: usize) -> Mesh {
    build(triangles).finish()
}

/// Turned by 45 degrees about all three axes.
pub(super) fn turned_mesh(triangles: usize) -> Mesh {
    let mut builder = build(triangles);
    builder.rotate(turned());
    builder.finish()
}

fn build(triangles: usize) -> MeshBuilder {
    let mut builder = MeshBuilder::default();
    hall(&mut builder);
    let shafts = COLUMNS * ROWS.len();
    let per_column = triangles.saturating_sub(builder.triangles()) as f32 / shafts as f32;
    // A column with its arch has about 6 d^2 + 24 d + 24 triangles.
    let detail = ((6.0 * (per_column - 24.0).max(0.0) + 144.0).sqrt() - 12.0) / 6.0;
    let detail = (detail.round() as usize).max(3);
    for row in ROWS {
        for column in 0..COLUMNS {
            let x = (column as f32 + 0.5) / COLUMNS as f32 * LENGTH - LENGTH / 2.0;
            column_at(&mut builder, Vec3::new(x, 0.0, row), detail);
            if column + 1 < COLUMNS {
                arch(&mut builder, Vec3::new(x, 4.6, row), detail);
            }
        }
    }
    builder
}

/// Floor, ceiling with beams, and walls: few large triangles.
fn hall(builder: &mut MeshBuilder) {
    let corner = Vec3::new(-LENGTH / 2.0, 0.0, -WIDTH / 2.0);
    let (along, across, up) = (Vec3::X * LENGTH, Vec3::Z * WIDTH, Vec3::Y * HEIGHT);
    builder.quad(corner, across, along, 2);
    builder.quad(corner + up, along, across, 2);
    builder.quad(corner, along, up, 2);
    builder.quad(corner + across, up, along, 2);
    builder.quad(corner, up, across, 2);
    builder.quad(corner + along, across, up, 2);
    for beam in 0..20 {
        let x = (beam as f32 + 0.5) / 20.0 * LENGTH - LENGTH / 2.0;
        let min = Vec3::new(x - 0.12, HEIGHT - 0.4, -WIDTH / 2.0);
        builder.cuboid(min, Vec3::new(x + 0.12, HEIGHT, WIDTH / 2.0));
    }
}

fn column_at(builder: &mut MeshBuilder, base: Vec3, detail: usize) {
    builder.cuboid(
        base + Vec3::new(-0.5, 0.0, -0.5),
        base + Vec3::new(0.5, 0.2, 0.5),
    );
    // A shaft of skinny triangles, fluted by its facets.
    builder.revolution(base + Vec3::Y * 0.6, detail * 2, 1, |v| {
        (0.34 - 0.05 * v, v * 3.2)
    });
    builder.revolution(base + Vec3::Y * 0.2, detail * 2, detail / 2 + 1, |v| {
        (0.36 + 0.1 * (v * PI).sin(), v * 0.4)
    });
    builder.revolution(base + Vec3::Y * 3.8, detail * 2, detail, |v| {
        (0.3 + 0.2 * v * v + 0.03 * (v * 9.0 * PI).sin(), v * 0.6)
    });
    builder.cuboid(
        base + Vec3::new(-0.55, 4.4, -0.55),
        base + Vec3::new(0.55, 4.6, 0.55),
    );
}

/// A thin arch from one column to the next.
fn arch(builder: &mut MeshBuilder, from: Vec3, detail: usize) {
    let span = LENGTH / COLUMNS as f32;
    let rim = |u: f32, radius: f32, z: f32| {
        let angle = PI * (1.0 - u);
        from + Vec3::new(span / 2.0 + radius * angle.cos(), radius * angle.sin(), z)
    };
    let (inner, outer) = (span / 2.0 - 0.35, span / 2.0 - 0.05);
    let steps = detail * 2;
    builder.grid(steps, 1, |u, v| rim(u, inner, 0.25 - v * 0.5));
    builder.grid(steps, 1, |u, v| rim(u, outer, v * 0.5 - 0.25));
    builder.grid(steps, 1, |u, v| rim(u, inner + (outer - inner) * v, -0.25));
    builder.grid(steps, 1, |u, v| rim(u, outer + (inner - outer) * v, 0.25));
}
