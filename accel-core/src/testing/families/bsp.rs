//! Scenes that plane splits cut to pieces.

use std::f32::consts::TAU;

use glam::Vec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::random::{point_in_cube, rotation, uniform, unit_vector};
use super::Family;
use super::shapes::{moved, repeated};
use crate::Triangle;

pub(super) const FAMILIES: &[Family] = &[
    Family::new(
        "bsp-quadratic-saddle",
        "Two orthogonal families of long slivers just above and below the \
         saddle z = xy: a BSP needs quadratically many pieces.",
        2_000,
        saddle,
    ),
    Family::new(
        "bsp-quadratic-combs",
        "Three orthogonal combs of slivers: every axis-aligned plane between \
         two teeth cuts a whole comb.",
        2_000,
        combs,
    ),
    Family::new(
        "straddling-book",
        "Pages around a common edge: every plane but the pages' own cuts most.",
        2_000,
        book,
    ),
    Family::new(
        "straddling-through-center",
        "Large triangles in all poses, each with the origin inside it.",
        2_000,
        through_center,
    ),
    Family::new(
        "straddling-umbrella",
        "A cone of long triangles that share their tip.",
        2_000,
        umbrella,
    ),
    Family::new(
        "cyclic-overlap",
        "Rings of bars, each lying on the next: no order exists without a cut.",
        2_000,
        cyclic_overlap,
    ),
];

/// Lines of the two rulings of the saddle (Paterson and Yao 1990 give this
/// lower bound for BSPs in space).
fn saddle(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let lines = count.div_ceil(2);
    let [gap, width] = [uniform(rng, 1e-4, 1e-2), uniform(rng, 1e-5, 1e-3)];
    let along_x = |y: f32| {
        let end = |x: f32| Vec3::new(x, y, x * y + gap);
        Triangle::new(end(-1.0), end(1.0), end(1.0) + width * Vec3::Y)
    };
    let along_y = |x: f32| {
        let end = |y: f32| Vec3::new(x, y, x * y - gap);
        Triangle::new(end(-1.0), end(1.0), end(1.0) + width * Vec3::X)
    };
    (0..lines)
        .map(|line| 2.0 * (line as f32 + 0.5) / lines as f32 - 1.0)
        .flat_map(|position| [along_x(position), along_y(position)])
        .collect()
}

fn combs(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let teeth = count.div_ceil(3);
    let side = teeth.isqrt().max(1);
    let width = uniform(rng, 0.01, 0.1);
    let tooth = |index: usize, axis: usize| {
        let shift = axis as f32 / 3.0;
        let mut start = [-0.5; 3];
        start[(axis + 1) % 3] = (index % side) as f32 + shift;
        start[(axis + 2) % 3] = (index / side) as f32 + shift;
        let start = Vec3::from_array(start);
        let end = start + (side as f32 + 1.0) * Vec3::AXES[axis];
        Triangle::new(start, end, end + width * Vec3::AXES[(axis + 1) % 3])
    };
    (0..teeth)
        .flat_map(|index| [0, 1, 2].map(|axis| tooth(index, axis)))
        .collect()
}

fn book(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let turn = rotation(rng);
    let page = |index: usize| {
        let (sine, cosine) = (index as f32 / count as f32 * TAU).sin_cos();
        let edge = turn * Vec3::Z;
        Triangle::new(-edge, edge, turn * Vec3::new(cosine, sine, 0.0))
    };
    (0..count).map(page).collect()
}

fn through_center(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    repeated(count, || {
        let (a, b) = (unit_vector(rng), unit_vector(rng));
        Triangle::new(a, b, -0.5 * (a + b))
    })
}

fn umbrella(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let turn = rotation(rng);
    let rim = |index: usize| {
        let (sine, cosine) = ((index % count) as f32 / count as f32 * TAU).sin_cos();
        turn * Vec3::new(cosine, sine, -0.5)
    };
    let panel = |index| Triangle::new(Vec3::ZERO, rim(index), rim(index + 1));
    (0..count).map(panel).collect()
}

/// Each bar starts under its predecessor and ends over its successor.
fn cyclic_overlap(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    const BARS: usize = 5;
    let mut ring = || {
        let center = 2.0 * point_in_cube(rng);
        let turn = rotation(rng);
        let size = 0.1 + 0.2 * rng.random::<f32>();
        let bars: Vec<_> = (0..BARS).map(bar).collect();
        moved(&bars, |vertex| center + turn * (size * vertex))
    };
    (0..count.div_ceil(BARS)).flat_map(|_| ring()).collect()
}

fn bar(index: usize) -> Triangle {
    let end = |step: f32, radius: f32, height: f32| {
        let angle = (index as f32 + step) / 5.0 * TAU;
        Vec3::new(radius * angle.cos(), radius * angle.sin(), height)
    };
    Triangle::new(end(-0.2, 0.9, -0.1), end(1.2, 0.9, 0.1), end(1.2, 1.1, 0.1))
}
