//! Vectors of eight lanes that most x86-64 machines have.
//!
//! The type is private to [`simd`](super): code meets it only as the `Eight` of
//! an instruction set that
//! [`SimdLevel::run`](super::SimdLevel::run) found on the machine.
#![allow(unsafe_code)]

use core::arch::x86_64 as intel;

use super::{Doubles, Lanes, PairOfDoubles};

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

impl std::ops::Div for F32x8 {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { intel::_mm256_div_ps(self.0, other.0) })
    }
}

impl Lanes for F32x8 {
    const COUNT: usize = 8;

    type Doubles = PairOfDoubles<F64x4>;

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
    fn from_fn(number: impl Fn(usize) -> f32) -> Self {
        let (a, b, c, d) = (number(0), number(1), number(2), number(3));
        let (e, f, g, h) = (number(4), number(5), number(6), number(7));
        // SAFETY: as above.
        Self(unsafe { intel::_mm256_setr_ps(a, b, c, d, e, f, g, h) })
    }
    #[inline(always)]
    fn from_bits(words: &[u32]) -> Self {
        let words = &words[..8];
        // SAFETY: as above, and the slice has that many words.
        Self(unsafe { intel::_mm256_loadu_ps(words.as_ptr().cast()) })
    }
    #[inline(always)]
    fn pick(table: &[f32; 8], indices: u64) -> Self {
        // SAFETY: as above, and the table has eight numbers. The instruction looks
        // only at the three lowest bits of each index.
        Self(unsafe {
            let shifts = intel::_mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21);
            let indices =
                intel::_mm256_srlv_epi32(intel::_mm256_set1_epi32(indices as i32), shifts);
            intel::_mm256_permutevar8x32_ps(intel::_mm256_loadu_ps(table.as_ptr()), indices)
        })
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
    #[inline(always)]
    fn to_doubles(self) -> Self::Doubles {
        // SAFETY: as above.
        let (low, high) = unsafe {
            (
                intel::_mm256_cvtps_pd(intel::_mm256_castps256_ps128(self.0)),
                intel::_mm256_cvtps_pd(intel::_mm256_extractf128_ps::<1>(self.0)),
            )
        };
        PairOfDoubles(F64x4(low), F64x4(high))
    }
    #[inline(always)]
    fn from_doubles(doubles: Self::Doubles) -> Self {
        let PairOfDoubles(F64x4(low), F64x4(high)) = doubles;
        // SAFETY: as above.
        Self(unsafe {
            intel::_mm256_set_m128(intel::_mm256_cvtpd_ps(high), intel::_mm256_cvtpd_ps(low))
        })
    }
}

/// Four `f64` in a register of AVX.
#[derive(Clone, Copy, Debug)]
pub struct F64x4(intel::__m256d);

impl std::ops::Add for F64x4 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { intel::_mm256_add_pd(self.0, other.0) })
    }
}

impl std::ops::Sub for F64x4 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { intel::_mm256_sub_pd(self.0, other.0) })
    }
}

impl std::ops::Mul for F64x4 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { intel::_mm256_mul_pd(self.0, other.0) })
    }
}

impl std::ops::Div for F64x4 {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { intel::_mm256_div_pd(self.0, other.0) })
    }
}

impl Doubles for F64x4 {
    const COUNT: usize = 4;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: as above.
        Self(unsafe { intel::_mm256_set1_pd(value) })
    }
    #[inline(always)]
    fn le_mask(self, other: Self) -> u32 {
        // SAFETY: as above.
        let kept = unsafe { intel::_mm256_cmp_pd::<{ intel::_CMP_LE_OQ }>(self.0, other.0) };
        // SAFETY: as above.
        unsafe { intel::_mm256_movemask_pd(kept) as u32 }
    }
}
