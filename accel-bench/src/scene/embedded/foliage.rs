//! Trees on a meadow: stems that branch, and many small leaves in every
//! direction, with much air between them.

use accel_core::glam::{Quat, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::shapes::MeshBuilder;
use crate::scene::{Mesh, camera::Camera};

/// From the middle to the border of the meadow.
const HALF: f32 = 7.0;
/// Branches at each fork.
const FORKS: usize = 3;
const STEM_SIDES: usize = 5;
/// A branch is bent once.
const STEM_SEGMENTS: usize = 2;

/// Trees, grass, and as many leaves as the count leaves over: more triangles
/// give more trees (up to 24), finer twigs and more leaves. The seed grows them.
pub fn foliage(triangles: usize, seed: u64) -> Mesh {
    let mut forest = Forest {
        builder: MeshBuilder::default(),
        random: Pcg64Mcg::seed_from_u64(seed),
        twigs: Vec::new(),
    };
    let cells = if triangles < 5000 { 3 } else { 12 };
    forest.builder.grid([cells, cells], |u, v| {
        on_ground((v * 2.0 - 1.0) * HALF, (u * 2.0 - 1.0) * HALF)
    });
    let trees = (triangles / 8000).clamp(1, 24);
    let levels = levels_within(triangles * 3 / 10 / trees);
    for tree in 0..trees {
        // A sunflower's arrangement covers the meadow evenly.
        let (sin, cos) = (tree as f32 * 2.4).sin_cos();
        let distance = 0.75 * HALF * (tree as f32 / trees as f32).sqrt();
        let foot = on_ground(distance * cos, distance * sin);
        let height = forest.random.random_range(1.15..1.6);
        forest.branch(foot, Vec3::Y * height, 0.1 * height, levels);
    }
    let left = triangles.saturating_sub(forest.builder.triangle_count());
    (0..left / 8).for_each(|_| forest.blade_of_grass());
    let left = triangles.saturating_sub(forest.builder.triangle_count());
    (0..left / 2).for_each(|_| forest.leaf());
    forest.builder.finish()
}

/// From the edge of the meadow, and up into a crown.
pub fn cameras() -> Vec<Camera> {
    vec![
        Camera::upright([6.2, 2.1, 8.2], [0.0, 1.9, 0.0], 42.0),
        Camera::upright([1.1, 0.7, 2.6], [0.0, 2.6, 0.0], 60.0),
    ]
}

/// Gentle hills.
fn on_ground(x: f32, z: f32) -> Vec3 {
    let height = 0.12 * (0.9 * x).sin() * (0.7 * z + 1.0).cos() - 0.02;
    Vec3::new(x, height, z)
}

/// How often a tree of at most so many triangles may fork.
fn levels_within(triangles: usize) -> u32 {
    let branches = |levels: u32| (FORKS.pow(levels + 1) - 1) / (FORKS - 1);
    let of_tree = |levels| branches(levels) * 2 * STEM_SIDES * STEM_SEGMENTS;
    (1..=5)
        .rev()
        .find(|&levels| of_tree(levels) <= triangles)
        .unwrap_or(1)
}

struct Forest {
    builder: MeshBuilder,
    random: Pcg64Mcg,
    /// Both ends of the outermost branches, which carry the leaves.
    twigs: Vec<[Vec3; 2]>,
}

impl Forest {
    /// A branch from `from` along `along`, with `levels` forks after it.
    fn branch(&mut self, from: Vec3, along: Vec3, radius: f32, levels: u32) {
        let length = along.length();
        let middle = from + along * 0.5 + self.direction() * (0.08 * length);
        let to = from + along;
        let thinning = |v: f32| radius * (1.0 - 0.4 * v);
        self.builder.tube(&[from, middle, to], thinning, STEM_SIDES);
        if levels == 0 {
            self.twigs.push([middle, to]);
            return;
        }
        // The branches of a fork spread evenly around it, the first the least.
        let heading = along / length;
        let around = self.random.random_range(0.0..3.0);
        for fork in 0..FORKS {
            let turn = Quat::from_axis_angle(heading, around + fork as f32 * 2.1);
            let aside = turn * heading.any_orthonormal_vector();
            let spread = [0.35, 0.75, 0.95][fork] * self.random.random_range(0.8..1.2);
            let next = (heading + aside * spread + Vec3::Y * 0.12).normalize();
            let shrink = self.random.random_range(0.62..0.8);
            self.branch(to, next * (length * shrink), radius * 0.6, levels - 1);
        }
    }

    /// Two triangles folded along the leaf's rib.
    fn leaf(&mut self) {
        let [from, to] = self.twigs[self.random.random_range(0..self.twigs.len())];
        let at = from.lerp(to, self.random.random_range(0.0..1.1)) + self.direction() * 0.06;
        let outwards = (to - from).normalize_or(Vec3::Y) * 0.5;
        let rib = (outwards + self.direction()).normalize_or(Vec3::Y);
        let side = rib.any_orthonormal_vector();
        let side = Quat::from_axis_angle(rib, self.random.random_range(0.0..6.2)) * side;
        let size = self.random.random_range(0.07..0.13);
        let fold = rib.cross(side) * 0.12;
        let (tip, middle) = (at + rib * size, at + rib * (0.45 * size));
        let [left, right] = [side, -side].map(|side| middle + (side * 0.28 + fold) * size);
        self.builder.folded_pair(at, tip, left, right);
    }

    fn blade_of_grass(&mut self) {
        let [x, z] = [(); 2].map(|()| self.random.random_range(-HALF..HALF));
        let foot = on_ground(x, z);
        let width = self.direction() * Vec3::new(0.02, 0.0, 0.02);
        let bend = self.direction() * Vec3::new(0.08, 0.0, 0.08);
        let tip = foot + bend + Vec3::Y * self.random.random_range(0.1..0.28);
        self.builder.triangle([foot - width, foot + width, tip]);
    }

    /// A direction, all alike likely.
    fn direction(&mut self) -> Vec3 {
        let height: f32 = self.random.random_range(-1.0..1.0);
        let (sin, cos) = (self.random.random::<f32>() * std::f32::consts::TAU).sin_cos();
        let ring = (1.0 - height * height).sqrt();
        Vec3::new(ring * cos, height, ring * sin)
    }
}
