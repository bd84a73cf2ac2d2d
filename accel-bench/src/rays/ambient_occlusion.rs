//! Four short rays from every primary hit.

use accel_core::RaySegment;

use super::{RaySource, primary, sampling};

const RAYS_PER_HIT: usize = 4;

/// Their length, in diagonals of the scene.
const RELATIVE_LENGTH: f32 = 0.15;

pub(super) fn rays(source: &RaySource<'_>) -> (Vec<RaySegment>, Option<String>) {
    let length = source.diagonal() * RELATIVE_LENGTH;
    let mut rays = Vec::new();
    for (pixel, (ray, hit)) in primary::traced(source).into_iter().enumerate() {
        let surface = hit.and_then(|hit| sampling::surface_towards(&ray, &hit, source.triangles));
        let Some(surface) = surface else { continue };
        let mut generator = sampling::generator(source.seed ^ 0xa0, pixel);
        for _ in 0..RAYS_PER_HIT {
            let direction = sampling::cosine_direction(&surface, &mut generator);
            let origin = surface.origin_towards(direction);
            rays.push(RaySegment::new(origin, direction).with_interval(0.0, length));
        }
    }
    let note = format!("t_max = {length} ({RELATIVE_LENGTH} scene diagonals)");
    (rays, Some(note))
}
