//! Where a ray crosses a plane, and how far from it both sides must be visited (Ize
//! 2008, section 4.1).

use accel_core::PreparedRay;
use accel_core::geometry::{Axis, rounding::UNIT_ROUNDOFF};
use accel_core::glam::{DVec3, Vec3};

use crate::plane_tracking::PlaneTracking;

/// What tau is made of. Both parts are needed: tests show that hits are lost
/// without either.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    /// How much of the slack that the build used.
    pub slack: f64,
    /// How far a hit may be off, relative to how far the ray has come: the
    /// kernel's rounding of vertices, of `t`, and the gate's clamp.
    pub rounding: f64,
}

impl Tolerance {
    pub(crate) const SAFE: Self = Self {
        slack: 1.0,
        rounding: 16.0 * UNIT_ROUNDOFF as f64,
    };
}

/// A node put off, with the part of the ray inside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment<T> {
    pub node: u32,
    pub near: f64,
    pub far: f64,
    pub planes: T,
}

/// The ray, and its tolerance, in double precision.
pub(crate) struct DoubleRay<'a> {
    pub ray: &'a PreparedRay,
    origin: DVec3,
    direction: DVec3,
    reciprocal: DVec3,
    /// The rounding of a hit per unit of `t`.
    rounding: DVec3,
    slack: f64,
}

/// A ray's signed distance from a plane: `start + t * slope`.
pub(crate) struct Crossing {
    start: f64,
    slope: f64,
    /// Where it is zero; of no meaning where the slope is.
    at: f64,
    tau: f64,
    /// How much of `t` tau is worth.
    reach: f64,
}

impl<'a> DoubleRay<'a> {
    pub(crate) fn new(ray: &'a PreparedRay, tolerance: Tolerance) -> Self {
        let direction = ray.direction().as_dvec3();
        Self {
            ray,
            origin: ray.origin().as_dvec3(),
            direction,
            reciprocal: direction.recip(),
            rounding: direction.abs() * tolerance.rounding,
            slack: tolerance.slack,
        }
    }

    /// The fast path of a kd-tree: one subtraction and two multiplications.
    #[inline]
    pub(crate) fn axis_aligned(&self, axis: Axis, position: f32, slack: f32, far: f64) -> Crossing {
        let index = axis.index();
        let start = self.origin[index] - f64::from(position);
        let tau = f64::from(slack) * self.slack + self.rounding[index] * far;
        let reciprocal = self.reciprocal[index];
        Crossing {
            start,
            slope: self.direction[index],
            at: -start * reciprocal,
            tau,
            reach: tau * reciprocal.abs(),
        }
    }

    #[inline]
    pub(crate) fn general(&self, normal: Vec3, offset: f32, far: f64) -> Crossing {
        let normal = normal.as_dvec3();
        let start = normal.dot(self.origin) - f64::from(offset);
        let slope = normal.dot(self.direction);
        let tau = self.slack + normal.abs().dot(self.rounding) * far;
        let reciprocal = 1.0 / slope;
        Crossing {
            start,
            slope,
            at: -start * reciprocal,
            tau,
            reach: tau * reciprocal.abs(),
        }
    }
}

impl Crossing {
    /// Signed distances of both ends.
    #[inline]
    fn ends<T>(&self, segment: &Segment<T>) -> [f64; 2] {
        [segment.near, segment.far].map(|t| self.start + t * self.slope)
    }

    /// Whether the ray comes within tau of the plane.
    #[inline]
    pub(crate) fn meets<T>(&self, segment: &Segment<T>) -> bool {
        let [s0, s1] = self.ends(segment);
        !(s0 > self.tau && s1 > self.tau || s0 < -self.tau && s1 < -self.tau)
    }

    /// The child that the ray enters first, and the other one if it enters both.
    #[inline]
    pub(crate) fn divide<T: PlaneTracking>(
        &self,
        segment: &Segment<T>,
        back: u32,
    ) -> (Segment<T>, Option<Segment<T>>) {
        let [s0, s1] = self.ends(segment);
        let planes = segment.planes.on_one_side();
        let of = |node| Segment {
            node,
            planes,
            ..*segment
        };
        if s0 > self.tau && s1 > self.tau {
            return (of(back + 1), None);
        }
        if s0 < -self.tau && s1 < -self.tau {
            return (of(back), None);
        }
        let [mut nearer, mut farther] = if self.slope < 0.0 {
            [of(back + 1), of(back)]
        } else {
            [of(back), of(back + 1)]
        };
        [nearer.planes, farther.planes] = segment.planes.divided(self.at);
        // Where the whole segment is within tau, no division by a tiny slope.
        if (s1 - s0).abs() > self.tau {
            nearer.far = nearer.far.min(self.at + self.reach);
            farther.near = farther.near.max(self.at - self.reach);
        }
        (nearer, Some(farther))
    }
}
