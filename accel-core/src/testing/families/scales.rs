//! Coordinates at the ends of the range, and contrasts of scale.

use glam::Vec3;
use rand::RngExt;

use super::shapes::{around, grid_side, mapped, power_of_two, repeat, soup, sphere};
use super::{Family, family};
use crate::Triangle;
use crate::testing::cube_point;

pub(super) const FAMILIES: &[Family] = &[
    family("scale-1e30", "coordinates of 1e30", |random, count| {
        mapped(soup(random, count, 0.2), |p| p * 1e30)
    }),
    family("scale-1e-30", "coordinates of 1e-30", |random, count| {
        mapped(soup(random, count, 0.2), |p| p * 1e-30)
    }),
    family("scale-1e15", "coordinates of 1e15", |random, count| {
        mapped(soup(random, count, 0.2), |p| p * 1e15)
    }),
    family("scale-1e-15", "coordinates of 1e-15", |random, count| {
        mapped(soup(random, count, 0.2), |p| p * 1e-15)
    }),
    family(
        "scale-largest",
        "coordinates up to the largest float",
        |random, count| {
            mapped(soup(random, count, 0.5), |p| {
                (p * 2.4e38).clamp(Vec3::splat(-f32::MAX), Vec3::splat(f32::MAX))
            })
        },
    ),
    family(
        "subnormal",
        "coordinates below the smallest normal float",
        |random, count| mapped(soup(random, count, 0.5), |p| p * 1e-39),
    ),
    family(
        "mixed-scales",
        "coordinates of all magnitudes",
        |random, count| {
            repeat(count, |_| {
                let size = power_of_two(random, -100, 100);
                let center = cube_point(random) * power_of_two(random, -100, 100);
                around(random, center, size)
            })
        },
    ),
    family(
        "negative-zero",
        "coordinates of both zeros",
        |random, count| {
            repeat(count, |_| {
                Triangle::from([(); 3].map(|()| {
                    let pick = [-0.0, 0.0, 1.0, -1.0];
                    Vec3::from([(); 3].map(|()| pick[random.random_range(0..4)]))
                }))
            })
        },
    ),
    family(
        "far-offset",
        "small things far from the origin",
        |random, count| {
            let offset = Vec3::new(2e5, -2e5, 2e5);
            mapped(soup(random, count, 0.3), |p| p + offset)
        },
    ),
    family(
        "soup-mixed-sizes",
        "sizes from 1e-3 to 1",
        |random, count| {
            repeat(count, |_| {
                let center = cube_point(random);
                let size = power_of_two(random, -10, 1);
                around(random, center, size)
            })
        },
    ),
    family(
        "stadium",
        "a dense figure in a stadium a million times larger",
        |random, count| {
            let figure = sphere(cube_point(random), 1.0, count * 9 / 10);
            let coarse = count - figure.len().min(count);
            let side = grid_side(coarse);
            let floor = super::shapes::grid(side, side, |x, z| {
                Vec3::new(
                    x as f32 / side as f32 - 0.5,
                    -1e-6,
                    z as f32 / side as f32 - 0.5,
                ) * 2e6
            });
            figure.into_iter().chain(floor).collect()
        },
    ),
];
