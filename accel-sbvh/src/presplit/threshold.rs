//! Down to which size primitives are divided.

use accel_core::{BuildError, Primitive};

use super::{Presplit, Subdivision};

/// Down to which size primitives are divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Threshold {
    /// This size; finite and at least 0. What it measures is up to the method.
    Size(f64),
    /// Whatever size makes this many times as many references as there are
    /// primitives, within 0.5 % where sizes differ enough for that; finite and
    /// at least 1.
    Factor(f64),
    /// Whatever size makes this many references, within 0.5 % where sizes differ
    /// enough for that: the comparison of Stich 2009, Table 1, needs it.
    References(usize),
}

/// How far the number of references may be off, relative to the one asked for.
const TOLERANCE: f64 = 0.005;

/// Bisections of the logarithm of the threshold.
const MOST_STEPS: u32 = 64;

/// The smallest threshold tried, relative to the largest.
const SMALLEST: f64 = 1e-30;

impl Threshold {
    pub(super) fn validate(&self) -> Result<(), BuildError> {
        let is_valid = match *self {
            // The ranges reject NaN as well.
            Self::Size(size) => (0.0..f64::INFINITY).contains(&size),
            Self::Factor(factor) => (1.0..f64::INFINITY).contains(&factor),
            Self::References(_) => true,
        };
        if is_valid {
            return Ok(());
        }
        Err(BuildError::InvalidSetting {
            setting: "threshold",
            value: format!("{self:?}"),
            allowed: "a finite size of at least 0, or a finite factor of at least 1",
        })
    }

    /// The size, found by bisection unless it is given; `most` references are
    /// never exceeded by one that is found.
    pub(super) fn resolve<P: Primitive, S: Subdivision<P>>(
        &self,
        scene: &Presplit<'_, P, S>,
        largest: f64,
        most: usize,
    ) -> f64 {
        let target = match *self {
            Self::Size(size) => return size,
            Self::Factor(factor) => (scene.wholes.len() as f64 * factor) as usize,
            Self::References(count) => count,
        };
        let target = target.min(most);
        // Fewer references above, more below; the larger threshold is kept.
        let (mut above, mut below) = (largest, largest * SMALLEST);
        for _ in 0..MOST_STEPS {
            let middle = (above * below).sqrt();
            let count = scene.count(middle, most);
            let is_close =
                |count: &usize| count.abs_diff(target) as f64 <= TOLERANCE * target as f64;
            if count.as_ref().is_some_and(is_close) {
                return middle;
            }
            match count {
                Some(count) if count < target => above = middle,
                _ => below = middle,
            }
        }
        above
    }
}
