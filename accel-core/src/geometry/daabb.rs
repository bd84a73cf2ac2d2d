//! Boxes in double precision, for results of clipping.

use glam::DVec3;

use super::{Aabb, rounding};

/// An axis-aligned box in double precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DAabb {
    /// The smallest coordinates.
    pub min: DVec3,
    /// The largest coordinates.
    pub max: DVec3,
}

impl DAabb {
    /// The smallest box around `points`, or `None` if there are none.
    pub fn around(points: &[DVec3]) -> Option<Self> {
        let (&first, rest) = points.split_first()?;
        let single = Self {
            min: first,
            max: first,
        };
        Some(rest.iter().fold(single, |bounds, &point| Self {
            min: bounds.min.min(point),
            max: bounds.max.max(point),
        }))
    }

    /// The smallest single-precision box around this one.
    pub fn rounded_outward(&self) -> Aabb {
        Aabb {
            min: rounding::vec3_down(self.min),
            max: rounding::vec3_up(self.max),
        }
    }

    /// The smallest single-precision box around this one enlarged by `pad` on
    /// every side.
    pub fn padded(&self, pad: f64) -> Aabb {
        Aabb {
            min: rounding::vec3_down(self.min - pad),
            max: rounding::vec3_up(self.max + pad),
        }
    }
}

impl From<Aabb> for DAabb {
    fn from(bounds: Aabb) -> Self {
        Self {
            min: bounds.min.as_dvec3(),
            max: bounds.max.as_dvec3(),
        }
    }
}
