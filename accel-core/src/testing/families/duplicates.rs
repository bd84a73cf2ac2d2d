//! Scenes in which no plane parts the primitives: all in one place.

use glam::Vec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::random::{point_in_cube, sign};
use super::Family;
use super::shapes::{repeated, soup, triangle_near};
use crate::Triangle;

pub(super) const FAMILIES: &[Family] = &[
    Family::new(
        "one-point",
        "Every triangle is the same point.",
        1_000_000,
        one_point,
    ),
    Family::new(
        "one-point-neighbours",
        "Corners at one point or at its neighbours in f32: centroids that \
         differ by a last bit, bins without width.",
        100_000,
        one_point_neighbours,
    ),
    Family::new(
        "duplicates",
        "One sound triangle over and over: hits tie at the same t.",
        100_000,
        duplicates,
    ),
    Family::new(
        "duplicates-of-few",
        "Ten triangles, each repeated many times in random order.",
        20_000,
        duplicates_of_few,
    ),
    Family::new(
        "duplicates-turned",
        "One triangle with its corners in all six orders: ties in t with \
         different u and v, facing both ways.",
        20_000,
        duplicates_turned,
    ),
    Family::new(
        "duplicates-opposite",
        "Every triangle of a soup twice, once from each side.",
        20_000,
        duplicates_opposite,
    ),
    Family::new(
        "nested-centroids",
        "Triangles nested in one another with one centroid, by the corners' \
         mean as well as by the box.",
        10_000,
        nested_centroids,
    ),
];

fn one_point(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    vec![[point_in_cube(rng); 3].into(); count]
}

fn one_point_neighbours(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let point = point_in_cube(rng);
    let mut neighbour = || {
        let coordinates = point.to_array();
        Vec3::from_array(coordinates.map(|x| if rng.random() { x.next_up() } else { x }))
    };
    repeated(count, || [(); 3].map(|()| neighbour()).into())
}

fn duplicates(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    vec![triangle_near(rng, Vec3::ZERO, 1.0); count]
}

fn duplicates_of_few(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let few = soup(rng, 10, 0.5);
    repeated(count, || few[rng.random_range(0..few.len())])
}

fn duplicates_turned(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let triangle = triangle_near(rng, Vec3::ZERO, 1.0);
    repeated(count, || {
        let mut corners = triangle.vertices();
        corners.rotate_left(rng.random_range(0..3));
        if rng.random() {
            corners.swap(0, 1);
        }
        corners.into()
    })
}

fn duplicates_opposite(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let front = soup(rng, count / 2, 0.2);
    let back = front.iter().map(|t| Triangle::new(t.a, t.c, t.b));
    front.iter().copied().chain(back).collect()
}

/// In every axis the corners lie at -s, 0 and s from the center, which is
/// exact: sizes are multiples of 2^-10 and the center has small integers.
fn nested_centroids(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let center = (4.0 * point_in_cube(rng)).round();
    let nested = |size: f32, flip: Vec3| {
        let corners = [[-1.0, 1.0, 0.0], [1.0, 0.0, -1.0], [0.0, -1.0, 1.0]];
        corners
            .map(|corner| center + size * flip * Vec3::from_array(corner))
            .into()
    };
    (1..=count)
        .map(|index| {
            let flip = Vec3::new(sign(rng), sign(rng), sign(rng));
            nested(index as f32 / 1024.0, flip)
        })
        .collect()
}
