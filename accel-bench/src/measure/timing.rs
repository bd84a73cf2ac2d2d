//! Speed, in rounds that go around all structures in turn.

use std::hint::black_box;
use std::time::Instant;

use accel_core::{DynStructure, RaySegment};
use rayon::prelude::*;

use crate::rays::{Question, RaySet};

/// Rays that one task traces.
const CHUNK: usize = 4096;

/// Millions of rays per second, one figure per round.
#[derive(Clone, Debug, Default)]
pub struct Timings {
    /// In order of rounds.
    pub mrays_per_second: Vec<f64>,
}

/// Traces every ray set through every structure, `rounds` times: round by round,
/// set by set, structure by structure, so that what disturbs the machine
/// disturbs all alike. Structures and sets, by their positions, that are not
/// `is_timed` are left out. Returns timings by structure, then by ray set. Runs
/// on the current thread pool; `tick` is called after every measurement.
pub fn time_rounds(
    structures: &[&dyn DynStructure],
    sets: &[RaySet],
    rounds: usize,
    is_timed: impl Fn(usize, usize) -> bool,
    mut tick: impl FnMut(),
) -> Vec<Vec<Timings>> {
    let mut timings = vec![vec![Timings::default(); sets.len()]; structures.len()];
    // Touches all memory once; what the first pass costs is not measured.
    for structure in structures {
        for set in sets {
            trace(
                *structure,
                set.kind.question(),
                &set.rays[..set.rays.len().min(CHUNK)],
            );
        }
    }
    for round in 0..rounds {
        for (position, set) in sets.iter().enumerate() {
            for turn in 0..structures.len() {
                // Another structure goes first in each round.
                let turn = (turn + round) % structures.len();
                if !is_timed(turn, position) {
                    tick();
                    continue;
                }
                let start = Instant::now();
                trace(structures[turn], set.kind.question(), &set.rays);
                let seconds = start.elapsed().as_secs_f64();
                let rate = set.rays.len() as f64 / seconds.max(1e-9) * 1e-6;
                timings[turn][position].mrays_per_second.push(rate);
                tick();
            }
        }
    }
    timings
}

/// The time of each pixel's ray on the calling thread, the shortest of a few; closest
/// hits.
pub fn nanoseconds_of_pixels(structure: &dyn DynStructure, rays: &[RaySegment]) -> Vec<u32> {
    const ROUNDS: usize = 5;
    let mut shortest = vec![u32::MAX; rays.len()];
    let mut hit = [None];
    for _ in 0..ROUNDS {
        for (ray, shortest) in rays.iter().zip(&mut shortest) {
            let start = Instant::now();
            structure.trace_closest(std::slice::from_ref(ray), &mut hit);
            let elapsed = start.elapsed().as_nanos().min(u128::from(u32::MAX)) as u32;
            *shortest = (*shortest).min(elapsed);
        }
    }
    shortest
}

fn trace(structure: &dyn DynStructure, question: Question, rays: &[RaySegment]) {
    rays.par_chunks(CHUNK).for_each(|rays| match question {
        Question::Closest => {
            let mut hits = vec![None; rays.len()];
            structure.trace_closest(rays, &mut hits);
            black_box(hits);
        }
        Question::Any => {
            let mut answers = vec![false; rays.len()];
            structure.trace_any(rays, &mut answers);
            black_box(answers);
        }
        Question::All => {
            let mut hits = vec![Vec::new(); rays.len()];
            structure.trace_all(rays, &mut hits);
            black_box(hits);
        }
    });
}
