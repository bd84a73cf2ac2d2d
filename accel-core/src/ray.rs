//! Rays as a caller describes them.

use glam::Vec3;

/// What a traversal needs to know of a ray: implement it on a renderer's own
/// ray type and pass that to every query.
///
/// The direction need not have unit length; `t` counts in its lengths.
pub trait Ray {
    /// Where the ray starts, in scene units.
    fn origin(&self) -> Vec3;
    /// Where it goes: any finite vector but zero.
    fn direction(&self) -> Vec3;
    /// Hits nearer than this are not reported. Negative values count as 0.
    fn t_min(&self) -> f32 {
        0.0
    }
    /// Hits farther than this are not reported. May be infinite.
    fn t_max(&self) -> f32 {
        f32::INFINITY
    }
}

impl<R: Ray + ?Sized> Ray for &R {
    fn origin(&self) -> Vec3 {
        (**self).origin()
    }
    fn direction(&self) -> Vec3 {
        (**self).direction()
    }
    fn t_min(&self) -> f32 {
        (**self).t_min()
    }
    fn t_max(&self) -> f32 {
        (**self).t_max()
    }
}

/// Origin and direction, unbounded: `structure.closest_hit(&(origin, direction))`.
impl Ray for (Vec3, Vec3) {
    fn origin(&self) -> Vec3 {
        self.0
    }
    fn direction(&self) -> Vec3 {
        self.1
    }
}

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
