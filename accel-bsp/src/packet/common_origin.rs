//! Where the rays of one origin cross a plane, in single precision.
//!
//! The distance of the origin is one number for the whole vector, and taken in
//! double precision: there is the cancellation for which single rays need a larger
//! tau. With `a` the distance of the origin, `b` the speed at which a ray comes
//! nearer, and tau as in [`crate::crossing`],
//!
//! ```text
//! the origin's side ends at     (a + tau) / max(b, r)
//! the other side begins at      (a - tau) / max(b, r)        tau = slack + r t
//! ```
//!
//! where `r` bounds the rounding per unit of `t`, `t` being where the ray leaves
//! the cell. A ray that comes nearer more slowly than that, or goes away, counts as
//! coming nearer at speed `r`: then the origin's side ends at `t` or later, and the
//! other side begins sooner than it does. So both are on the safe side without a
//! case of their own.
//!
//! `r` is 32 units of rounding of the speed's terms. A hit is off by up to 16
//! ([`HIT_ROUNDING`](crate::crossing::HIT_ROUNDING)), `b` by 3, and the quotients by
//! 4 of themselves, which within the cell is no more than 8 of `b t`. Rays for which `a`
//! or `b` could overflow are traced one by one. Where tau or a quotient does, what follows
//! is infinite on the safe side, or NaN, which constrains nothing.

use accel_core::geometry::{Axis, rounding::UNIT_ROUNDOFF};
use accel_core::glam::{DVec3, Vec3, Vec4};
use accel_core::simd::Lanes;
use accel_core::structure::CellVisit;

use crate::crossing::{PlaneLimits, least_rounding};

/// Bounds the rounding, relative to the terms of the speed.
const ROUNDING: f64 = 32.0 * UNIT_ROUNDOFF as f64;

/// Rays of one origin, with what does not depend on the plane.
#[derive(Clone, Copy, Debug)]
pub struct CommonOrigin<L> {
    origin: DVec3,
    directions: [L; 3],
    /// By axis, the largest component of the directions times [`ROUNDING`], or
    /// [`least_rounding`].
    rounding: DVec3,
    /// By axis, for planes whose front holds the origin and for those whose back
    /// does: 1 over the speed at which the rays come nearer.
    reciprocals: [[L; 2]; 3],
}

/// Where rays cross a plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct CrossingLanes<L> {
    /// Which side of the plane rays are on first.
    pub is_origin_behind: bool,
    /// By ray, where the other side begins.
    pub entry: L,
    /// By ray, where the origin's side ends.
    pub exit: L,
}

/// A plane, as seen from the origin of the rays.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// The signed distance of the origin.
    start: f64,
    slack: f32,
    /// Rounding per unit of `t`.
    rounding: f32,
}

impl<L: Lanes> CommonOrigin<L> {
    /// `None` where a distance or a speed could overflow for planes of these limits, or
    /// one over a speed is no normal number.
    #[inline(always)]
    pub(super) fn new(origin: Vec3, directions: [L; 3], limits: PlaneLimits) -> Option<Self> {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let largest = directions.map(|components| {
            let components = components.lanes().iter();
            components.fold(0.0_f32, |most, component| most.max(component.abs()))
        });
        let largest = Vec3::from(largest);
        let fastest = largest.max_element();
        let may_overflow = limits.may_overflow(origin.extend(-1.0), largest.extend(0.0));
        if may_overflow || fastest * f32::MIN_POSITIVE > 1.0 {
            return None;
        }
        let least = least_rounding(fastest);
        let mut rounding = DVec3::ZERO;
        let mut reciprocals = [[zero; 2]; 3];
        for axis in 0..3 {
            let speed = directions[axis];
            rounding[axis] = (f64::from(largest[axis]) * ROUNDING).max(f64::from(least));
            let least = L::splat(in_single(rounding[axis]));
            let speeds = [least.max_or_keep(zero - speed), least.max_or_keep(speed)];
            reciprocals[axis] = [one / speeds[0], one / speeds[1]];
        }
        Some(Self {
            origin: origin.as_dvec3(),
            directions,
            rounding,
            reciprocals,
        })
    }

    /// The fast path: no dot product and no division.
    #[inline(always)]
    pub(super) fn axis_aligned(
        &self,
        axis: Axis,
        position: f32,
        slack: f32,
        far: L,
    ) -> CrossingLanes<L> {
        let index = axis.index();
        let seen = Seen {
            start: self.origin[index] - f64::from(position),
            slack,
            rounding: in_single(self.rounding[index]),
        };
        let reciprocals = &self.reciprocals[index];
        seen.crossed_at(reciprocals[usize::from(seen.is_behind())], far)
    }

    /// Of a general plane, its offset behind its normal.
    #[inline(always)]
    pub(super) fn general(&self, plane: Vec4, far: L) -> CrossingLanes<L> {
        let (normal, offset) = (plane.truncate(), plane.w);
        let normal_in_double = normal.as_dvec3();
        let seen = Seen {
            start: normal_in_double.dot(self.origin) - f64::from(offset),
            slack: 1.0,
            rounding: in_single(normal_in_double.abs().dot(self.rounding)),
        };
        let towards = if seen.is_behind() { normal } else { -normal };
        let [x, y, z] = self.directions;
        let speed = x * L::splat(towards.x) + y * L::splat(towards.y) + z * L::splat(towards.z);
        let speed = L::splat(seen.rounding).max_or_keep(speed);
        seen.crossed_at(L::splat(1.0) / speed, far)
    }
}

/// Never too small to divide by.
#[inline(always)]
fn in_single(rounding: f64) -> f32 {
    (rounding as f32).max(f32::MIN_POSITIVE)
}

impl Seen {
    #[inline(always)]
    fn is_behind(&self) -> bool {
        self.start < 0.0
    }

    /// Where rays cross the plane that come nearer at 1 over `reciprocal`.
    #[inline(always)]
    fn crossed_at<L: Lanes>(&self, reciprocal: L, far: L) -> CrossingLanes<L> {
        let distance = self.start.abs() as f32;
        let tau = L::splat(self.slack) + L::splat(self.rounding) * far;
        // Where the distance overflows, it must not hide that the plane is crossed.
        let at_least = L::splat(distance.min(f32::MAX));
        CrossingLanes {
            is_origin_behind: self.is_behind(),
            entry: (at_least - tau) * reciprocal,
            exit: (L::splat(distance) + tau) * reciprocal,
        }
    }
}

impl<L: Lanes> CrossingLanes<L> {
    /// The mask of the rays that come within tau of the plane inside the cell.
    #[inline(always)]
    pub(super) fn meets(&self, visit: &CellVisit<L>) -> u32 {
        let near = visit.near.max_or_keep(self.entry);
        let far = visit.far.min_or_keep(self.exit);
        near.le_mask(far)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crossing::HIT_ROUNDING;
    use crate::shared_slacks::SharedSlacks;
    use accel_core::simd::F32x4;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    /// A general plane, its slack 1, and rays that cross it or come near.
    struct Case {
        origin: Vec3,
        directions: [Vec3; 4],
        normal: Vec3,
        offset: f32,
        far: f32,
    }

    fn case(random: &mut Pcg64Mcg) -> Case {
        let mut any =
            |scale: f32| Vec3::from([0; 3].map(|_| random.random_range(-1.0..1.0_f32))) * scale;
        let (middle, along) = (any(4.0), any(1.0));
        let wiggle = [any(1e-3), any(1e-3), any(1e-6), any(0.0)];
        let normal = any(1.0);
        let foot = any(2.0);
        let origin = if random.random_bool(0.2) {
            foot
        } else {
            middle
        };
        let scale = 2.0_f32.powi(random.random_range(-8..22));
        let normal = normal * scale;
        // Some rays run along the plane.
        let along = if random.random_bool(0.3) {
            along.cross(normal) / scale
        } else {
            along
        };
        Case {
            origin,
            directions: wiggle.map(|wiggle| along + wiggle),
            normal,
            offset: normal.dot(foot),
            far: 2.0_f32.powi(random.random_range(-4..6)),
        }
    }

    /// By how much the rounding of a hit is more than the slack allows for at `t`:
    /// positive where only the origin's side, or only the other one, may hold it.
    fn beyond_tau(case: &Case, direction: Vec3, t: f32) -> [bool; 2] {
        let (normal, direction) = (case.normal.as_dvec3(), direction.as_dvec3());
        let start = normal.dot(case.origin.as_dvec3()) - f64::from(case.offset);
        let distance = (start + f64::from(t) * normal.dot(direction)) * start.signum();
        let off = f64::from(HIT_ROUNDING * t) * normal.abs().dot(direction.abs());
        [distance < -(1.0 + off), distance > 1.0 + off]
    }

    #[test]
    fn no_ray_leaves_a_side_before_its_hits_may_have() {
        let mut random = Pcg64Mcg::seed_from_u64(8);
        let [mut near_only, mut far_only] = [0; 2];
        for _ in 0..20_000 {
            let case = case(&mut random);
            let in_lanes =
                |axis: usize| F32x4::from_slice(&case.directions.map(|direction| direction[axis]));
            let plane = case.normal.extend(case.offset);
            let limits = PlaneLimits {
                general: plane.abs(),
                slacks: SharedSlacks::default(),
            };
            let rays = CommonOrigin::new(case.origin, [0, 1, 2].map(in_lanes), limits).unwrap();
            let crossing = rays.general(plane, F32x4::splat(case.far));
            for (lane, direction) in case.directions.into_iter().enumerate() {
                for step in 0..=16 {
                    let t = case.far * step as f32 / 16.0;
                    let [is_beyond, is_before] = beyond_tau(&case, direction, t);
                    // NaN constrains nothing.
                    let is_left = crossing.exit.lanes()[lane] < t;
                    let is_outside = crossing.entry.lanes()[lane] > t;
                    assert!(is_beyond || !is_left, "{t} {direction:?} {crossing:?}");
                    assert!(is_before || !is_outside, "{t} {direction:?} {crossing:?}");
                    near_only += usize::from(is_outside);
                    far_only += usize::from(is_left);
                }
            }
        }
        // And it is of use.
        assert!(
            near_only > 100_000 && far_only > 50_000,
            "{near_only} {far_only}"
        );
    }
}
