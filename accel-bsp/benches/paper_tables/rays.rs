//! Rays as in the paper: of a camera, and of diffuse paths (section 5).

use accel_bsp::glam::Vec3;
use accel_bsp::{AccelerationStructure, BspTree, RaySegment, Triangle};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const SIDE: usize = 200;
const BOUNCES: usize = 5;

/// A square of pixels that the scene about fills, seen from outside; from inside
/// where the environment says `FROM_INSIDE`, for scenes of rooms.
pub(crate) fn camera(tree: &BspTree<Triangle>) -> Vec<RaySegment> {
    let Some(bounds) = tree.bounds() else {
        return Vec::new();
    };
    let extent = bounds.max - bounds.min;
    let is_inside = std::env::var_os("FROM_INSIDE").is_some();
    let (distance, width) = if is_inside { (0.3, 0.5) } else { (1.6, 1.1) };
    let towards_eye = Vec3::new(0.6, 0.2, 0.77).normalize();
    let eye = bounds.center() + towards_eye * extent.length() * distance;
    let right = Vec3::Y.cross(towards_eye).normalize();
    let up = towards_eye.cross(right);
    let offset = |index: usize| width * ((index as f32 + 0.37) / SIDE as f32 - 0.5);
    let target = |pixel: usize| {
        let [x, y] = [pixel % SIDE, pixel / SIDE].map(offset);
        bounds.center() + extent.length() * (x * right + y * up)
    };
    let rays = (0..SIDE * SIDE).map(|pixel| RaySegment::new(eye, target(pixel) - eye));
    rays.collect()
}

/// The rays of a camera with up to five diffuse bounces each.
pub(crate) fn paths(tree: &BspTree<Triangle>) -> Vec<RaySegment> {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let mut rays = Vec::new();
    for mut ray in camera(tree) {
        rays.push(ray);
        for _ in 0..BOUNCES {
            let Some(hit) = tree.closest_hit(&ray) else {
                break;
            };
            let Some(surface) = tree.surface(&ray, &hit) else {
                break;
            };
            let normal = surface.normal.normalize_or(Vec3::Y);
            let outward = if normal.dot(ray.direction) > 0.0 {
                -normal
            } else {
                normal
            };
            let direction = outward + on_sphere(&mut random);
            ray = RaySegment::new(surface.origin_towards(direction), direction);
            rays.push(ray);
        }
    }
    rays
}

fn on_sphere(random: &mut Pcg64Mcg) -> Vec3 {
    loop {
        let point = Vec3::from([0; 3].map(|_| random.random_range(-1.0..1.0_f32)));
        if (0.01..1.0).contains(&point.length()) {
            return point.normalize();
        }
    }
}
