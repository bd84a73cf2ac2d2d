//! Interval arithmetic over the rays of a packet (Boulos, Wald and Shirley 2006,
//! *Geometric and arithmetic culling methods for entire ray packets*; Wald,
//! Boulos and Shirley 2007, section 4.3).

use glam::Vec3;

use crate::geometry::{Aabb, Axis};
use crate::ray::{Interval, PreparedRay, max_or_keep, min_or_keep};

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
    #[inline]
    pub(super) fn of(ray: &PreparedRay) -> Self {
        // Infinity, of a direction without a component here, times zero is NaN,
        // and so it stays: such an axis constrains nothing.
        let finite = |reciprocal: Vec3| reciprocal + reciprocal * 0.0;
        Self {
            near_origin: ray.origin(),
            far_origin: ray.origin(),
            near_reciprocal: [finite(ray.near_reciprocal()); 2],
            far_reciprocal: [finite(ray.far_reciprocal()); 2],
            t_min: ray.t_min(),
        }
    }

    #[inline]
    pub(super) fn add(&mut self, ray: &PreparedRay) {
        for axis in 0..3 {
            let reciprocal = ray.reciprocal()[axis];
            let is_negative = self.near_reciprocal[0][axis] < 0.0;
            if !reciprocal.is_finite() || is_negative != (reciprocal < 0.0) {
                for bounds in self
                    .near_reciprocal
                    .iter_mut()
                    .chain(&mut self.far_reciprocal)
                {
                    bounds[axis] = f32::NAN;
                }
            }
            let (near, far) = (ray.near_reciprocal()[axis], ray.far_reciprocal()[axis]);
            lower(&mut self.near_reciprocal[0][axis], near);
            raise(&mut self.near_reciprocal[1][axis], near);
            lower(&mut self.far_reciprocal[0][axis], far);
            raise(&mut self.far_reciprocal[1][axis], far);
            let origin = ray.origin()[axis];
            if is_negative {
                lower(&mut self.near_origin[axis], origin);
                raise(&mut self.far_origin[axis], origin);
            } else {
                raise(&mut self.near_origin[axis], origin);
                lower(&mut self.far_origin[axis], origin);
            }
        }
        lower(&mut self.t_min, ray.t_min());
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

// Both leave a bound that is NaN as it is.
#[inline]
fn lower(bound: &mut f32, value: f32) {
    *bound = min_or_keep(*bound, value);
}

#[inline]
fn raise(bound: &mut f32, value: f32) {
    *bound = max_or_keep(*bound, value);
}
