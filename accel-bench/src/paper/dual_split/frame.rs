//! A frame of a path tracer: a primary ray per pixel and up to five diffuse
//! bounces, without Russian roulette (Lin 2019, section 5).

use accel_core::{Aabb, DynStructure, Primitive};

use super::Settings;
use crate::measure;
use crate::rays::{RayKind, RaySet, RaySource};
use crate::report::model::Spread;
use crate::scene::Scene;

/// Rays that a structure answers before it is the next one's turn.
const TURN: usize = 8192;

/// The rays of a frame. They do not depend on the structure that finds the hits.
pub(super) struct Frame {
    set: RaySet,
    pub primary: usize,
}

impl Frame {
    pub(super) fn new(scene: &Scene, finder: &dyn DynStructure, settings: &Settings) -> Self {
        let boxes = scene.triangles.iter().map(Primitive::bounds);
        let bounds = boxes
            .filter(Aabb::is_valid)
            .fold(Aabb::EMPTY, |all, bounds| all.union(&bounds));
        let mut rays = Vec::new();
        let mut primary = 0;
        if !bounds.is_empty() {
            let source = RaySource {
                structure: finder,
                triangles: &scene.triangles,
                camera: scene.camera,
                size: settings.size,
                bounds,
                ambient_length: RaySource::AMBIENT_LENGTH,
                seed: settings.seed,
            };
            rays = source.rays(RayKind::Primary).rays;
            primary = rays.len();
            rays.extend(source.rays(RayKind::Path).rays);
        }
        let kind = RayKind::Path;
        let set = RaySet {
            kind,
            rays,
            note: None,
        };
        Self { set, primary }
    }

    pub(super) fn rays(&self) -> &RaySet {
        &self.set
    }

    /// The time that the frame's rays take in each structure, relative to the first
    /// one's in the same round. Structures take turns of a few thousand rays.
    pub(super) fn times(&self, structures: &[&dyn DynStructure], rounds: usize) -> Vec<Spread> {
        let turns: Vec<RaySet> = self
            .set
            .rays
            .chunks(TURN)
            .map(|rays| RaySet {
                kind: self.set.kind,
                rays: rays.to_vec(),
                note: None,
            })
            .collect();
        let timings = measure::time_rounds(structures, &turns, rounds, |_, _| true, || ());
        let time = |structure: usize, round: usize| -> f64 {
            let turns = turns.iter().zip(&timings[structure]);
            turns
                .map(|(set, timings)| set.rays.len() as f64 / timings.mrays_per_second[round])
                .sum()
        };
        (0..structures.len())
            .map(|structure| {
                let ratios: Vec<f64> = (0..rounds)
                    .map(|round| time(structure, round) / time(0, round).max(1e-30))
                    .collect();
                Spread::with_confidence(&ratios)
            })
            .collect()
    }
}
