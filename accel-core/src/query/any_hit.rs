//! Whether there is any hit at all.

use std::ops::ControlFlow;

use super::{Hit, Query};
use crate::ray::Ray;

/// Tells whether anything is hit and stops at the first hit, whichever it is.
#[derive(Clone, Copy, Debug)]
pub struct AnyHit {
    t_max: f32,
    found: bool,
}

impl AnyHit {
    /// For the whole interval of `ray`.
    #[inline]
    pub fn new(ray: &impl Ray) -> Self {
        Self {
            t_max: ray.t_max(),
            found: false,
        }
    }

    /// Whether a hit was offered.
    #[inline]
    pub fn found(&self) -> bool {
        self.found
    }
}

impl Query for AnyHit {
    #[inline]
    fn t_max(&self) -> f32 {
        self.t_max
    }

    #[inline]
    fn offer(&mut self, _: &Hit) -> ControlFlow<()> {
        self.found = true;
        ControlFlow::Break(())
    }
}
