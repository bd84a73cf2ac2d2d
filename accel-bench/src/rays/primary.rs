//! One ray through the middle of every pixel.

use accel_core::{Hit, RaySegment};

use super::RaySource;

pub(super) fn rays(source: &RaySource<'_>) -> Vec<RaySegment> {
    source.camera.rays(source.size.0, source.size.1)
}

/// The primary rays with their hits.
pub(super) fn traced(source: &RaySource<'_>) -> Vec<(RaySegment, Option<Hit>)> {
    let rays = rays(source);
    let mut hits = vec![None; rays.len()];
    source.structure.trace_closest(&rays, &mut hits);
    rays.into_iter().zip(hits).collect()
}
