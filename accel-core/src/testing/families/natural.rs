//! Scenes like those that people have.

use glam::Vec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::random::{log_uniform, point_in_cube, uniform};
use super::Family;
use super::shapes::{axis_box, repeated, soup, sphere, square_side, surface, triangle_near};
use crate::Triangle;

pub(super) const FAMILIES: &[Family] = &[
    Family::new(
        "soup-uniform",
        "Small triangles of like size, evenly spread.",
        20_000,
        |rng, count| soup(rng, count, 0.05),
    ),
    Family::new(
        "soup-mixed-sizes",
        "Triangles of 1e-4 to 1, each magnitude as frequent.",
        20_000,
        soup_mixed_sizes,
    ),
    Family::new(
        "clustered",
        "Dense clusters of different sizes with void between.",
        20_000,
        clustered,
    ),
    Family::new(
        "overlapping-big",
        "Triangles as big as the scene: no split parts them.",
        4_000,
        |rng, count| soup(rng, count, 1.0),
    ),
    Family::new(
        "touching-spheres",
        "Tessellated spheres in a lattice, each touching the next in a vertex.",
        20_000,
        touching_spheres,
    ),
    Family::new("terrain", "A rolling height field.", 20_000, terrain),
    Family::new(
        "city-blocks",
        "Closed boxes of different heights on a street grid.",
        20_000,
        city_blocks,
    ),
    Family::new(
        "foliage",
        "Leaves in all poses, dense at the crown's middle.",
        20_000,
        foliage,
    ),
];

fn soup_mixed_sizes(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    repeated(count, || {
        let size = log_uniform(rng, 1e-4, 1.0) as f32;
        let center = point_in_cube(rng);
        triangle_near(rng, center, size)
    })
}

fn clustered(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let clusters: Vec<_> = (0..8)
        .map(|_| (point_in_cube(rng), log_uniform(rng, 1e-4, 0.1) as f32))
        .collect();
    repeated(count, || {
        let (middle, radius) = clusters[rng.random_range(0..clusters.len())];
        let center = middle + radius * point_in_cube(rng);
        triangle_near(rng, center, 0.1 * radius)
    })
}

fn touching_spheres(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    const RINGS: usize = 6;
    const TRIANGLES: usize = 4 * RINGS * RINGS;
    let spheres = count.div_ceil(TRIANGLES);
    let side = (1..)
        .find(|side| side * side * side >= spheres)
        .unwrap_or(1);
    let corner = (4.0 * point_in_cube(rng)).round();
    (0..spheres)
        .flat_map(|index| {
            let cell = [index % side, index / side % side, index / side / side];
            let cell = Vec3::from_array(cell.map(|coordinate| coordinate as f32));
            sphere(corner + cell, 0.5, RINGS)
        })
        .collect()
}

fn terrain(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let side = square_side(count);
    let waves: Vec<_> = (0..6)
        .map(|octave| {
            let frequency = 2f32.powi(octave);
            (2.0 * frequency * point_in_cube(rng), 0.3 / frequency)
        })
        .collect();
    surface(side, side, |column, row| {
        let x = 2.0 * column as f32 / side as f32 - 1.0;
        let z = 2.0 * row as f32 / side as f32 - 1.0;
        let wave = |(wave, height): &(Vec3, f32)| height * (wave.x * x + wave.y * z + wave.z).sin();
        Vec3::new(x, waves.iter().map(wave).sum(), z)
    })
}

fn city_blocks(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let houses = count.div_ceil(12);
    let side = (houses as f64).sqrt().ceil() as usize;
    (0..houses)
        .flat_map(|index| {
            let low = Vec3::new((index % side) as f32, 0.0, (index / side) as f32);
            let size = Vec3::new(
                uniform(rng, 0.3, 0.8),
                log_uniform(rng, 0.2, 8.0) as f32,
                uniform(rng, 0.3, 0.8),
            );
            axis_box(low, low + size)
        })
        .collect()
}

fn foliage(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    repeated(count, || {
        let center = point_in_cube(rng) * rng.random::<f32>();
        triangle_near(rng, center, 0.02)
    })
}
