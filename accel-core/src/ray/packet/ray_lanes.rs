//! Rays side by side.

use glam::Vec3;

use super::{PacketRay, SharedFacts};
use crate::geometry::{Aabb, Axis};
use crate::ray::PreparedRay;
use crate::ray::prepared::{FAR_PAD, LARGEST_RECIPROCAL, NEAR_PAD, SMALLEST_RATIO};
use crate::simd::Lanes;

/// As many rays as a vector has lanes, by coordinate.
#[derive(Clone, Copy, Debug)]
pub struct RayLanes<L> {
    /// Where the rays start.
    pub origin: [L; 3],
    /// Where they go.
    pub direction: [L; 3],
    /// See [`PreparedRay::near_reciprocal`].
    pub near_reciprocal: [L; 3],
    /// See [`PreparedRay::far_reciprocal`].
    pub far_reciprocal: [L; 3],
    /// The smallest `t` of interest.
    pub t_min: L,
    pub(crate) shear: [L; 2],
    pub(crate) along: L,
}

impl<L: Lanes> RayLanes<L> {
    /// Makes the rays from `first` on ready as [`PreparedRay::new`] does, all at
    /// once; lanes without a ray hold the last one. Right only for the lanes of the
    /// mask: rays that can hit something, have a usable reciprocal on every axis,
    /// and are longest along `main`.
    #[inline(always)]
    pub(super) fn prepare(rays: &[PacketRay], first: usize, main: Axis) -> (Self, u32) {
        let last = rays.len() - 1;
        let ray = |lane: usize| rays[last.min(first + lane)].segment();
        let origin = [
            L::from_fn(|lane| ray(lane).origin.x),
            L::from_fn(|lane| ray(lane).origin.y),
            L::from_fn(|lane| ray(lane).origin.z),
        ];
        let [x, y, z] = [
            L::from_fn(|lane| ray(lane).direction.x),
            L::from_fn(|lane| ray(lane).direction.y),
            L::from_fn(|lane| ray(lane).direction.z),
        ];
        let t_max = L::from_fn(|lane| ray(lane).t_max);
        let given_t_min = L::from_fn(|lane| ray(lane).t_min);
        let t_min = L::splat(0.0).max_or_keep(given_t_min);
        let mut ready = finite_mask(origin) & finite_mask([x, y, z]);
        ready &= given_t_min.lt_mask(L::splat(f32::INFINITY)) & t_min.le_mask(t_max);
        ready &= longest_mask([x, y, z], main);

        let one = L::splat(1.0);
        let reciprocal = [one / x, one / y, one / z];
        let (smallest, largest) = (L::splat(f32::MIN_POSITIVE), L::splat(LARGEST_RECIPROCAL));
        let (near_pad, far_pad) = (L::splat(NEAR_PAD), L::splat(FAR_PAD));
        let direction = [x, y, z];
        let smallest_component = magnitude(direction[main.index()]) * L::splat(SMALLEST_RATIO);
        let (mut near_reciprocal, mut far_reciprocal) = (reciprocal, reciprocal);
        for axis in 0..3 {
            let of_reciprocal = magnitude(reciprocal[axis]);
            ready &= smallest.le_mask(of_reciprocal) & of_reciprocal.le_mask(largest);
            ready &= smallest_component.le_mask(magnitude(direction[axis]));
            near_reciprocal[axis] = reciprocal[axis] * near_pad;
            far_reciprocal[axis] = reciprocal[axis] * far_pad;
        }
        let [sideways, upward, along] = match main {
            Axis::X => [y, z, x],
            Axis::Y => [z, x, y],
            Axis::Z => [x, y, z],
        };
        let lanes = Self {
            origin,
            direction,
            near_reciprocal,
            far_reciprocal,
            t_min,
            shear: [sideways / along, upward / along],
            along,
        };
        (lanes, ready)
    }

    /// Puts `ray` into `lane`.
    pub(super) fn set(&mut self, lane: usize, ray: &PreparedRay) {
        for axis in 0..3 {
            self.origin[axis].lanes_mut()[lane] = ray.origin()[axis];
            self.direction[axis].lanes_mut()[lane] = ray.direction()[axis];
            self.near_reciprocal[axis].lanes_mut()[lane] = ray.near_reciprocal()[axis];
            self.far_reciprocal[axis].lanes_mut()[lane] = ray.far_reciprocal()[axis];
        }
        self.t_min.lanes_mut()[lane] = ray.t_min();
        self.shear[0].lanes_mut()[lane] = ray.shear().x;
        self.shear[1].lanes_mut()[lane] = ray.shear().y;
        self.along.lanes_mut()[lane] = ray.shear().along;
    }

    #[inline(always)]
    pub(super) fn all_start_at(&self, origin: Vec3) -> bool {
        let mut mask = L::ALL;
        for axis in 0..3 {
            let start = L::splat(origin[axis]);
            mask &= start.le_mask(self.origin[axis]) & self.origin[axis].le_mask(start);
        }
        mask == L::ALL
    }

    /// The slab test where all directions have these `signs`: each axis' entry
    /// and exit plane is known beforehand.
    #[inline(always)]
    pub(super) fn slab_by_sign(
        &self,
        signs: &[bool; 3],
        t_max: L,
        plane: impl Fn(usize, bool) -> f32,
    ) -> (L, L) {
        let (mut near, mut far) = (self.t_min, t_max);
        for (axis, &is_negative) in signs.iter().enumerate() {
            let entry = L::splat(plane(axis, is_negative));
            let exit = L::splat(plane(axis, !is_negative));
            near = near.max_or_keep((entry - self.origin[axis]) * self.near_reciprocal[axis]);
            far = far.min_or_keep((exit - self.origin[axis]) * self.far_reciprocal[axis]);
        }
        (near, far)
    }

    /// Where the whole lines enter and leave a box: [`PreparedRay::slab`].
    #[inline(always)]
    pub(crate) fn whole_slab(&self, shared: &SharedFacts, bounds: &Aabb) -> (L, L) {
        let whole = Self {
            t_min: L::splat(f32::NEG_INFINITY),
            ..*self
        };
        let end = L::splat(f32::INFINITY);
        let plane = |axis: usize, high| {
            if high {
                bounds.max[axis]
            } else {
                bounds.min[axis]
            }
        };
        match &shared.signs {
            Some(signs) => whole.slab_by_sign(signs, end, plane),
            None => whole.slab(end, plane),
        }
    }

    /// The slab test for directions of any signs: the nearer plane of an axis is
    /// the one with the smaller product. Where the low plane's product is NaN
    /// (zero times infinity, of a direction that counts as positive) it stays
    /// NaN and constrains nothing, as in [`PreparedRay::slab`].
    #[inline(always)]
    pub(super) fn slab(&self, t_max: L, plane: impl Fn(usize, bool) -> f32) -> (L, L) {
        let (mut near, mut far) = (self.t_min, t_max);
        for axis in 0..3 {
            let low = L::splat(plane(axis, false)) - self.origin[axis];
            let high = L::splat(plane(axis, true)) - self.origin[axis];
            let (near_reciprocal, far_reciprocal) =
                (self.near_reciprocal[axis], self.far_reciprocal[axis]);
            let entry = (low * near_reciprocal).min_or_keep(high * near_reciprocal);
            let exit = (high * far_reciprocal).max_or_keep(low * far_reciprocal);
            near = near.max_or_keep(entry);
            far = far.min_or_keep(exit);
        }
        (near, far)
    }
}

/// The lanes in which all three numbers are finite: a number times zero is zero
/// or NaN.
#[inline(always)]
fn finite_mask<L: Lanes>([x, y, z]: [L; 3]) -> u32 {
    let zero = L::splat(0.0);
    (x * zero + y * zero + z * zero).le_mask(zero)
}

/// The lanes in which [`Axis::largest`] of the vectors is `axis`.
#[inline(always)]
fn longest_mask<L: Lanes>([x, y, z]: [L; 3], axis: Axis) -> u32 {
    let (x, y, z) = (magnitude(x), magnitude(y), magnitude(z));
    let is_x = y.le_mask(x) & z.le_mask(x);
    let is_y = !is_x & z.le_mask(y);
    match axis {
        Axis::X => is_x,
        Axis::Y => is_y,
        Axis::Z => !(is_x | is_y),
    }
}

#[inline(always)]
fn magnitude<L: Lanes>(number: L) -> L {
    number.max_or_keep(L::splat(0.0) - number)
}
