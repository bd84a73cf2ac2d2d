//! Interval arithmetic over the rays of a packet (Boulos, Wald and Shirley 2006,
//! *Geometric and arithmetic culling methods for entire ray packets*; Wald,
//! Boulos and Shirley 2007, section 4.3).

use glam::Vec3;

use crate::geometry::{Aabb, Axis};
use crate::ray::packet::RayLanes;
use crate::ray::{Interval, max_or_keep, min_or_keep};
use crate::simd::Lanes;

/// Bounds of all rays of a packet: their slab test is passed by every box that
/// any of the rays meets.
///
/// On an axis along which the directions have different signs, or one has no
/// finite reciprocal, the reciprocals are NaN: it constrains nothing.
#[derive(Clone, Copy, Debug)]
pub struct PacketBounds {
    /// By axis, the origin from which entry planes come soonest.
    pub near_origin: Vec3,
    /// By axis, the origin from which exit planes come last.
    pub far_origin: Vec3,
    /// The smallest and the largest reciprocals to compute entries with.
    pub near_reciprocal: [Vec3; 2],
    /// The smallest and the largest reciprocals to compute exits with.
    pub far_reciprocal: [Vec3; 2],
    /// The smallest `t_min`.
    pub t_min: f32,
}

impl PacketBounds {
    #[inline(always)]
    pub(super) fn of<L: Lanes>(rays: &[RayLanes<L>]) -> Self {
        let mut bounds = Self {
            near_origin: Vec3::ZERO,
            far_origin: Vec3::ZERO,
            near_reciprocal: [Vec3::NAN; 2],
            far_reciprocal: [Vec3::NAN; 2],
            t_min: Range::of(rays, |lanes| lanes.t_min).low,
        };
        for axis in 0..3 {
            let near = Range::of(rays, |lanes| lanes.near_reciprocal[axis]);
            let origin = Range::of(rays, |lanes| lanes.origin[axis]);
            let is_negative = near.high < 0.0;
            (bounds.near_origin[axis], bounds.far_origin[axis]) = if is_negative {
                (origin.low, origin.high)
            } else {
                (origin.high, origin.low)
            };
            let have_one_sign = is_negative || near.low > 0.0;
            if near.is_finite && have_one_sign {
                let far = Range::of(rays, |lanes| lanes.far_reciprocal[axis]);
                bounds.near_reciprocal[0][axis] = near.low;
                bounds.near_reciprocal[1][axis] = near.high;
                bounds.far_reciprocal[0][axis] = far.low;
                bounds.far_reciprocal[1][axis] = far.high;
            }
        }
        bounds
    }

    /// The interval that contains those of all rays: if it is empty, no ray
    /// meets the box. Rounding is monotone, so this holds for the intervals as
    /// computed.
    #[inline]
    pub fn slab(&self, bounds: &Aabb) -> Interval {
        let mut interval = Interval {
            near: self.t_min,
            far: f32::INFINITY,
        };
        for axis in Axis::ALL {
            let (low, high) = (axis.of(bounds.min), axis.of(bounds.max));
            let is_negative = axis.of(self.near_reciprocal[0]) < 0.0;
            let (entry, exit) = if is_negative {
                (high, low)
            } else {
                (low, high)
            };
            let entry = entry - axis.of(self.near_origin);
            let exit = exit - axis.of(self.far_origin);
            let near = self.near_reciprocal.map(|r| entry * axis.of(r));
            let far = self.far_reciprocal.map(|r| exit * axis.of(r));
            interval.near = max_or_keep(interval.near, min_or_keep(near[0], near[1]));
            interval.far = min_or_keep(interval.far, max_or_keep(far[0], far[1]));
        }
        interval
    }
}

/// The smallest and the largest of a number of each ray.
struct Range {
    low: f32,
    high: f32,
    is_finite: bool,
}

impl Range {
    #[inline(always)]
    fn of<L: Lanes>(rays: &[RayLanes<L>], number: impl Fn(&RayLanes<L>) -> L) -> Self {
        let infinity = L::splat(f32::INFINITY);
        let (mut low, mut high) = (infinity, L::splat(f32::NEG_INFINITY));
        let mut finite = L::ALL;
        for lanes in rays {
            let number = number(lanes);
            finite &= number.lt_mask(infinity) & L::splat(f32::NEG_INFINITY).lt_mask(number);
            low = low.min_or_keep(number);
            high = high.max_or_keep(number);
        }
        Self {
            low: low.lanes().iter().copied().fold(f32::INFINITY, min_or_keep),
            high: high
                .lanes()
                .iter()
                .copied()
                .fold(f32::NEG_INFINITY, max_or_keep),
            is_finite: finite == L::ALL,
        }
    }
}
