//! Scenes of nothing, of next to nothing, and of triangles without area.

use glam::Vec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::random::{point_in_cube, uniform};
use super::Family;
use super::shapes::{repeated, soup, triangle_near};
use crate::Triangle;

pub(super) const FAMILIES: &[Family] = &[
    Family::new("empty", "No triangle at all.", 0, empty),
    Family::new("one-triangle", "A tree of a single leaf.", 1, one_triangle),
    Family::new(
        "points",
        "Triangles with three equal corners, boxes without extent.",
        20_000,
        points,
    ),
    Family::new(
        "lines-repeated-vertex",
        "Triangles with two equal corners, in every arrangement.",
        20_000,
        lines_repeated_vertex,
    ),
    Family::new(
        "lines-collinear",
        "Triangles whose three distinct corners lie on a line exactly.",
        20_000,
        lines_collinear,
    ),
    Family::new(
        "lines-axis-parallel",
        "Lines along the axes: boxes with extent in one axis only.",
        20_000,
        lines_axis_parallel,
    ),
    Family::new(
        "degenerate-mixed",
        "Points and lines scattered among sound triangles.",
        20_000,
        mixed,
    ),
];

fn empty(_: &mut Pcg64Mcg, _: usize) -> Vec<Triangle> {
    Vec::new()
}

fn one_triangle(rng: &mut Pcg64Mcg, _: usize) -> Vec<Triangle> {
    vec![triangle_near(rng, Vec3::ZERO, 1.0)]
}

fn points(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    repeated(count, || [point_in_cube(rng); 3].into())
}

fn lines_repeated_vertex(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    repeated(count, || {
        let (a, b) = (point_in_cube(rng), point_in_cube(rng));
        let mut corners = [a, a, b];
        corners.rotate_left(rng.random_range(0..3));
        corners.into()
    })
}

/// Small multiples of 1/64 are exact in f32, and so is the collinearity.
fn lines_collinear(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let mut exact = |limit: i32| {
        let coordinates = [(); 3].map(|()| rng.random_range(-limit..=limit) as f32 / 64.0);
        (Vec3::from_array(coordinates), rng.random_range(0..3))
    };
    repeated(count, || {
        let (start, turn) = exact(64);
        let (step, _) = exact(8);
        let mut corners = [start, start + step, start + 3.0 * step];
        corners.rotate_left(turn);
        corners.into()
    })
}

fn lines_axis_parallel(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    repeated(count, || {
        let axis = Vec3::AXES[rng.random_range(0..3)];
        let start = point_in_cube(rng);
        let end = start + axis * uniform(rng, 0.1, 1.0);
        Triangle::new(start, end, start.lerp(end, 0.5))
    })
}

fn mixed(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let mut scene = soup(rng, count, 0.1);
    for triangle in &mut scene {
        match rng.random_range(0..6) {
            0 => *triangle = [triangle.a; 3].into(),
            1 => triangle.b = triangle.a,
            2 => triangle.c = triangle.a.lerp(triangle.b, 0.5),
            _ => {}
        }
    }
    scene
}
