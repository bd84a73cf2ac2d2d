//! Scenes that are hard for splitting planes.

use glam::Vec3;
use rand::RngExt;

use super::shapes::{mapped, quad, repeat, turned};
use super::{Family, family, sized};
use crate::Triangle;
use crate::testing::cube_point;

pub(super) const FAMILIES: &[Family] = &[
    sized(
        2000,
        family(
            "quadratic",
            "two bundles of strips, each cut by all of the other",
            |_, count| quadratic(count),
        ),
    ),
    sized(
        2000,
        family(
            "quadratic-turned",
            "the same, turned by 45 degrees",
            |_, count| mapped(quadratic(count), |p| turned() * p),
        ),
    ),
    family(
        "axis-grid",
        "planes of a grid, all three axes",
        |_, count| {
            let levels = (count / 6).max(1);
            let sheets = (0..levels).flat_map(|i| {
                let at = i as f32 / levels as f32;
                [[0, 1, 2], [1, 2, 0], [2, 0, 1]]
                    .into_iter()
                    .flat_map(move |[x, y, z]| {
                        quad(
                            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| {
                                let mut corner = Vec3::ZERO;
                                (corner[x], corner[y], corner[z]) = (u, v, at);
                                corner
                            }),
                        )
                    })
            });
            sheets.collect()
        },
    ),
    family(
        "touching-boxes",
        "boxes that share faces",
        |random, count| {
            let boxes = (0..count.div_ceil(12)).flat_map(|_| {
                let cell = Vec3::from([(); 3].map(|()| random.random_range(0..6) as f32));
                unit_box(cell)
            });
            boxes.collect()
        },
    ),
    family(
        "clusters",
        "a few dense heaps far apart",
        |random, count| {
            let heaps: Vec<Vec3> = (0..8).map(|_| cube_point(random) * 100.0).collect();
            repeat(count, |i| super::shapes::around(random, heaps[i % 8], 0.2))
        },
    ),
];

/// Strips that reach across the scene one way, and as many the other way, each
/// crossing all others.
fn quadratic(count: usize) -> Vec<Triangle> {
    let strips = (count / 4).max(1);
    (0..strips)
        .flat_map(|i| {
            let at = i as f32 / strips as f32;
            let one = quad([
                Vec3::new(0.0, at, 0.0),
                Vec3::new(1.0, at, 1.0),
                Vec3::new(1.0, at + 0.1 / strips as f32, 1.0),
                Vec3::new(0.0, at + 0.1 / strips as f32, 0.0),
            ]);
            let other = quad([
                Vec3::new(at, 0.0, 1.0),
                Vec3::new(at, 1.0, 0.0),
                Vec3::new(at + 0.1 / strips as f32, 1.0, 0.0),
                Vec3::new(at + 0.1 / strips as f32, 0.0, 1.0),
            ]);
            one.into_iter().chain(other)
        })
        .collect()
}

fn unit_box(at: Vec3) -> impl Iterator<Item = Triangle> {
    let faces = [
        [0, 1, 3, 2],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 3, 7, 5],
    ];
    let corner = move |i: usize| at + Vec3::from([0, 1, 2].map(|axis| (i >> axis & 1) as f32));
    faces
        .into_iter()
        .flat_map(move |face| quad(face.map(corner)))
}
