//! One primary ray and four ambient occlusion rays per pixel, over several
//! viewpoints.

use accel_core::{DynStructure, RaySegment, TraversalCounters};
use rayon::prelude::*;

use super::{Settings, bounds};
use crate::measure;
use crate::rays::{RAYS_PER_HIT, RayKind, RaySet, RaySource};
use crate::report::model::{MeanMax, Spread};
use crate::scene::Scene;

/// The rays of all pixels of all viewpoints.
pub(super) struct PixelRays {
    /// Of each pixel its primary ray.
    primary: RaySet,
    /// Of each pixel that shows something its ambient occlusion rays.
    ambient: RaySet,
    /// Of each pixel the ambient occlusion rays, again.
    by_pixel: Vec<Option<[RaySegment; RAYS_PER_HIT]>>,
}

/// What a tree does per pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Work {
    /// Inner nodes visited, each with two box tests.
    pub traversals: MeanMax,
    /// Triangles tested.
    pub intersections: MeanMax,
}

/// The speeds of a tree, relative to the last one's in the same round.
#[derive(Clone, Copy, Debug)]
pub(super) struct Speeds {
    pub primary: Spread,
    pub ambient: Spread,
}

impl PixelRays {
    pub(super) fn new(scene: &Scene, finder: &dyn DynStructure, settings: &Settings) -> Self {
        let bounds = bounds(scene);
        let mut primary = Vec::new();
        let mut by_pixel = Vec::new();
        if !bounds.is_empty() {
            for camera in scene.camera.viewpoints(&bounds, settings.viewpoints) {
                let source = RaySource {
                    structure: finder,
                    triangles: &scene.triangles,
                    camera,
                    size: settings.size,
                    bounds,
                    ambient_length: settings.ambient_length,
                    seed: settings.seed,
                };
                primary.extend(source.rays(RayKind::Primary).rays);
                by_pixel.extend(source.ambient_occlusion_by_pixel());
            }
        }
        let ambient = by_pixel.iter().flatten().flatten().copied().collect();
        let set = |kind, rays| RaySet {
            kind,
            rays,
            note: None,
        };
        Self {
            primary: set(RayKind::Primary, primary),
            ambient: set(RayKind::AmbientOcclusion, ambient),
            by_pixel,
        }
    }

    pub(super) fn sets(&self) -> [&RaySet; 2] {
        [&self.primary, &self.ambient]
    }

    /// Pixels that show something, in percent.
    pub(super) fn coverage(&self) -> f64 {
        let shown = self.by_pixel.iter().flatten().count();
        100.0 * shown as f64 / self.by_pixel.len().max(1) as f64
    }

    /// Traces all rays and counts, the rays of a pixel added up.
    pub(super) fn count(&self, structure: &dyn DynStructure) -> Work {
        let pixels = self.primary.rays.par_iter().zip(&self.by_pixel);
        let counts: Vec<(u64, u64)> = pixels
            .map(|(primary, ambient)| count_pixel(structure, primary, ambient.as_ref()))
            .collect();
        Work {
            traversals: mean_max(counts.iter().map(|count| count.0)),
            intersections: mean_max(counts.iter().map(|count| count.1)),
        }
    }

    /// The speed of each tree relative to the last one.
    pub(super) fn speeds(&self, structures: &[&dyn DynStructure], rounds: usize) -> Vec<Speeds> {
        let sets = [self.primary.clone(), self.ambient.clone()];
        let timings = measure::time_rounds(structures, &sets, rounds, |_, _| true, || ());
        let relative = |structure: usize, set: usize| {
            let own = &timings[structure][set].mrays_per_second;
            let last = &timings[structures.len() - 1][set].mrays_per_second;
            let ratios: Vec<f64> = own.iter().zip(last).map(|(own, last)| own / last).collect();
            Spread::with_confidence(&ratios)
        };
        (0..structures.len())
            .map(|structure| Speeds {
                primary: relative(structure, 0),
                ambient: relative(structure, 1),
            })
            .collect()
    }
}

fn count_pixel(
    structure: &dyn DynStructure,
    primary: &RaySegment,
    ambient: Option<&[RaySegment; RAYS_PER_HIT]>,
) -> (u64, u64) {
    let mut counters = TraversalCounters::default();
    structure.count_closest(primary, &mut counters);
    for ray in ambient.into_iter().flatten() {
        structure.count_any(ray, &mut counters);
    }
    let inner_nodes = counters.nodes.sum - counters.leaves.sum;
    (inner_nodes, counters.primitive_tests.sum)
}

fn mean_max(counts: impl ExactSizeIterator<Item = u64> + Clone) -> MeanMax {
    let pixels = counts.len().max(1) as f64;
    MeanMax {
        mean: counts.clone().sum::<u64>() as f64 / pixels,
        max: counts.max().unwrap_or(0),
    }
}
