//! Every hit along a ray.

use std::ops::ControlFlow;

use super::{Hit, Query};
use crate::ray::Ray;

/// Collects every hit in the ray's interval, for transparency or for counting
/// crossings.
#[derive(Clone, Debug)]
pub struct AllHits {
    t_max: f32,
    hits: Vec<Hit>,
}

impl AllHits {
    /// For the whole interval of `ray`.
    pub fn new(ray: &impl Ray) -> Self {
        Self {
            t_max: ray.t_max(),
            hits: Vec::new(),
        }
    }

    /// The hits by `t`, then id, each primitive once.
    pub fn into_sorted(mut self) -> Vec<Hit> {
        self.hits
            .sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.id.cmp(&b.id)));
        // A primitive that stands in several leaves gives the same t each time,
        // so its hits are neighbours now.
        self.hits.dedup_by_key(|hit| hit.id);
        self.hits
    }
}

impl Query for AllHits {
    #[inline]
    fn t_max(&self) -> f32 {
        self.t_max
    }

    #[inline]
    fn offer(&mut self, hit: &Hit) -> ControlFlow<()> {
        self.hits.push(*hit);
        ControlFlow::Continue(())
    }
}
