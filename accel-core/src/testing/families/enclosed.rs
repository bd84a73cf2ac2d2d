//! Closed meshes, from whose inside no ray may escape.

use rand_pcg::Pcg64Mcg;

use super::super::closed::ClosedMesh;
use super::super::random::{rotation, uniform};
use super::Family;
use super::shapes::{moved, square_side};
use crate::Triangle;

pub(super) const FAMILIES: &[Family] = &[
    Family::new(
        "closed-room-of-strips",
        "A room 1000 long whose walls are strips one wide.",
        20_000,
        room,
    ),
    Family::new(
        "closed-icosphere",
        "A sphere of nearly equal triangles with shared vertices.",
        20_480,
        icosphere,
    ),
    Family::new(
        "closed-lat-long",
        "A sphere of meridians, with fans of skinny triangles at its poles.",
        20_000,
        latitude_longitude,
    ),
    Family::new(
        "closed-bumpy-sphere",
        "A sphere with bumps and hollows.",
        20_480,
        bumpy_sphere,
    ),
    Family::new("closed-torus", "A ring with a tube inside.", 20_000, torus),
    Family::new(
        "closed-nested-shells",
        "Spheres within spheres: every ray from inside meets them all.",
        20_000,
        nested_shells,
    ),
];

/// The mesh in a random pose: rotation keeps the sharing of vertices.
fn posed(rng: &mut Pcg64Mcg, mesh: &ClosedMesh) -> Vec<Triangle> {
    mesh.rotated(rotation(rng)).to_triangles()
}

fn room(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let strips = (count / 16).clamp(1, 100_000) as u32;
    posed(rng, &ClosedMesh::room_of_strips(1000.0, strips))
}

/// The finest level within `count` triangles.
fn level(count: usize) -> u32 {
    (1..=7)
        .take_while(|level| 20 << (2 * level) <= count)
        .last()
        .unwrap_or(0)
}

fn icosphere(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    posed(rng, &ClosedMesh::icosphere(level(count)))
}

fn latitude_longitude(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    // 2 segments (rings - 1) triangles, with as many segments as rings.
    let rings = square_side(count).max(3) as u32;
    posed(rng, &ClosedMesh::latitude_longitude(rings, rings))
}

fn bumpy_sphere(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let height = uniform(rng, 0.05, 0.3);
    posed(rng, &ClosedMesh::bumpy_sphere(level(count), height))
}

fn torus(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    let minor = square_side(count / 2).max(3) as u32;
    posed(rng, &ClosedMesh::torus(2 * minor, minor))
}

fn nested_shells(rng: &mut Pcg64Mcg, count: usize) -> Vec<Triangle> {
    const SHELLS: usize = 8;
    let rings = square_side(count / SHELLS).max(3) as u32;
    let shell = posed(rng, &ClosedMesh::latitude_longitude(rings, rings));
    (1..=SHELLS)
        .flat_map(|radius| moved(&shell, |vertex| radius as f32 * vertex))
        .collect()
}
