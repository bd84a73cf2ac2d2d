//! The teapot in a stadium: a dense figure in a coarse scene a million times
//! its size.
//!
//! Both parts are public, so that a test can compare the cost of rays aimed
//! at the figure alone and in its surroundings.

use std::f32::consts::{PI, TAU};

use glam::Vec3;
use rand_pcg::Pcg64Mcg;

use super::super::random::uniform;
use super::Family;
use super::shapes::{moved, square_side, surface};
use crate::Triangle;

pub(super) const FAMILIES: &[Family] = &[
    Family::new(
        "dense-figure",
        "A figure like a teapot: a turned body, a handle and a spout.",
        20_000,
        |rng, count| placed(&figure(count), rng),
    ),
    Family::new(
        "figure-in-stadium",
        "The dense figure of size 1 in a coarse bowl of size 10^6.",
        20_000,
        figure_in_stadium,
    ),
];

/// A figure like a teapot of about `triangles` triangles, some 2 units wide
/// and standing at the origin.
pub fn figure(triangles: usize) -> Vec<Triangle> {
    let body_rows = square_side(triangles / 2);
    let mut figure = turned_body(body_rows);
    let rest = triangles.saturating_sub(figure.len());
    let tube_side = square_side(rest / 2);
    figure.extend(tube(tube_side, handle_point, |_| 0.08));
    figure.extend(tube(tube_side, spout_point, |along| 0.2 - 0.12 * along));
    figure
}

/// An oval bowl of about `triangles` triangles around the origin, 10^6 units
/// long, with its rows rising outwards.
pub fn stadium(triangles: usize) -> Vec<Triangle> {
    let rows = square_side(triangles / 4);
    let segments = (triangles / (2 * rows)).max(3);
    surface(segments, rows, |column, row| {
        let (sine, cosine) = turn(column, segments).sin_cos();
        let outward = row as f32 / rows as f32;
        let radius = 2.5e5 * (1.0 + outward);
        Vec3::new(
            radius * cosine,
            1e5 * outward * outward,
            0.7 * radius * sine,
        )
    })
}

fn figure_in_stadium(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let coarse = count / 10;
    let mut scene = placed(&figure(count - coarse), rng);
    scene.extend(stadium(coarse));
    scene
}

fn placed(figure: &[Triangle], rng: &mut Pcg64Mcg) -> Vec<Triangle> {
    let place = Vec3::new(uniform(rng, -30.0, 30.0), 0.0, uniform(rng, -30.0, 30.0));
    moved(figure, |vertex| place + vertex)
}

/// The angle of a column; the last is the first, bit for bit.
fn turn(column: usize, columns: usize) -> f32 {
    (column % columns) as f32 / columns as f32 * TAU
}

fn turned_body(rows: usize) -> Vec<Triangle> {
    surface(rows, rows, |column, row| {
        let height = row as f32 / rows as f32;
        let radius = (PI * height).sin().max(0.0).sqrt() * (0.8 - 0.3 * height);
        let (sine, cosine) = turn(column, rows).sin_cos();
        Vec3::new(radius * cosine, 1.2 * height, radius * sine)
    })
}

/// A tube around a curve in the plane z = 0, of a radius that varies along it.
fn tube(side: usize, curve: impl Fn(f32) -> Vec3, radius: impl Fn(f32) -> f32) -> Vec<Triangle> {
    surface(side, side, |column, row| {
        let along = row as f32 / side as f32;
        let tangent = (curve(along + 1e-2) - curve(along - 1e-2)).normalize();
        let across = tangent.cross(Vec3::Z);
        let (sine, cosine) = turn(column, side).sin_cos();
        curve(along) + radius(along) * (cosine * across + sine * Vec3::Z)
    })
}

fn handle_point(along: f32) -> Vec3 {
    let (sine, cosine) = (PI * along).sin_cos();
    Vec3::new(-0.6 - 0.5 * sine, 0.6 + 0.35 * cosine, 0.0)
}

fn spout_point(along: f32) -> Vec3 {
    Vec3::new(0.5 + 0.7 * along, 0.4 + 0.7 * along * along, 0.0)
}
