//! Triangles far longer than wide, and those that fill boxes badly.

use std::f32::consts::TAU;

use glam::{Quat, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::random::{point_in_cube, rotation, uniform, unit_vector};
use super::Family;
use super::shapes::{moved, repeated, surface};
use crate::Triangle;

pub(super) const FAMILIES: &[Family] = &[
    Family::new(
        "slivers-1e-7",
        "Triangles of width 1e-7 and length 1, along an axis and askew.",
        20_000,
        slivers_askew,
    ),
    Family::new(
        "slivers-1e-15",
        "Triangles of width 1e-15 and length 1.",
        20_000,
        |rng, count| slivers(rng, count, 1e-15),
    ),
    Family::new(
        "slivers-1e-30",
        "Triangles of width 1e-30 and length 1: areas underflow when squared.",
        20_000,
        |rng, count| slivers(rng, count, 1e-30),
    ),
    Family::new(
        "skinny-cylinder-rotated",
        "A tilted cylinder of skinny triangles over its whole length (Ize \
         2008, section 5, has 596).",
        596,
        skinny_cylinder,
    ),
    Family::new(
        "needles-crossed",
        "Needles along all three axes through one small region.",
        4_000,
        needles_crossed,
    ),
    Family::new(
        "long-diagonals",
        "Thin triangles along the scene's diagonals: every box is the whole.",
        4_000,
        long_diagonals,
    ),
    Family::new(
        "hairball",
        "Curved strands of thin triangles growing out of a ball.",
        20_000,
        hairball,
    ),
];

/// The thin axis only holds small multiples of `width`, or else rounding
/// would swallow it.
fn slivers(rng: &mut Pcg64Mcg, count: usize, width: f32) -> Vec<Triangle> {
    repeated(count, || {
        let thin = rng.random_range(0..3);
        let long = Vec3::AXES[(thin + rng.random_range(1..3)) % 3];
        let mut start = point_in_cube(rng);
        start[thin] = width * rng.random_range(-8..=8) as f32;
        let mut apex = start + 0.5 * long;
        apex[thin] += width;
        Triangle::new(start, start + long, apex)
    })
}

fn slivers_askew(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let turn = rotation(rng);
    let mut scene = slivers(rng, count, 1e-7);
    let askew = moved(&scene[count / 2..], |vertex| turn * vertex);
    scene.truncate(count / 2);
    scene.extend(askew);
    scene
}

fn skinny_cylinder(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let segments = (count / 2).max(3);
    let turn = rotation(rng);
    surface(segments, 1, |column, row| {
        let angle = (column % segments) as f32 / segments as f32 * TAU;
        let (sine, cosine) = angle.sin_cos();
        turn * Vec3::new(cosine, sine, 20.0 * row as f32 - 10.0)
    })
}

fn needles_crossed(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    repeated(count, || {
        let along = Vec3::AXES[rng.random_range(0..3)];
        let middle = 0.1 * point_in_cube(rng);
        let width = 1e-3 * unit_vector(rng);
        Triangle::new(middle - along, middle + along, middle + width)
    })
}

fn long_diagonals(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    repeated(count, || {
        let mut corner = Vec3::ONE;
        corner[rng.random_range(0..3)] *= if rng.random() { 1.0 } else { -1.0 };
        let shift = 0.05 * point_in_cube(rng);
        let width = 0.01 * unit_vector(rng);
        Triangle::new(shift - corner, shift + corner, shift + corner + width)
    })
}

fn hairball(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    const JOINTS: usize = 16;
    let strands = count.div_ceil(2 * JOINTS);
    let mut strand = || {
        let (root, growth) = (unit_vector(rng), unit_vector(rng));
        let curl = Quat::from_axis_angle(unit_vector(rng).normalize(), uniform(rng, 0.0, 0.3));
        let width = 0.004 * unit_vector(rng);
        let mut joints = vec![root];
        let mut step = 0.2 * (root + 0.5 * growth);
        for joint in 0..JOINTS {
            joints.push(joints[joint] + step);
            step = curl * step;
        }
        surface(JOINTS, 1, |column, row| joints[column] + row as f32 * width)
    };
    (0..strands).flat_map(|_| strand()).collect()
}
