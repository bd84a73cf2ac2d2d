//! Four short rays from every primary hit.

use accel_core::RaySegment;

use super::{RaySource, primary, sampling};

/// Ambient occlusion rays that start at every primary hit.
pub const RAYS_PER_HIT: usize = 4;

pub(super) fn rays(source: &RaySource<'_>) -> (Vec<RaySegment>, Option<String>) {
    let rays = by_pixel(source).into_iter().flatten().flatten().collect();
    let relative = source.ambient_length;
    let length = source.diagonal() * relative;
    let note = format!("t_max = {length} ({relative} scene diagonals)");
    (rays, Some(note))
}

/// For each pixel the rays from what it shows; `None` where that is nothing.
pub(super) fn by_pixel(source: &RaySource<'_>) -> Vec<Option<[RaySegment; RAYS_PER_HIT]>> {
    let length = source.diagonal() * source.ambient_length;
    let pixels = primary::traced(source).into_iter().enumerate();
    pixels
        .map(|(pixel, (ray, hit))| {
            let surface = sampling::surface_towards(&ray, &hit?, source.triangles)?;
            let mut generator = sampling::generator(source.seed ^ 0xa0, pixel);
            Some([(); RAYS_PER_HIT].map(|()| {
                let direction = sampling::cosine_direction(&surface, &mut generator);
                let origin = surface.origin_towards(direction);
                RaySegment::new(origin, direction).with_interval(0.0, length)
            }))
        })
        .collect()
}
