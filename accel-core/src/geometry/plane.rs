//! Planes of any orientation, and on which side of them things lie.

use glam::Vec3;

use super::Axis;

/// The plane of all points `p` with `normal . p = offset`, as stored in a
/// tree: the stored single-precision values *are* the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Points to the front side; need not have unit length.
    pub normal: Vec3,
    /// `normal . p` for the points of the plane.
    pub offset: f32,
}

/// Where something lies relative to a plane, within a tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Wholly on the side that the normal points to.
    Front,
    /// Wholly on the other side.
    Back,
    /// Within the tolerance of the plane.
    Planar,
    /// On both sides.
    Straddling,
}

impl Plane {
    /// The plane at `position` on `axis`, its normal along the axis.
    pub fn axis_aligned(axis: Axis, position: f32) -> Self {
        Self {
            normal: axis.unit(),
            offset: position,
        }
    }

    /// The plane through `point` with the given normal.
    pub fn through(point: Vec3, normal: Vec3) -> Self {
        Self {
            normal,
            offset: normal.as_dvec3().dot(point.as_dvec3()) as f32,
        }
    }

    /// The signed distance of `point`, in lengths of the normal times scene
    /// units: positive in front. Evaluated in double precision from the stored
    /// values.
    #[inline]
    pub fn signed_distance(&self, point: Vec3) -> f64 {
        self.normal.as_dvec3().dot(point.as_dvec3()) - f64::from(self.offset)
    }
}

impl Side {
    /// The side of something whose signed distances run from `smallest` to
    /// `largest`: in front only if all are at least `-epsilon`, behind only if
    /// all are at most `epsilon`, planar if both.
    pub fn of_range(smallest: f64, largest: f64, epsilon: f64) -> Self {
        match (smallest >= -epsilon, largest <= epsilon) {
            (true, true) => Self::Planar,
            (true, false) => Self::Front,
            (false, true) => Self::Back,
            (false, false) => Self::Straddling,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_follow_the_tolerance() {
        assert_eq!(Side::of_range(-0.5, 0.5, 1.0), Side::Planar);
        assert_eq!(Side::of_range(-0.5, 5.0, 1.0), Side::Front);
        assert_eq!(Side::of_range(-5.0, 0.5, 1.0), Side::Back);
        assert_eq!(Side::of_range(-5.0, 5.0, 1.0), Side::Straddling);
    }

    #[test]
    fn a_plane_through_a_point_has_it_at_distance_zero() {
        let plane = Plane::through(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.0, 2.0, 0.0));
        assert_eq!(plane.signed_distance(Vec3::new(9.0, 2.0, -4.0)), 0.0);
        assert_eq!(plane.signed_distance(Vec3::new(0.0, 3.0, 0.0)), 2.0);
        assert_eq!(Plane::axis_aligned(Axis::Y, 2.0).normal, Vec3::Y);
    }
}
