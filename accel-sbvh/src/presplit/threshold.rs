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
    /// enough for that: the comparison of Stich 2009, Table 1, needs it. At least
    /// one a primitive.
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

    /// How many references to search for; `None` if the size is given.
    ///
    /// # Errors
    /// [`BuildError::BudgetExceeded`] if there are more primitives than that, or
    /// if it is over `most`.
    pub(super) fn target(
        &self,
        primitives: usize,
        most: usize,
    ) -> Result<Option<usize>, BuildError> {
        let target = match *self {
            Self::Size(_) => return Ok(None),
            Self::Factor(factor) => (primitives as f64 * factor) as usize,
            Self::References(count) => count,
        };
        let exceeded = |needed, limit| {
            Err(BuildError::BudgetExceeded {
                what: "references",
                needed,
                limit,
            })
        };
        if target < primitives {
            return exceeded(primitives, target);
        }
        if target > most {
            return exceeded(target, most);
        }
        Ok(Some(target))
    }

    /// The size, found by bisection unless it is given; `most` references are
    /// never exceeded by one that is found.
    ///
    /// # Errors
    /// [`BuildError::Cancelled`] if the observer asked for it.
    pub(super) fn resolve<P: Primitive, S: Subdivision<P>>(
        &self,
        scene: &Presplit<'_, P, S>,
        target: Option<usize>,
        largest: f64,
        most: usize,
    ) -> Result<f64, BuildError> {
        let target = match (*self, target) {
            (Self::Size(size), _) => return Ok(size),
            (_, target) => target.unwrap_or(most),
        };
        // Fewer references above, more below; the larger threshold is kept.
        let (mut above, mut below) = (largest, largest * SMALLEST);
        for _ in 0..MOST_STEPS {
            let middle = (above * below).sqrt();
            let count = scene.count(middle, most)?;
            if count.is_some_and(|count| is_close(count, target)) {
                return Ok(middle);
            }
            match count {
                Some(count) if count < target => above = middle,
                _ => below = middle,
            }
        }
        Ok(above)
    }
}

/// Whether a number of references is the one asked for, within the tolerance.
pub(super) fn is_close(count: usize, target: usize) -> bool {
    count.abs_diff(target) as f64 <= TOLERANCE * target as f64
}
