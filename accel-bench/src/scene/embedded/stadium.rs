//! A dense figure in a coarse stadium: what Stich 2009 calls the Bubs scene.
//! The figure holds 95 % of the triangles and a thousandth of the space.

use std::f32::consts::{PI, TAU};

use accel_core::glam::Vec3;

use super::builder::MeshBuilder;
use crate::scene::Mesh;

pub(super) fn mesh(triangles: usize) -> Mesh {
    let mut builder = MeshBuilder::default();
    figure(&mut builder, triangles * 95 / 100);
    let rest = triangles.saturating_sub(builder.triangles());
    stands(&mut builder, rest);
    builder.finish()
}

pub(super) fn figure_mesh(triangles: usize) -> Mesh {
    let mut builder = MeshBuilder::default();
    figure(&mut builder, triangles);
    builder.finish()
}

/// A rounded figure two units tall: body, head, arms and legs, its skin uneven.
fn figure(builder: &mut MeshBuilder, triangles: usize) {
    // Body and head take 2 x 4 d^2, four limbs 4 x 2 d^2.
    let detail = ((triangles as f32 / 16.0).sqrt() as usize).max(3);
    let skin = |v: f32| 1.0 + 0.015 * (v * 60.0).sin();
    builder.revolution(Vec3::Y * 0.75, detail * 2, detail, |v| {
        (
            (0.42 * (v * PI).sin().max(0.0).powf(0.7) + 0.001) * skin(v),
            v * 0.85,
        )
    });
    builder.revolution(Vec3::Y * 1.55, detail * 2, detail, |v| {
        (
            (0.3 * (v * PI).sin().max(0.0).powf(0.8) + 0.001) * skin(v),
            v * 0.55,
        )
    });
    let limbs = [
        [[0.35, 1.4, 0.0], [0.7, 1.25, 0.1], [0.85, 1.5, 0.3]],
        [[-0.35, 1.4, 0.0], [-0.7, 1.1, 0.1], [-0.75, 0.8, 0.3]],
        [[0.18, 0.9, 0.0], [0.25, 0.45, 0.1], [0.25, 0.0, 0.0]],
        [[-0.18, 0.9, 0.0], [-0.25, 0.45, 0.1], [-0.25, 0.0, 0.0]],
    ];
    for limb in limbs {
        let [from, middle, to] = limb.map(Vec3::from);
        let steps = detail.max(2);
        let path: Vec<Vec3> = (0..=steps)
            .map(|i| {
                let t = i as f32 / steps as f32;
                from.lerp(middle, t).lerp(middle.lerp(to, t), t)
            })
            .collect();
        builder.tube(&path, |v| (0.14 - 0.05 * v) * skin(v), detail);
    }
}

/// Pitch and tiers of seats around it, long triangles each.
fn stands(builder: &mut MeshBuilder, triangles: usize) {
    builder.quad(
        Vec3::new(-60.0, 0.0, -40.0),
        Vec3::Z * 80.0,
        Vec3::X * 120.0,
        2,
    );
    let tiers = 24;
    let around = (triangles.saturating_sub(builder.triangles().min(8)) / (tiers * 4)).max(6);
    for tier in 0..tiers {
        let (inner, outer) = (tier as f32, tier as f32 + 1.0);
        let at = |u: f32, out: f32, y: f32| {
            let angle = if u < 1.0 { u * TAU } else { 0.0 };
            Vec3::new((62.0 + out) * angle.cos(), y, (42.0 + out) * angle.sin())
        };
        let height = 0.6 * inner;
        builder.grid(around, 1, |u, v| at(u, inner, height + 0.6 * v));
        builder.grid(around, 1, |u, v| {
            at(u, inner + (outer - inner) * v, height + 0.6)
        });
    }
}
