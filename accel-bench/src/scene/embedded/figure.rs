//! A rounded figure, about two units tall, standing at the origin: a skin that is
//! evenly and finely tessellated, nothing in it is hard.

use std::f32::consts::PI;

use accel_core::glam::Vec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::shapes::{MeshBuilder, TriangleBudget, cells};
use crate::scene::{Mesh, camera::Camera};

/// The figure alone. The seed shapes its skin.
pub fn figure(triangles: usize, seed: u64) -> Mesh {
    build(triangles, seed).finish()
}

/// From the front and the right, and its face.
pub fn cameras() -> Vec<Camera> {
    vec![
        Camera::upright([1.9, 1.8, 4.0], [0.0, 1.08, 0.0], 36.0),
        Camera::upright([0.6, 1.9, 1.9], [0.0, 1.72, 0.0], 36.0),
    ]
}

/// A builder that holds the figure.
pub(super) fn build(triangles: usize, seed: u64) -> MeshBuilder {
    // How much of the parts lies within others shows once they are built.
    let visible = skin(triangles).triangle_count().max(1);
    let mut builder = skin((triangles as f64 * triangles as f64 / visible as f64) as usize);
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let phase = Vec3::from([(); 3].map(|()| random.random_range(0.0..PI)));
    builder.displace(|point| {
        let wave = |v: Vec3| Vec3::new(v.y.sin() + v.z.cos(), v.z.sin() + v.x.cos(), v.x.sin());
        0.008 * wave(point * 11.0 + phase) + 0.0025 * wave(point * 47.0 - phase)
    });
    builder
}

/// The parts from `triangles` triangles, without those that nobody sees.
fn skin(triangles: usize) -> MeshBuilder {
    let mut builder = MeshBuilder::default();
    let weight = PARTS.iter().map(Part::area).sum();
    let mut budget = TriangleBudget::new(triangles, weight);
    for part in PARTS {
        let share = budget.share(builder.triangle_count(), part.area());
        part.build(&mut builder, share);
    }
    builder.retain(|corners| !PARTS.iter().any(|part| part.hides(corners)));
    builder
}

/// What the figure is made of.
enum Part {
    Ellipsoid {
        center: [f32; 3],
        radii: [f32; 3],
    },
    /// A bent limb through three points, thinner towards its end.
    Limb {
        points: [[f32; 3]; 3],
        radii: [f32; 2],
    },
}

/// Small parts last would round worst: the torso, the largest, closes the list.
const PARTS: &[Part] = &[
    // Feet, hands, eyes, nose, ears.
    ellipsoid([0.24, 0.09, 0.12], [0.14, 0.09, 0.24]),
    ellipsoid([-0.24, 0.09, 0.12], [0.14, 0.09, 0.24]),
    ellipsoid([0.93, 1.52, 0.24], [0.11, 0.13, 0.09]),
    ellipsoid([-0.8, 0.72, 0.3], [0.1, 0.14, 0.1]),
    ellipsoid([0.13, 1.83, 0.29], [0.07, 0.09, 0.05]),
    ellipsoid([-0.13, 1.83, 0.29], [0.07, 0.09, 0.05]),
    ellipsoid([0.0, 1.7, 0.37], [0.07, 0.07, 0.1]),
    ellipsoid([0.39, 1.78, 0.0], [0.06, 0.13, 0.09]),
    ellipsoid([-0.39, 1.78, 0.0], [0.06, 0.13, 0.09]),
    // Legs and arms.
    limb(
        [[0.19, 0.8, 0.0], [0.24, 0.45, 0.06], [0.24, 0.1, 0.0]],
        [0.17, 0.1],
    ),
    limb(
        [[-0.19, 0.8, 0.0], [-0.24, 0.45, 0.06], [-0.24, 0.1, 0.0]],
        [0.17, 0.1],
    ),
    limb(
        [[0.24, 1.27, 0.0], [0.78, 1.12, 0.1], [0.9, 1.46, 0.22]],
        [0.12, 0.075],
    ),
    limb(
        [[-0.24, 1.27, 0.0], [-0.68, 1.15, 0.06], [-0.78, 0.78, 0.28]],
        [0.12, 0.075],
    ),
    // Hat: brim and crown.
    ellipsoid([0.0, 2.0, -0.03], [0.47, 0.04, 0.47]),
    ellipsoid([0.0, 2.08, -0.03], [0.28, 0.22, 0.28]),
    ellipsoid([0.0, 1.75, 0.0], [0.38, 0.36, 0.35]),
    ellipsoid([0.0, 1.05, 0.02], [0.43, 0.48, 0.37]),
];

const fn ellipsoid(center: [f32; 3], radii: [f32; 3]) -> Part {
    Part::Ellipsoid { center, radii }
}

const fn limb(points: [[f32; 3]; 3], radii: [f32; 2]) -> Part {
    Part::Limb { points, radii }
}

impl Part {
    /// Its surface, roughly, for an even tessellation.
    fn area(&self) -> f32 {
        match self {
            Self::Ellipsoid {
                radii: [a, b, c], ..
            } => 4.0 * PI * (a * b + b * c + c * a) / 3.0,
            Self::Limb { points, radii } => PI * (radii[0] + radii[1]) * length(points),
        }
    }

    /// Whether a triangle lies within this part. Limbs hide nothing: where they
    /// meet another part they are the ones that end.
    fn hides(&self, corners: &[Vec3; 3]) -> bool {
        // A part's own triangles lie on it, within rounding.
        const WITHIN: f32 = 0.999;
        match *self {
            Self::Ellipsoid { center, radii } => corners.iter().all(|&corner| {
                let offset = (corner - Vec3::from(center)) / Vec3::from(radii);
                offset.length() < WITHIN
            }),
            Self::Limb { .. } => false,
        }
    }

    fn build(&self, builder: &mut MeshBuilder, triangles: usize) {
        match *self {
            Self::Ellipsoid { center, radii } => {
                let [columns, rows] = cells(triangles, 2.0, [5, 2]);
                // The poles' quads have only one triangle each.
                builder.ellipsoid(center.into(), radii.into(), [columns, rows + 1]);
            }
            Self::Limb { points, radii } => {
                let around = PI * (radii[0] + radii[1]);
                let aspect = around / length(&points);
                let [sides, steps] = cells(triangles, aspect, [4, 2]);
                let [from, middle, to] = points.map(Vec3::from);
                let bend = |i: usize| {
                    let t = i as f32 / steps as f32;
                    from.lerp(middle, t).lerp(middle.lerp(to, t), t)
                };
                let path: Vec<_> = (0..=steps).map(bend).collect();
                builder.tube(&path, |v| radii[0] + (radii[1] - radii[0]) * v, sides);
            }
        }
    }
}

fn length(points: &[[f32; 3]; 3]) -> f32 {
    let [from, middle, to] = points.map(Vec3::from);
    0.5 * (from.distance(middle) + middle.distance(to) + from.distance(to))
}
