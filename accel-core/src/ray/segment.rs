//! The ready-made ray.

use glam::Vec3;

use super::Ray;

/// The ready-made ray: the points `origin + t * direction` with
/// `t_min <= t <= t_max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RaySegment {
    /// Where the ray starts, in scene units.
    pub origin: Vec3,
    /// Where it goes; need not have unit length.
    pub direction: Vec3,
    /// The smallest `t` of interest, inclusive.
    pub t_min: f32,
    /// The largest `t` of interest, inclusive; may be infinite.
    pub t_max: f32,
}

impl RaySegment {
    /// A ray from `origin` along `direction` without an end.
    pub fn new(origin: impl Into<Vec3>, direction: impl Into<Vec3>) -> Self {
        Self {
            origin: origin.into(),
            direction: direction.into(),
            t_min: 0.0,
            t_max: f32::INFINITY,
        }
    }

    /// The segment from `from` to `to`: `t` runs from 0 to 1. Any-hit queries
    /// with it tell whether two points see each other.
    pub fn between(from: impl Into<Vec3>, to: impl Into<Vec3>) -> Self {
        let (from, to) = (from.into(), to.into());
        Self::new(from, to - from).with_interval(0.0, 1.0)
    }

    /// The same line with another interval.
    #[must_use]
    pub fn with_interval(self, t_min: f32, t_max: f32) -> Self {
        Self {
            t_min,
            t_max,
            ..self
        }
    }
}

impl Ray for RaySegment {
    fn origin(&self) -> Vec3 {
        self.origin
    }
    fn direction(&self) -> Vec3 {
        self.direction
    }
    fn t_min(&self) -> f32 {
        self.t_min
    }
    fn t_max(&self) -> f32 {
        self.t_max
    }
}
