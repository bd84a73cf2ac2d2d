//! Vectors of eight lanes that most x86-64 machines have.
//!
//! The type is private to [`simd`](super): code meets it only as the `Eight` of
//! an instruction set that
//! [`SimdLevel::run`](super::SimdLevel::run) found on the machine.
#![allow(unsafe_code)]

use core::arch::x86_64 as intel;

use super::Lanes;

/// A register of AVX.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct F32x8(intel::__m256);

impl std::ops::Add for F32x8 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: the type is met only where the machine has the
        // instruction set; so in all functions here.
        Self(unsafe { intel::_mm256_add_ps(self.0, other.0) })
    }
}

impl std::ops::Sub for F32x8 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { intel::_mm256_sub_ps(self.0, other.0) })
    }
}

impl std::ops::Mul for F32x8 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { intel::_mm256_mul_ps(self.0, other.0) })
    }
}

impl Lanes for F32x8 {
    const COUNT: usize = 8;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        // SAFETY: as above.
        Self(unsafe { intel::_mm256_set1_ps(value) })
    }
    #[inline(always)]
    fn from_slice(values: &[f32]) -> Self {
        let values = &values[..8];
        // SAFETY: as above, and the slice has that many numbers.
        Self(unsafe { intel::_mm256_loadu_ps(values.as_ptr()) })
    }
    #[inline(always)]
    fn lanes(&self) -> &[f32] {
        // SAFETY: a register in memory is its lanes, side by side.
        unsafe { std::slice::from_raw_parts((&raw const *self).cast(), 8) }
    }
    #[inline(always)]
    fn lanes_mut(&mut self) -> &mut [f32] {
        // SAFETY: as above, and every bit pattern is a lane.
        unsafe { std::slice::from_raw_parts_mut((&raw mut *self).cast(), 8) }
    }
    // The instructions answer their second operand where either is NaN.
    #[inline(always)]
    fn max_or_keep(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { intel::_mm256_max_ps(other.0, self.0) })
    }
    #[inline(always)]
    fn min_or_keep(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { intel::_mm256_min_ps(other.0, self.0) })
    }
    #[inline(always)]
    fn le_mask(self, other: Self) -> u32 {
        // SAFETY: as above.
        let kept = unsafe { intel::_mm256_cmp_ps::<{ intel::_CMP_LE_OQ }>(self.0, other.0) };
        // SAFETY: as above.
        unsafe { intel::_mm256_movemask_ps(kept) as u32 }
    }
    #[inline(always)]
    fn lt_mask(self, other: Self) -> u32 {
        // SAFETY: as above.
        let kept = unsafe { intel::_mm256_cmp_ps::<{ intel::_CMP_LT_OQ }>(self.0, other.0) };
        // SAFETY: as above.
        unsafe { intel::_mm256_movemask_ps(kept) as u32 }
    }
}
