//! The closest hit.

use std::ops::ControlFlow;

use super::{Hit, Query};
use crate::ray::Ray;

/// Finds the hit with the smallest `t`; of equals, the one with the smallest id.
#[derive(Clone, Copy, Debug)]
pub struct ClosestHit {
    t_max: f32,
    best: Option<Hit>,
}

impl ClosestHit {
    /// For the whole interval of `ray`.
    #[inline]
    pub fn new(ray: &impl Ray) -> Self {
        Self {
            t_max: ray.t_max(),
            best: None,
        }
    }

    /// The closest hit offered so far.
    #[inline]
    pub fn best(&self) -> Option<Hit> {
        self.best
    }
}

impl Query for ClosestHit {
    #[inline]
    fn t_max(&self) -> f32 {
        self.t_max
    }

    #[inline]
    fn offer(&mut self, hit: &Hit) -> ControlFlow<()> {
        if self.best.is_none_or(|best| hit.precedes(&best)) {
            self.t_max = hit.t;
            self.best = Some(*hit);
        }
        ControlFlow::Continue(())
    }
}
