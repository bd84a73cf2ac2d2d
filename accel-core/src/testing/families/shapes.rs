//! The shapes that several families are made of.

use glam::Vec3;
use rand_pcg::Pcg64Mcg;

use super::super::random::point_in_cube;
use crate::Triangle;

/// `count` draws of one kind of triangle.
pub(super) fn repeated(count: usize, triangle: impl FnMut() -> Triangle) -> Vec<Triangle> {
    std::iter::repeat_with(triangle).take(count).collect()
}

/// Three corners drawn from the cube of half width `size` around `center`.
pub(super) fn triangle_near(rng: &mut Pcg64Mcg, center: Vec3, size: f32) -> Triangle {
    [(); 3].map(|()| center + point_in_cube(rng) * size).into()
}

/// `count` triangles of about `size`, spread over the cube from -1 to 1.
pub(super) fn soup(rng: &mut Pcg64Mcg, count: usize, size: f32) -> Vec<Triangle> {
    repeated(count, || {
        let center = point_in_cube(rng);
        triangle_near(rng, center, size)
    })
}

/// The two halves of a quadrilateral with corners in order of its outline.
pub(super) fn quad([a, b, c, d]: [Vec3; 4]) -> [Triangle; 2] {
    [Triangle::new(a, b, c), Triangle::new(a, c, d)]
}

/// A surface of `columns` times `rows` quadrilaterals over the vertices
/// `point(column, row)`. Neighbours share vertices bit for bit.
pub(super) fn surface(
    columns: usize,
    rows: usize,
    point: impl Fn(usize, usize) -> Vec3,
) -> Vec<Triangle> {
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    cells
        .flat_map(|(column, row)| {
            quad([
                point(column, row),
                point(column + 1, row),
                point(column + 1, row + 1),
                point(column, row + 1),
            ])
        })
        .collect()
}

/// The side of the largest square of quadrilaterals within `count` triangles.
pub(super) fn square_side(count: usize) -> usize {
    (count / 2).isqrt().max(1)
}

/// The twelve triangles of the closed box from `low` to `high`, facing out.
pub(super) fn axis_box(low: Vec3, high: Vec3) -> Vec<Triangle> {
    let corner = |index: usize| {
        Vec3::new(
            if index & 1 == 0 { low.x } else { high.x },
            if index & 2 == 0 { low.y } else { high.y },
            if index & 4 == 0 { low.z } else { high.z },
        )
    };
    const FACES: [[usize; 4]; 6] = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    FACES
        .iter()
        .flat_map(|face| quad(face.map(corner)))
        .collect()
}

/// A sphere of `2 * rings` meridians and `rings` parallels. Its poles are
/// degenerate quadrilaterals: half of their triangles are lines.
pub(super) fn sphere(center: Vec3, radius: f32, rings: usize) -> Vec<Triangle> {
    let segments = 2 * rings;
    surface(segments, rings, |column, row| {
        let turn = (column % segments) as f32 / segments as f32 * std::f32::consts::TAU;
        let height = row as f32 / rings as f32 * std::f32::consts::PI;
        let (sine, cosine) = turn.sin_cos();
        let normal = Vec3::new(height.sin() * cosine, height.sin() * sine, height.cos());
        center + radius * normal
    })
}

/// The same triangles with every vertex moved by `map`.
pub(super) fn moved(triangles: &[Triangle], map: impl Fn(Vec3) -> Vec3) -> Vec<Triangle> {
    let corners = triangles.iter().map(Triangle::vertices);
    corners.map(|corners| corners.map(&map).into()).collect()
}
