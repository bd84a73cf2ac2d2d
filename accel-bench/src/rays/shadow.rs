//! From every primary hit to a point light.

use accel_core::RaySegment;

use super::{RaySource, primary, sampling};

/// The light hangs above the camera, to the right, a tenth of the way to what
/// it looks at: in the open wherever the camera is.
pub(super) fn rays(source: &RaySource<'_>) -> (Vec<RaySegment>, Option<String>) {
    let camera = &source.camera;
    let forward = camera.look_at - camera.eye;
    let right = forward.cross(camera.up).normalize_or_zero();
    let up = right.cross(forward).normalize_or_zero();
    let light = camera.eye + (right + up) * (0.1 * forward.length());
    let rays = primary::traced(source)
        .into_iter()
        .filter_map(|(ray, hit)| {
            let surface = sampling::surface_towards(&ray, &hit?, source.triangles)?;
            let origin = surface.origin_towards(light - surface.point);
            Some(RaySegment::between(origin, light))
        })
        .collect();
    (rays, Some(format!("to a point light at {light}")))
}
