//! Scenes as they come.

use glam::Vec3;
use rand::RngExt;

use super::shapes::{grid, grid_side, repeat, soup, strip};
use super::{Family, family};
use crate::testing::{cube_point, direction};

pub(super) const FAMILIES: &[Family] = &[
    family("soup", "small triangles everywhere", |random, count| {
        soup(random, count, 0.1)
    }),
    family(
        "soup-dense",
        "larger triangles everywhere",
        |random, count| soup(random, count, 0.5),
    ),
    family("terrain", "a height field", |random, count| {
        let side = grid_side(count);
        let phase = cube_point(random) * 9.0;
        grid(side, side, |x, z| {
            let (x, z) = (x as f32 / side as f32, z as f32 / side as f32);
            let height = (x * 19.0 + phase.x).sin() * 0.1 + (z * 23.0 + phase.z).cos() * 0.07;
            Vec3::new(x, height, z)
        })
    }),
    family("hairball", "strands out of a ball", |random, count| {
        let per_strand = 16;
        let strands = (0..count.div_ceil(2 * per_strand)).flat_map(|_| {
            let mut at = direction(random);
            let mut heading = at;
            let mut strand = Vec::with_capacity(2 * per_strand);
            for _ in 0..per_strand {
                heading = (heading + direction(random) * 0.4).normalize();
                let next = at + heading * 0.1;
                strand.extend(strip(random, at, next, 0.004));
                at = next;
            }
            strand
        });
        strands.collect()
    }),
    family("foliage", "leaves in heaps", |random, count| {
        repeat(count, |_| {
            let bough = (cube_point(random) * 3.0).round() + direction(random) * 0.3;
            super::shapes::around(random, bough, 0.05)
        })
    }),
    family("towers", "tall boxes on a floor", |random, count| {
        let towers = (0..count.div_ceil(8)).flat_map(|_| {
            let at = (cube_point(random) * 10.0).with_y(0.0).round();
            let height = random.random_range(0.5_f32..8.0);
            let corners = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Z, Vec3::Z].map(|c| at + c * 0.8);
            (0..4).flat_map(move |side| {
                let (from, to) = (corners[side], corners[(side + 1) % 4]);
                super::shapes::quad([from, to, to + Vec3::Y * height, from + Vec3::Y * height])
            })
        });
        towers.collect()
    }),
];
