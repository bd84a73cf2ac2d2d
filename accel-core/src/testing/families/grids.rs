//! Scenes on integer coordinates, where everything ties with everything.

use glam::Vec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::random::{rotation, uniform};
use super::Family;
use super::shapes::{axis_box, moved, quad, surface};
use crate::Triangle;

pub(super) const FAMILIES: &[Family] = &[
    Family::new(
        "axis-grid",
        "All unit squares of a lattice of integer points: every split plane \
         lies in triangles, every box touches others.",
        20_000,
        axis_grid,
    ),
    Family::new(
        "touching-cubes",
        "Closed unit cubes in random cells: shared faces are there twice.",
        20_000,
        touching_cubes,
    ),
    Family::new(
        "integer-soup",
        "Random triangles with corners on few integers: exact ties in \
         centroids, bounds and t.",
        20_000,
        integer_soup,
    ),
    Family::new(
        "staircase",
        "Treads and risers: each step's box meets the next in an edge.",
        20_000,
        staircase,
    ),
    Family::new(
        "staircase-rotated",
        "The staircase in a random pose.",
        20_000,
        staircase_rotated,
    ),
];

/// The largest cube of cells whose squares are within `count` triangles.
fn axis_grid(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let triangles = |side: usize| 6 * side * side * (side + 1);
    let side = (1..).take_while(|&side| triangles(side) <= count).last();
    let side = side.unwrap_or(1);
    let shift = Vec3::from_array([(); 3].map(|()| rng.random_range(-9..=9) as f32));
    let mut grid = Vec::with_capacity(triangles(side));
    for axis in 0..3 {
        for plane in 0..=side {
            grid.extend(surface(side, side, |column, row| {
                let mut point = [plane as f32; 3];
                point[(axis + 1) % 3] = column as f32;
                point[(axis + 2) % 3] = row as f32;
                shift + Vec3::from_array(point)
            }));
        }
    }
    // What is left over thickens a random part of the lattice with duplicates.
    while grid.len() < count {
        grid.push(grid[rng.random_range(0..grid.len())]);
    }
    grid
}

fn touching_cubes(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let cubes = count.div_ceil(12);
    let side = (1..).find(|side| side * side * side >= 2 * cubes);
    let side = side.unwrap_or(1);
    let mut cube = || {
        let cell = [(); 3].map(|()| rng.random_range(0..side) as f32);
        let low = Vec3::from_array(cell);
        axis_box(low, low + 1.0)
    };
    (0..cubes).flat_map(|_| cube()).collect()
}

fn integer_soup(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let mut corner = || Vec3::from_array([(); 3].map(|()| rng.random_range(-4..=4) as f32));
    let triangles = std::iter::repeat_with(|| [(); 3].map(|()| corner()).into());
    triangles.take(count).collect()
}

fn staircase(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let [depth, height] = [(); 2].map(|()| uniform(rng, 0.5, 2.0));
    let width = 10.0 * depth;
    let step = |index: usize| {
        let point =
            |x, along: usize, up: usize| Vec3::new(x, up as f32 * height, along as f32 * depth);
        let edge = |along, up| [point(0.0, along, up), point(width, along, up)];
        let [a, b] = edge(index, index);
        let [c, d] = edge(index, index + 1);
        let [e, f] = edge(index + 1, index + 1);
        [quad([a, b, d, c]), quad([c, d, f, e])].concat()
    };
    (0..count.div_ceil(4)).flat_map(step).collect()
}

fn staircase_rotated(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let turn = rotation(rng);
    moved(&staircase(rng, count), |vertex| turn * vertex)
}
