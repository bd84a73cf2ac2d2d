//! Rays side by side.

use glam::Vec3;

use super::SharedFacts;
use crate::geometry::Aabb;
use crate::ray::PreparedRay;
use crate::ray::prepared::{FAR_PAD, NEAR_PAD};
use crate::simd::Lanes;

/// As many rays as a vector has lanes, by coordinate.
#[derive(Clone, Copy, Debug)]
pub struct RayLanes<L> {
    /// Where the rays start.
    pub origin: [L; 3],
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
    /// `ray` in every lane, not padded yet.
    #[inline(always)]
    pub(super) fn splat(ray: &PreparedRay) -> Self {
        let zero = L::splat(0.0);
        let mut lanes = Self {
            origin: [zero; 3],
            near_reciprocal: [zero; 3],
            far_reciprocal: [zero; 3],
            t_min: L::splat(ray.t_min()),
            shear: [L::splat(ray.shear().x), L::splat(ray.shear().y)],
            along: L::splat(ray.shear().along),
        };
        for axis in 0..3 {
            lanes.origin[axis] = L::splat(ray.origin()[axis]);
            lanes.near_reciprocal[axis] = L::splat(ray.reciprocal()[axis]);
        }
        lanes
    }

    /// Puts `ray` into `lane`, not padded yet.
    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, ray: &PreparedRay) {
        for axis in 0..3 {
            self.origin[axis].lanes_mut()[lane] = ray.origin()[axis];
            self.near_reciprocal[axis].lanes_mut()[lane] = ray.reciprocal()[axis];
        }
        self.t_min.lanes_mut()[lane] = ray.t_min();
        self.shear[0].lanes_mut()[lane] = ray.shear().x;
        self.shear[1].lanes_mut()[lane] = ray.shear().y;
        self.along.lanes_mut()[lane] = ray.shear().along;
    }

    /// Pads the reciprocals, as [`PreparedRay::new`] does.
    #[inline(always)]
    pub(super) fn pad(&mut self) {
        for axis in 0..3 {
            let reciprocal = self.near_reciprocal[axis];
            self.near_reciprocal[axis] = reciprocal * L::splat(NEAR_PAD);
            self.far_reciprocal[axis] = reciprocal * L::splat(FAR_PAD);
        }
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

    #[inline(always)]
    pub(super) fn all_have_signs_of(&self, ray: &PreparedRay) -> bool {
        let mut different = 0;
        for axis in 0..3 {
            let negative = self.near_reciprocal[axis].lt_mask(L::splat(0.0));
            let expected = if ray.reciprocal()[axis] < 0.0 {
                L::ALL
            } else {
                0
            };
            different |= negative ^ expected;
        }
        different == 0
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
        for axis in 0..3 {
            let entry = L::splat(plane(axis, signs[axis]));
            let exit = L::splat(plane(axis, !signs[axis]));
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
