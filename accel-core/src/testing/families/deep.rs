//! Scenes that make trees deep, or references many.

use std::f32::consts::TAU;

use glam::Vec3;
use rand_pcg::Pcg64Mcg;

use super::shapes::{around, quad, repeat};
use super::{Family, family};
use crate::Triangle;
use crate::testing::{cube_point, direction};

pub(super) const FAMILIES: &[Family] = &[
    family(
        "geometric-series-2",
        "each triangle twice as far out as the last",
        |random, count| series(random, count, 2.0, 120),
    ),
    family(
        "geometric-series-1.1",
        "each triangle a tenth farther out",
        |random, count| series(random, count, 1.1, 800),
    ),
    family("staircase", "steps that climb diagonally", |_, count| {
        let steps = (0..count.div_ceil(4)).flat_map(|i| {
            let at = Vec3::new(i as f32, i as f32, 0.0);
            let tread = quad([
                at,
                at + Vec3::X,
                at + Vec3::X + Vec3::Z * 9.0,
                at + Vec3::Z * 9.0,
            ]);
            let riser = at + Vec3::X;
            let riser = quad([
                riser,
                riser + Vec3::Y,
                riser + Vec3::Y + Vec3::Z * 9.0,
                riser + Vec3::Z * 9.0,
            ]);
            tread.into_iter().chain(riser)
        });
        steps.collect()
    }),
    family(
        "fan",
        "long triangles around one point: everything straddles",
        |_, count| {
            let rim = |i: usize| {
                let angle = i as f32 / count as f32 * TAU;
                Vec3::new(angle.cos(), (i % 7) as f32 * 0.01, angle.sin()) * 10.0
            };
            repeat(count, |i| Triangle::from([Vec3::ZERO, rim(i), rim(i + 1)]))
        },
    ),
    family(
        "star",
        "large triangles through the middle: everything overlaps",
        |random, count| {
            repeat(count, |_| {
                let [a, b] = [(); 2].map(|()| direction(random));
                Triangle::from([a, b, -(a + b)])
            })
        },
    ),
    family(
        "overlapping",
        "triangles about as large as the scene",
        |random, count| repeat(count, |_| around(random, Vec3::ZERO, 1.0)),
    ),
];

/// Groups of triangles whose distances and sizes grow by `ratio`; after `length`
/// of them the series begins again, so that it stays within the range.
fn series(random: &mut Pcg64Mcg, count: usize, ratio: f32, length: usize) -> Vec<Triangle> {
    repeat(count, |i| {
        let size = 1e-18 * ratio.powi((i % length) as i32);
        Triangle::from([(); 3].map(|()| (Vec3::ONE + cube_point(random) * 0.2) * size))
    })
}
