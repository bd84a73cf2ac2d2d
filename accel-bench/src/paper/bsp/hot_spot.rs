//! The part of the picture over which the kd-tree works hardest, as if a user "by
//! chance" zoomed in on it (sections 5.2 and 6).

use accel_core::{DynStructure, TraversalCounters};

use crate::measure;
use crate::scene::camera::Camera;

/// The hot spot is this part of the picture, across and down.
const PART: u32 = 8;

/// A camera on a hot spot.
#[derive(Clone, Copy, Debug)]
pub(super) struct HotSpot {
    pub camera: Camera,
    /// What the kd-tree does there, per pixel, of what it does in the whole picture.
    pub times_the_mean: f64,
}

/// Looks at the hottest part of the picture from where `camera` stands; `None` if
/// nothing is hot.
pub(super) fn find(
    kd_tree: &dyn DynStructure,
    camera: Camera,
    size: (u32, u32),
) -> Option<HotSpot> {
    let rays = camera.rays(size.0, size.1);
    let counters = measure::count_pixels(kd_tree, &rays);
    let costs: Vec<u64> = counters.iter().map(cost).collect();
    let part = (size.0.div_ceil(PART), size.1.div_ceil(PART));
    let ((x, y), hottest) = hottest_part(&costs, size, part)?;
    let mean = costs.iter().sum::<u64>() as f64 / costs.len() as f64;
    let middle = camera.ray(x + part.0 / 2, y + part.1 / 2, size.0, size.1, [0.0; 2]);
    let distance = camera.eye.distance(camera.look_at).max(f32::MIN_POSITIVE);
    let half = f64::from(camera.vertical_fov_degrees).to_radians() / 2.0;
    let narrowed = 2.0 * (half.tan() / f64::from(PART)).atan().to_degrees();
    let camera = Camera {
        look_at: camera.eye + middle.direction * distance,
        vertical_fov_degrees: narrowed as f32,
        ..camera
    };
    Some(HotSpot {
        camera: camera.validated().ok()?,
        times_the_mean: hottest / mean,
    })
}

/// What the kd-tree does for a pixel: nodes, and triangles at the ratio of costs
/// that it is built with.
fn cost(counters: &TraversalCounters) -> u64 {
    3 * counters.nodes.sum + 4 * counters.primitive_tests.sum
}

/// The upper left pixel of the part with the largest mean, and that mean; parts
/// overlap by half.
fn hottest_part(costs: &[u64], size: (u32, u32), part: (u32, u32)) -> Option<((u32, u32), f64)> {
    let mean = |x: u32, y: u32| {
        let row = |y: u32| {
            let first = (y * size.0 + x) as usize;
            costs[first..first + part.0 as usize].iter().sum::<u64>()
        };
        (y..y + part.1).map(row).sum::<u64>() as f64 / f64::from(part.0 * part.1)
    };
    let steps = |length: u32, part: u32| (0..=length - part).step_by((part as usize / 2).max(1));
    let parts = steps(size.1, part.1).flat_map(|y| steps(size.0, part.0).map(move |x| (x, y)));
    parts
        .map(|(x, y)| ((x, y), mean(x, y)))
        .filter(|(_, mean)| *mean > 0.0)
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hottest_part_holds_the_hottest_pixels() {
        let mut costs = vec![1_u64; 64 * 32];
        for y in 20..24 {
            for x in 40..48 {
                costs[y * 64 + x] = 100;
            }
        }
        let (place, mean) = hottest_part(&costs, (64, 32), (8, 4)).unwrap();
        assert_eq!((place, mean), ((40, 20), 100.0));
        assert_eq!(hottest_part(&[0; 16], (4, 4), (1, 1)), None);
    }
}
