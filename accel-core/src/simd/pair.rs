//! A vector made of two.

use std::ops::{Add, Div, Mul, Sub};

use super::{Lanes, PairOfDoubles};

/// Twice the lanes of `L`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Pair<L>(L, L);

impl<L: Lanes> Add for Pair<L> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl<L: Lanes> Sub for Pair<L> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }
}

impl<L: Lanes> Mul for Pair<L> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0, self.1 * other.1)
    }
}

impl<L: Lanes> Div for Pair<L> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0, self.1 / other.1)
    }
}

#[allow(unsafe_code)]
impl<L: Lanes> Lanes for Pair<L> {
    const COUNT: usize = 2 * L::COUNT;

    type Doubles = PairOfDoubles<L::Doubles>;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self(L::splat(value), L::splat(value))
    }
    #[inline(always)]
    fn from_slice(values: &[f32]) -> Self {
        let (low, high) = values.split_at(L::COUNT);
        Self(L::from_slice(low), L::from_slice(high))
    }
    #[inline(always)]
    fn lanes(&self) -> &[f32] {
        debug_assert_eq!(size_of::<Self>(), Self::COUNT * size_of::<f32>());
        // SAFETY: both halves are nothing but their lanes, side by side.
        unsafe { std::slice::from_raw_parts((&raw const *self).cast(), Self::COUNT) }
    }
    #[inline(always)]
    fn lanes_mut(&mut self) -> &mut [f32] {
        debug_assert_eq!(size_of::<Self>(), Self::COUNT * size_of::<f32>());
        // SAFETY: as above, and every bit pattern is a lane.
        unsafe { std::slice::from_raw_parts_mut((&raw mut *self).cast(), Self::COUNT) }
    }
    #[inline(always)]
    fn max_or_keep(self, other: Self) -> Self {
        Self(self.0.max_or_keep(other.0), self.1.max_or_keep(other.1))
    }
    #[inline(always)]
    fn min_or_keep(self, other: Self) -> Self {
        Self(self.0.min_or_keep(other.0), self.1.min_or_keep(other.1))
    }
    #[inline(always)]
    fn le_mask(self, other: Self) -> u32 {
        self.0.le_mask(other.0) | self.1.le_mask(other.1) << L::COUNT
    }
    #[inline(always)]
    fn lt_mask(self, other: Self) -> u32 {
        self.0.lt_mask(other.0) | self.1.lt_mask(other.1) << L::COUNT
    }
    #[inline(always)]
    fn to_doubles(self) -> Self::Doubles {
        PairOfDoubles(self.0.to_doubles(), self.1.to_doubles())
    }
    #[inline(always)]
    fn from_doubles(doubles: Self::Doubles) -> Self {
        Self(L::from_doubles(doubles.0), L::from_doubles(doubles.1))
    }
}
