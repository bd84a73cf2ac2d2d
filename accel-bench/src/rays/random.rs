//! Between random points on a sphere around the scene.

use accel_core::RaySegment;

use super::{RaySource, sampling};

/// As many as there are pixels.
pub(super) fn rays(source: &RaySource<'_>) -> Vec<RaySegment> {
    let count = source.size.0 as usize * source.size.1 as usize;
    let center = source.bounds.center();
    let radius = source.diagonal() * 0.5;
    (0..count)
        .map(|index| {
            let mut generator = sampling::generator(source.seed ^ 0x5e, index);
            let [from, to] =
                [(); 2].map(|()| center + sampling::direction(&mut generator) * radius);
            RaySegment::new(from, to - from)
        })
        .collect()
}
