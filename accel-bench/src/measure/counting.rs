//! Counts of what traversals do, apart from any timing.

use accel_core::{DynStructure, RaySegment, TraversalCounters};
use rayon::prelude::*;

use crate::rays::{Question, RaySet};

/// The counters over all rays of a set, and how many rays hit something.
pub fn count(structure: &dyn DynStructure, set: &RaySet) -> (TraversalCounters, usize) {
    let question = set.kind.question();
    set.rays
        .par_chunks(1024)
        .map(|rays| {
            let mut counters = TraversalCounters::default();
            let hits = rays
                .iter()
                .filter(|ray| count_one(structure, question, ray, &mut counters))
                .count();
            (counters, hits)
        })
        .reduce(
            || (TraversalCounters::default(), 0),
            |(mut counters, hits), (others, other_hits)| {
                counters.merge(&others);
                (counters, hits + other_hits)
            },
        )
}

/// The counters of each ray apart, for heat maps; closest hits.
pub fn count_pixels(structure: &dyn DynStructure, rays: &[RaySegment]) -> Vec<TraversalCounters> {
    rays.par_iter()
        .map(|ray| {
            let mut counters = TraversalCounters::default();
            structure.count_closest(ray, &mut counters);
            counters
        })
        .collect()
}

fn count_one(
    structure: &dyn DynStructure,
    question: Question,
    ray: &RaySegment,
    counters: &mut TraversalCounters,
) -> bool {
    match question {
        Question::Closest => structure.count_closest(ray, counters).is_some(),
        Question::Any => structure.count_any(ray, counters),
        Question::All => !structure.count_all(ray, counters).is_empty(),
    }
}
