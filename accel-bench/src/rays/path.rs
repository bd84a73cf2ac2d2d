//! Diffuse paths: five cosine-weighted bounces, no Russian roulette.

use accel_core::{Hit, RaySegment};

use super::{RaySource, primary, sampling};

const BOUNCES: usize = 5;

/// The bounces of one path after the other, as a path tracer traces them. A path
/// ends early only where it leaves the scene.
pub(super) fn rays(source: &RaySource<'_>) -> Vec<RaySegment> {
    let mut rays = Vec::new();
    for (pixel, (mut ray, hit)) in primary::traced(source).into_iter().enumerate() {
        let mut generator = sampling::generator(source.seed ^ 0x9a, pixel);
        let mut next = hit;
        for _ in 0..BOUNCES {
            let Some(hit) = next else { break };
            let Some(surface) = sampling::surface_towards(&ray, &hit, source.triangles) else {
                break;
            };
            let direction = sampling::cosine_direction(&surface, &mut generator);
            ray = RaySegment::new(surface.origin_towards(direction), direction);
            rays.push(ray);
            next = trace(source, &ray);
        }
    }
    rays
}

fn trace(source: &RaySource<'_>, ray: &RaySegment) -> Option<Hit> {
    let mut hit = [None];
    source
        .structure
        .trace_closest(std::slice::from_ref(ray), &mut hit);
    hit[0]
}
