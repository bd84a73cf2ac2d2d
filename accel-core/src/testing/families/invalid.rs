//! Triangles that are not finite among good ones.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::shapes::soup;
use super::{Family, family};
use crate::Triangle;

const fn invalid(family: Family) -> Family {
    Family {
        has_invalid: true,
        ..family
    }
}

pub(super) const FAMILIES: &[Family] = &[
    invalid(family(
        "nan-mixed",
        "every few triangles a NaN",
        |random, count| spoiled(random, count, &[f32::NAN]),
    )),
    invalid(family(
        "infinity-mixed",
        "every few triangles an infinity",
        |random, count| spoiled(random, count, &[f32::INFINITY, f32::NEG_INFINITY]),
    )),
    invalid(family(
        "mostly-invalid",
        "hardly a good triangle",
        |random, count| {
            let good = (count / 50).max(1);
            let mut scene = soup(random, count, 0.3);
            for triangle in scene.iter_mut().skip(good) {
                triangle.c.y = f32::NAN;
            }
            scene
        },
    )),
];

/// A soup in which about every fifth triangle has one of `values` somewhere.
fn spoiled(random: &mut Pcg64Mcg, count: usize, values: &[f32]) -> Vec<Triangle> {
    let mut scene = soup(random, count, 0.3);
    for triangle in &mut scene {
        if random.random_bool(0.2) {
            let corner = [&mut triangle.a, &mut triangle.b, &mut triangle.c]
                .into_iter()
                .nth(random.random_range(0..3));
            if let Some(corner) = corner {
                corner[random.random_range(0..3)] = values[random.random_range(0..values.len())];
            }
        }
    }
    scene
}
