//! From every primary hit to a point light.

use accel_core::RaySegment;
use accel_core::glam::Vec3;

use super::{RaySource, primary, sampling};

pub(super) fn rays(source: &RaySource<'_>) -> (Vec<RaySegment>, Option<String>) {
    let light = light(source);
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

/// The light hangs above the camera to the right, as far aside as what it looks
/// at is away; nearer where something stands between, so that it is in the open
/// wherever the camera is.
fn light(source: &RaySource<'_>) -> Vec3 {
    let camera = &source.camera;
    let forward = camera.look_at - camera.eye;
    let right = forward.cross(camera.up).normalize_or_zero();
    let up = right.cross(forward).normalize_or_zero();
    let aside = (right + up) * 0.7 * forward.length();
    let places = [1.0, 0.5, 0.25, 0.1, 0.05].map(|fraction| camera.eye + aside * fraction);
    let is_open = |place: &Vec3| {
        let mut blocked = [false];
        let sight = RaySegment::between(camera.eye, camera.eye + (*place - camera.eye) * 1.2);
        source.structure.trace_any(&[sight], &mut blocked);
        !blocked[0]
    };
    places.into_iter().find(is_open).unwrap_or(camera.eye)
}
