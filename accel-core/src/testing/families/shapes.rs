//! Building blocks of scenes.

use glam::{Mat3, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use crate::Triangle;
use crate::testing::{cube_point, direction};

/// `count` triangles, each made from its number.
pub(super) fn repeat(count: usize, triangle: impl FnMut(usize) -> Triangle) -> Vec<Triangle> {
    (0..count).map(triangle).collect()
}

/// A triangle of about this size around `center`.
pub(super) fn around(random: &mut Pcg64Mcg, center: Vec3, size: f32) -> Triangle {
    Triangle::from([(); 3].map(|()| center + cube_point(random) * size))
}

/// A strip from `from` to `to` of this width, two triangles, in a random plane
/// through its middle line.
pub(super) fn strip(random: &mut Pcg64Mcg, from: Vec3, to: Vec3, width: f32) -> [Triangle; 2] {
    let side = (to - from).cross(direction(random)).normalize_or_zero() * width;
    quad([from, to, to + side, from + side])
}

/// Two triangles.
pub(super) fn quad([a, b, c, d]: [Vec3; 4]) -> [Triangle; 2] {
    [Triangle::from([a, b, c]), Triangle::from([a, c, d])]
}

/// A grid of `columns` by `rows` quads; `corner` places its vertices, so that
/// neighbours share them bit for bit.
pub(super) fn grid(
    columns: usize,
    rows: usize,
    corner: impl Fn(usize, usize) -> Vec3,
) -> Vec<Triangle> {
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    cells
        .flat_map(|(x, y)| {
            quad([
                corner(x, y),
                corner(x + 1, y),
                corner(x + 1, y + 1),
                corner(x, y + 1),
            ])
        })
        .collect()
}

/// The side of a square grid of at most `triangles` triangles.
pub(super) fn grid_side(triangles: usize) -> usize {
    (((triangles / 2) as f64).sqrt() as usize).max(1)
}

/// A sphere of latitude and longitude bands with shared vertices.
pub(super) fn sphere(center: Vec3, radius: f32, triangles: usize) -> Vec<Triangle> {
    use std::f32::consts::{PI, TAU};
    let side = grid_side(triangles).max(3);
    grid(side, side, |x, y| {
        // The seam and the poles must come out the same from both sides.
        let around = if x == side {
            0.0
        } else {
            x as f32 / side as f32 * TAU
        };
        let down = y as f32 / side as f32 * PI;
        let ring = if y == 0 || y == side { 0.0 } else { down.sin() };
        center + Vec3::new(ring * around.cos(), down.cos(), ring * around.sin()) * radius
    })
}

/// Turns by 45 degrees about all three axes.
pub(super) fn turned() -> Mat3 {
    use std::f32::consts::FRAC_PI_4;
    Mat3::from_rotation_x(FRAC_PI_4)
        * Mat3::from_rotation_y(FRAC_PI_4)
        * Mat3::from_rotation_z(FRAC_PI_4)
}

/// All corners moved by `place`.
pub(super) fn mapped(scene: Vec<Triangle>, place: impl Fn(Vec3) -> Vec3) -> Vec<Triangle> {
    let moved = scene
        .into_iter()
        .map(|triangle| triangle.vertices().map(&place));
    moved.map(Triangle::from).collect()
}

/// Triangles of about this size everywhere in a cube of side 2.
pub(super) fn soup(random: &mut Pcg64Mcg, count: usize, size: f32) -> Vec<Triangle> {
    repeat(count, |_| {
        let center = cube_point(random);
        around(random, center, size)
    })
}

/// A size from `2^low` to `2^high`, all powers alike.
pub(super) fn power_of_two(random: &mut Pcg64Mcg, low: i32, high: i32) -> f32 {
    2.0_f32.powi(random.random_range(low..high))
}
