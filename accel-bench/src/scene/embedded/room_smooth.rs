//! The smooth things in the room: bodies of revolution, tubes and cloth.

use std::f32::consts::{PI, TAU};

use accel_core::glam::Vec3;

use super::room::folds;
use super::shapes::{MeshBuilder, arc_height, cells, full_turn};

/// Something in the room that may have any number of triangles.
pub(super) struct Thing {
    /// Its part of the triangles.
    pub(super) weight: f32,
    /// Builds it of about so many.
    pub(super) build: fn(&mut MeshBuilder, usize),
}

/// What stands in the room; a sparse room has only the first few.
pub(super) fn things(sparse: bool) -> &'static [Thing] {
    const THINGS: &[Thing] = &[
        thing(4.0, pot),
        thing(1.0, spout),
        thing(1.0, handle),
        thing(1.6, lamp_shade),
        thing(0.3, lamp_pole),
        thing(1.5, |builder, n| curtain(builder, -0.95, n)),
        thing(1.5, |builder, n| curtain(builder, 1.05, n)),
        thing(0.7, |builder, n| cup(builder, -1.15, -0.75, n)),
        thing(0.7, |builder, n| cup(builder, -0.05, -0.85, n)),
        thing(0.7, |builder, n| cup(builder, -1.05, -0.3, n)),
        thing(0.7, |builder, n| cup(builder, -0.15, -0.25, n)),
        thing(1.0, bowl),
        thing(0.4, |builder, n| fruit(builder, [0.1, 0.85, -0.58], n)),
        thing(0.4, |builder, n| fruit(builder, [0.2, 0.85, -0.55], n)),
        thing(0.4, |builder, n| fruit(builder, [0.14, 0.85, -0.49], n)),
        thing(0.4, |builder, n| fruit(builder, [0.15, 0.92, -0.54], n)),
        thing(0.8, rug),
        thing(0.2, globe_foot),
        thing(1.5, globe),
    ];
    if sparse { &THINGS[..7] } else { THINGS }
}

const fn thing(weight: f32, build: fn(&mut MeshBuilder, usize)) -> Thing {
    Thing { weight, build }
}

const TABLE: f32 = 0.76;
const POT: Vec3 = Vec3::new(-0.55, TABLE, -0.55);

/// A teapot's body with its lid and knob.
fn pot(builder: &mut MeshBuilder, triangles: usize) {
    builder.revolution(POT, cells(triangles, 1.2, [5, 4]), |v| {
        if v < 0.85 {
            let s = v / 0.85;
            let belly = 0.075 + 0.065 * (0.15 + 0.75 * s * PI).sin();
            (if s > 0.0 { belly } else { 0.0 }, 0.16 * s)
        } else {
            let s = (v - 0.85) / 0.15;
            let knob = 0.075 * (1.0 - s) + 0.018 * (s * PI).sin();
            (if s < 1.0 { knob } else { 0.0 }, 0.16 + 0.055 * s)
        }
    });
}

fn spout(builder: &mut MeshBuilder, triangles: usize) {
    let [sides, steps] = cells(triangles, 0.8, [3, 3]);
    let path: Vec<_> = (0..=steps)
        .map(|i| {
            let t = i as f32 / steps as f32;
            POT + Vec3::new(0.1 + 0.15 * t, 0.05 + 0.12 * t * t * (3.0 - 2.0 * t), 0.0)
        })
        .collect();
    builder.tube(&path, |v| 0.032 - 0.019 * v, sides);
}

fn handle(builder: &mut MeshBuilder, triangles: usize) {
    let [sides, steps] = cells(triangles, 0.6, [3, 4]);
    let path: Vec<_> = (0..=steps)
        .map(|i| {
            let (sin, cos) = (i as f32 / steps as f32 * PI).sin_cos();
            POT + Vec3::new(-0.11 - 0.1 * sin, 0.085 + 0.055 * cos, 0.0)
        })
        .collect();
    builder.tube(&path, |_| 0.012, sides);
}

/// A cup, up the outside and down the inside.
fn cup(builder: &mut MeshBuilder, x: f32, z: f32, triangles: usize) {
    let vessel = |v: f32| hollow(v, |s| (0.024 + 0.028 * s.sqrt(), 0.075 * s), 0.004);
    builder.revolution(
        Vec3::new(x, TABLE, z),
        cells(triangles, 1.6, [5, 4]),
        vessel,
    );
}

fn bowl(builder: &mut MeshBuilder, triangles: usize) {
    let vessel = |v: f32| hollow(v, |s| (0.05 + 0.12 * s.sqrt(), 0.085 * s), 0.008);
    builder.revolution(
        Vec3::new(0.15, TABLE, -0.54),
        cells(triangles, 2.0, [5, 4]),
        vessel,
    );
}

/// A vessel's profile: its foot closed, its `wall` (radius and height by fraction
/// of the height) up the outside, over the rim, and down the inside.
fn hollow(v: f32, wall: impl Fn(f32) -> (f32, f32), thickness: f32) -> (f32, f32) {
    if v <= 0.0 || v >= 1.0 {
        return (0.0, if v <= 0.0 { 0.0 } else { thickness });
    }
    let outside = v < 0.55;
    let s = if outside { v / 0.55 } else { (1.0 - v) / 0.45 };
    let (radius, height) = wall(s);
    if outside {
        (radius, height)
    } else {
        (radius - thickness, height.max(thickness))
    }
}

fn fruit(builder: &mut MeshBuilder, center: [f32; 3], triangles: usize) {
    builder.sphere(center.into(), 0.052, cells(triangles, 2.0, [5, 3]));
}

const LAMP: Vec3 = Vec3::new(1.9, 0.0, -2.3);

/// A pleated shade, open above and below.
fn lamp_shade(builder: &mut MeshBuilder, triangles: usize) {
    builder.grid(cells(triangles, 8.0, [7, 1]), |u, v| {
        let (sin, cos) = full_turn(u);
        let radius = (0.28 - 0.12 * v) * (1.0 + 0.03 * folds(u, 24.0));
        LAMP + Vec3::new(radius * cos, 1.45 + 0.32 * v, -radius * sin)
    });
}

/// A foot and the pole on it.
fn lamp_pole(builder: &mut MeshBuilder, triangles: usize) {
    let sides = (triangles / 8).max(3);
    builder.revolution(LAMP, [sides, 4], |v| match (v * 4.0).round() as u32 {
        0 => (0.17, 0.0),
        1 => (0.15, 0.03),
        2 => (0.014, 0.05),
        3 => (0.014, 1.6),
        _ => (0.0, 1.61),
    });
}

/// A curtain beside the window, gathered at its middle.
fn curtain(builder: &mut MeshBuilder, middle: f32, triangles: usize) {
    builder.grid(cells(triangles, 2.5, [6, 1]), |u, v| {
        let gathered = 1.0 - 0.5 * arc_height(v);
        let x = middle + (u - 0.5) * 0.7 * gathered;
        let depth = 0.045 * folds(u, 7.0) * (0.6 + 0.4 * gathered);
        Vec3::new(x, 0.15 + 2.3 * v, -2.86 + depth)
    });
}

/// A rug with a slight waviness.
fn rug(builder: &mut MeshBuilder, triangles: usize) {
    builder.grid(cells(triangles, 0.7, [2, 2]), |u, v| {
        let height = 0.012 + 0.006 * (u * 9.0 * TAU / 4.0).sin() * (v * 7.0).cos();
        Vec3::new(-1.9 + 2.8 * v, height, -1.9 + 2.6 * u)
    });
}

const GLOBE: Vec3 = Vec3::new(0.95, 0.95, -2.1);

/// A turned stand on the floor.
fn globe_foot(builder: &mut MeshBuilder, triangles: usize) {
    let foot = Vec3::new(GLOBE.x, 0.0, GLOBE.z);
    builder.revolution(foot, cells(triangles, 0.8, [5, 4]), |v| {
        let turned = 0.035 + 0.02 * (v * 5.0 * TAU).sin() * arc_height(v);
        (turned + 0.16 * (1.0 - v).powi(6), 0.66 * v)
    });
}

fn globe(builder: &mut MeshBuilder, triangles: usize) {
    builder.sphere(GLOBE, 0.3, cells(triangles, 2.0, [6, 4]));
}
