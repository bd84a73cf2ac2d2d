//! A plane that splits a node, and how far from it both sides are visited.

use accel_core::geometry::{Axis, Plane};
use accel_core::glam::{DVec3, Vec3};

/// A splitting plane as a tree stores it, with its *slack*: primitives that
/// reach no further over the plane than that are on one side alone. Traversal
/// visits both sides within the slack (Ize 2008, sections 3.2 and 4.1).
///
/// A general plane is scaled so that its slack is 1, so that the slack needs no
/// room in the node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SplitPlane {
    axis: Option<Axis>,
    normal: Vec3,
    offset: f32,
    slack: f32,
}

/// Of a positive number's bits, those of the power of two below it.
const POWER_OF_TWO: u32 = 0xff << 23;

impl SplitPlane {
    /// The plane through `point` with the unit normal of `plane`, and this slack
    /// in scene units; `None` if its numbers do not fit single precision.
    pub(crate) fn general(plane: &Plane, point: Vec3, slack: f64) -> Option<Self> {
        let normal = (plane.normal.as_dvec3() / slack).as_vec3();
        let offset = normal.as_dvec3().dot(point.as_dvec3()) as f32;
        let is_usable = normal.is_finite() && offset.is_finite() && normal.length_squared() > 0.0;
        is_usable.then_some(Self {
            axis: None,
            normal,
            offset,
            slack: 1.0,
        })
    }

    /// The plane at `position` on `axis`, its slack rounded up.
    pub(crate) fn axis_aligned(axis: Axis, position: f32, slack: f64) -> Self {
        let slack = accel_core::geometry::rounding::up(slack).max(f32::MIN_POSITIVE);
        Self {
            axis: Some(axis),
            normal: axis.unit(),
            offset: position,
            slack,
        }
    }

    /// The plane of these stored numbers, a general one without `axis`.
    pub(crate) fn from_stored(axis: Option<Axis>, normal: Vec3, offset: f32, slack: f32) -> Self {
        Self {
            axis,
            normal,
            offset,
            slack,
        }
    }

    /// The axis that the plane is orthogonal to, where it is stored as such.
    pub(crate) fn axis(&self) -> Option<Axis> {
        self.axis
    }

    /// This plane, stored as a general one; `None` if its numbers do not fit.
    pub(crate) fn generalised(&self) -> Option<Self> {
        let plane = Plane {
            normal: self.normal,
            offset: self.offset,
        };
        Self::general(&plane, self.normal * self.offset, f64::from(self.slack))
    }

    /// This axis-aligned plane, stored as a general one: scaled by a power of two, it
    /// is the very same plane, of at most twice the slack. `None` if its numbers do not
    /// fit.
    pub(crate) fn with_slack_of_its_own(&self) -> Option<Self> {
        let scale = f32::from_bits((1.0 / self.slack).to_bits() & POWER_OF_TWO);
        let (normal, offset) = (self.normal * scale, self.offset * scale);
        let is_exact = scale >= f32::MIN_POSITIVE && offset / scale == self.offset;
        is_exact.then_some(Self {
            axis: None,
            normal,
            offset,
            slack: 1.0,
        })
    }

    /// Points to the front.
    #[inline]
    pub(crate) fn normal(&self) -> DVec3 {
        self.normal.as_dvec3()
    }

    /// The signed distance of the origin, negated.
    #[inline]
    pub(crate) fn offset(&self) -> f64 {
        f64::from(self.offset)
    }

    /// How much of its slack the build uses, in units of the signed distance: a
    /// little is left to the traversal, which rounds.
    #[inline]
    pub(crate) fn slack(&self) -> f64 {
        const SHARE: f64 = 1.0 - 1.0 / (1 << 20) as f64;
        f64::from(self.slack) * SHARE
    }

    /// From the stored values, in double precision.
    #[inline]
    pub(crate) fn signed_distance(&self, point: DVec3) -> f64 {
        self.normal().dot(point) - self.offset()
    }

    /// Normal, offset and slack as a node stores them.
    pub(crate) fn stored(&self) -> (Vec3, f32, f32) {
        (self.normal, self.offset, self.slack)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_aligned_plane_is_the_same_when_stored_as_a_general_one() {
        for (position, slack) in [(3.1_f32, 0.001_f32), (-7e5, 3.0), (0.0, 1e-38), (1e9, 5e6)] {
            let plane = SplitPlane::axis_aligned(Axis::Y, position, slack.into());
            let general = plane.with_slack_of_its_own().unwrap();
            let scale = general.normal.y;
            assert_eq!(general.offset / scale, position);
            assert_eq!((general.axis, general.slack), (None, 1.0));
            let own = 1.0 / scale;
            assert!((slack..=2.0 * slack).contains(&own), "{own} for {slack}");
            let point = DVec3::new(1.0, 2.0, 3.0);
            let distance = plane.signed_distance(point) * f64::from(scale);
            assert_eq!(general.signed_distance(point), distance);
        }
        let plane = SplitPlane::axis_aligned(Axis::X, 1e30, 1e-30);
        assert_eq!(plane.with_slack_of_its_own(), None);
    }
}
