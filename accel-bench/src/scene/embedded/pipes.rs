//! Conduits along a grid that is turned against the axes, as in a hospital's
//! ceilings: bundles of long thin triangles whose boxes are nearly empty.

use accel_core::glam::{Affine3A, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::shapes::{MeshBuilder, turned_about_all_axes};
use crate::scene::{Mesh, camera::Camera};

/// From the middle to the border, in grid cells of one unit.
const HALF: i32 = 7;
const SIDES: usize = 7;
/// Segments of a bend.
const BEND: usize = 2;

/// Bundles until the count is reached, the last conduits cut short. The seed
/// chooses their ways. Many are thinner than few.
pub fn pipes(triangles: usize, seed: u64) -> Mesh {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut builder = MeshBuilder::default();
    let thickness = (60_000.0 / triangles.max(1) as f32).cbrt().clamp(0.3, 1.5);
    while builder.triangle_count() + segments(1) <= triangles {
        bundle(&mut builder, &mut random, thickness, triangles);
    }
    builder.transform(&turned_about_all_axes());
    builder.finish()
}

/// From outside, and from amidst them.
pub fn cameras() -> Vec<Camera> {
    vec![
        Camera::upright([10.5, 6.0, 17.5], [0.0, 0.0, 0.0], 50.0),
        Camera::upright([2.3, 0.6, 4.4], [-1.0, 0.0, -1.0], 65.0),
    ]
}

/// Triangles of a conduit with so many straight runs.
fn segments(runs: usize) -> usize {
    2 * SIDES * (runs + BEND * (runs - 1))
}

/// Conduits side by side along the same way.
fn bundle(builder: &mut MeshBuilder, random: &mut Pcg64Mcg, thickness: f32, limit: usize) {
    let radius = thickness * random.random_range(0.025..0.07);
    let way = way(random);
    // Apart on every axis, they stay apart around every corner.
    let step = Vec3::splat(3.0 * radius);
    for conduit in 0..random.random_range(1..=7) {
        let left = limit.saturating_sub(builder.triangle_count());
        let fitting = (1..way.len()).rev().find(|&runs| segments(runs) <= left);
        let Some(runs) = fitting else { return };
        let offset = Affine3A::from_translation(step * conduit as f32);
        let points: Vec<_> = way[..=runs]
            .iter()
            .map(|&point| offset.transform_point3(point))
            .collect();
        builder.tube(&with_bends(&points, 3.0 * radius), |_| radius, SIDES);
    }
}

/// Straight runs from grid point to grid point, each along another axis than
/// the one before.
fn way(random: &mut Pcg64Mcg) -> Vec<Vec3> {
    let mut cell = [(); 3].map(|()| random.random_range(-HALF..=HALF));
    let mut axis = random.random_range(0..3);
    let mut way = vec![Vec3::from(cell.map(|c| c as f32))];
    for _ in 0..random.random_range(3..=6) {
        // At least two cells further, turning back where the border is near.
        let reach = random.random_range(2..=10);
        let ahead = random.random_bool(0.5);
        let ahead = if ahead {
            cell[axis] + reach <= HALF
        } else {
            cell[axis] - reach < -HALF
        };
        cell[axis] += if ahead { reach } else { -reach };
        cell[axis] = cell[axis].clamp(-HALF - 2, HALF + 2);
        way.push(Vec3::from(cell.map(|c| c as f32)));
        axis = (axis + random.random_range(1..3)) % 3;
    }
    way
}

/// The polyline with each inner corner replaced by an arc of `radius`.
fn with_bends(points: &[Vec3], radius: f32) -> Vec<Vec3> {
    let mut path = vec![points[0]];
    for corner in points.windows(3) {
        let [before, here, after] = [corner[0], corner[1], corner[2]];
        let start = here + (before - here).normalize() * radius;
        let end = here + (after - here).normalize() * radius;
        for i in 0..=BEND {
            let t = i as f32 / BEND as f32;
            path.push(start.lerp(here, t).lerp(here.lerp(end, t), t));
        }
    }
    path.extend(points.last());
    path
}
