//! Scenes with little to tell primitives apart.

use glam::Vec3;
use rand::RngExt;

use super::shapes::{around, repeat, soup};
use super::{Family, family, sized};
use crate::Triangle;
use crate::testing::cube_point;

pub(super) const FAMILIES: &[Family] =
    &[
        sized(1, family("empty", "no triangles at all", |_, _| Vec::new())),
        sized(
            1,
            family("one-triangle", "a single triangle", |random, count| {
                soup(random, count.min(1), 1.0)
            }),
        ),
        family("points", "triangles that are points", |random, count| {
            repeat(count, |_| Triangle::from([cube_point(random); 3]))
        }),
        family("lines", "triangles that are lines", |random, count| {
            repeat(count, |_| {
                let [from, to] = [(); 2].map(|()| cube_point(random));
                Triangle::from([from, to, from.lerp(to, 0.5)])
            })
        }),
        family(
            "points-and-lines",
            "degenerate triangles among good ones",
            |random, count| {
                repeat(count, |i| {
                    let [a, b, c] = [(); 3].map(|()| cube_point(random));
                    Triangle::from([[a, a, a], [a, b, a], [a, b, c]][i % 3])
                })
            },
        ),
        sized(
            1_000_000,
            family(
                "one-point",
                "all primitives at one point",
                |random, count| vec![Triangle::from([cube_point(random); 3]); count],
            ),
        ),
        sized(
            100_000,
            family("duplicates", "one triangle, many times", |random, count| {
                vec![around(random, Vec3::ZERO, 1.0); count]
            }),
        ),
        family(
            "duplicates-of-some",
            "every triangle several times",
            |random, count| {
                let some = soup(random, (count / 10).max(1), 0.5);
                repeat(count, |i| some[i % some.len()])
            },
        ),
        sized(
            10_000,
            family("nested", "one centroid, sizes nested", |random, count| {
                let axis = cube_point(random);
                repeat(count, |i| {
                    let size = (i + 1) as f32 / count as f32;
                    let corners = [Vec3::X, Vec3::Y, -Vec3::X - Vec3::Y];
                    Triangle::from(corners.map(|corner| (corner + axis.cross(corner)) * size))
                })
            }),
        ),
        family(
            "two-faced",
            "each triangle twice, turned over",
            |random, count| {
                let some = soup(random, count.div_ceil(2), 0.3);
                let faces = some
                    .iter()
                    .flat_map(|t| [*t, Triangle::from([t.a, t.c, t.b])]);
                faces.collect()
            },
        ),
        family(
            "integer-grid",
            "corners on few integers: ties everywhere",
            |random, count| {
                repeat(count, |_| {
                    Triangle::from([(); 3].map(|()| {
                        Vec3::from([(); 3].map(|()| random.random_range(-4_i32..=4) as f32))
                    }))
                })
            },
        ),
    ];
