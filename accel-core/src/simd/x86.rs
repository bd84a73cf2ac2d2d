//! Vectors of 8 and 16 lanes that some x86-64 machines have.
//!
//! These types are private to [`simd`](super): code meets them only as the
//! `Eight` and `Sixteen` of an instruction set that
//! [`SimdLevel::run`](super::SimdLevel::run) found on the machine.
#![allow(unsafe_code)]

use core::arch::x86_64 as intel;

use super::Lanes;

macro_rules! vector {
    ($name:ident, $vector:ty, $count:literal, $feature:literal,
     $splat:ident, $load:ident, $add:ident, $sub:ident, $mul:ident, $max:ident, $min:ident,
     |$a:ident, $b:ident| $le:expr, $lt:expr) => {
        #[doc = concat!("A register of ", $feature, ".")]
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        pub struct $name($vector);

        impl std::ops::Add for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                // SAFETY: the type is met only where the machine has the
                // instruction set; so in all functions here.
                Self(unsafe { intel::$add(self.0, other.0) })
            }
        }

        impl std::ops::Sub for $name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                // SAFETY: as above.
                Self(unsafe { intel::$sub(self.0, other.0) })
            }
        }

        impl std::ops::Mul for $name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                // SAFETY: as above.
                Self(unsafe { intel::$mul(self.0, other.0) })
            }
        }

        impl Lanes for $name {
            const COUNT: usize = $count;

            #[inline(always)]
            fn splat(value: f32) -> Self {
                // SAFETY: as above.
                Self(unsafe { intel::$splat(value) })
            }
            #[inline(always)]
            fn from_slice(values: &[f32]) -> Self {
                let values = &values[..$count];
                // SAFETY: as above, and the slice has that many numbers.
                Self(unsafe { intel::$load(values.as_ptr()) })
            }
            #[inline(always)]
            fn lanes(&self) -> &[f32] {
                // SAFETY: a register in memory is its lanes, side by side.
                unsafe { std::slice::from_raw_parts((&raw const *self).cast(), $count) }
            }
            #[inline(always)]
            fn lanes_mut(&mut self) -> &mut [f32] {
                // SAFETY: as above, and every bit pattern is a lane.
                unsafe { std::slice::from_raw_parts_mut((&raw mut *self).cast(), $count) }
            }
            // The instructions answer their second operand where either is NaN.
            #[inline(always)]
            fn max_or_keep(self, other: Self) -> Self {
                // SAFETY: as above.
                Self(unsafe { intel::$max(other.0, self.0) })
            }
            #[inline(always)]
            fn min_or_keep(self, other: Self) -> Self {
                // SAFETY: as above.
                Self(unsafe { intel::$min(other.0, self.0) })
            }
            #[inline(always)]
            fn le_mask(self, other: Self) -> u32 {
                let ($a, $b) = (self.0, other.0);
                // SAFETY: as above.
                unsafe { $le }
            }
            #[inline(always)]
            fn lt_mask(self, other: Self) -> u32 {
                let ($a, $b) = (self.0, other.0);
                // SAFETY: as above.
                unsafe { $lt }
            }
        }
    };
}

vector!(
    F32x8,
    intel::__m256,
    8,
    "AVX",
    _mm256_set1_ps,
    _mm256_loadu_ps,
    _mm256_add_ps,
    _mm256_sub_ps,
    _mm256_mul_ps,
    _mm256_max_ps,
    _mm256_min_ps,
    |a, b| intel::_mm256_movemask_ps(intel::_mm256_cmp_ps::<{ intel::_CMP_LE_OQ }>(a, b)) as u32,
    intel::_mm256_movemask_ps(intel::_mm256_cmp_ps::<{ intel::_CMP_LT_OQ }>(a, b)) as u32
);

vector!(
    F32x16,
    intel::__m512,
    16,
    "AVX-512",
    _mm512_set1_ps,
    _mm512_loadu_ps,
    _mm512_add_ps,
    _mm512_sub_ps,
    _mm512_mul_ps,
    _mm512_max_ps,
    _mm512_min_ps,
    |a, b| u32::from(intel::_mm512_cmp_ps_mask::<{ intel::_CMP_LE_OQ }>(a, b)),
    u32::from(intel::_mm512_cmp_ps_mask::<{ intel::_CMP_LT_OQ }>(a, b))
);
