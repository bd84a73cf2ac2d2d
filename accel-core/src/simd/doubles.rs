//! Vectors of `f64`, for what single precision can't decide.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Sub};

/// A vector of `f64`, as many as the vector of `f32` that it belongs to has
/// lanes; otherwise as [`Lanes`](super::Lanes).
pub trait Doubles:
    Copy
    + Debug
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    /// How many lanes there are.
    const COUNT: usize;

    /// The same value in all lanes.
    fn splat(value: f64) -> Self;

    /// Set where `self <= other`; clear where either is NaN.
    fn le_mask(self, other: Self) -> u32;
}

/// Twice the lanes of `D`.
#[derive(Clone, Copy, Debug)]
pub struct PairOfDoubles<D>(pub(super) D, pub(super) D);

macro_rules! operator {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<D: Doubles> $trait for PairOfDoubles<D> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $operator other.0, self.1 $operator other.1)
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<D: Doubles> Doubles for PairOfDoubles<D> {
    const COUNT: usize = 2 * D::COUNT;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(D::splat(value), D::splat(value))
    }
    #[inline(always)]
    fn le_mask(self, other: Self) -> u32 {
        self.0.le_mask(other.0) | self.1.le_mask(other.1) << D::COUNT
    }
}

/// Two `f64`: a register of SSE2 on x86-64, an array elsewhere.
#[derive(Clone, Copy, Debug)]
pub struct F64x2(pub(super) register::Register);

macro_rules! operator_of_two {
    ($trait:ident, $method:ident) => {
        impl $trait for F64x2 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(register::$method(self.0, other.0))
            }
        }
    };
}

operator_of_two!(Add, add);
operator_of_two!(Sub, sub);
operator_of_two!(Mul, mul);
operator_of_two!(Div, div);

impl Doubles for F64x2 {
    const COUNT: usize = 2;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(register::splat(value))
    }
    #[inline(always)]
    fn le_mask(self, other: Self) -> u32 {
        register::le_mask(self.0, other.0)
    }
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
pub(super) mod register {
    use core::arch::x86_64 as sse;

    pub type Register = sse::__m128d;

    #[inline(always)]
    pub fn splat(value: f64) -> Register {
        // SAFETY: every x86-64 machine has SSE2; so in all functions here.
        unsafe { sse::_mm_set1_pd(value) }
    }
    #[inline(always)]
    pub fn add(a: Register, b: Register) -> Register {
        // SAFETY: as above.
        unsafe { sse::_mm_add_pd(a, b) }
    }
    #[inline(always)]
    pub fn sub(a: Register, b: Register) -> Register {
        // SAFETY: as above.
        unsafe { sse::_mm_sub_pd(a, b) }
    }
    #[inline(always)]
    pub fn mul(a: Register, b: Register) -> Register {
        // SAFETY: as above.
        unsafe { sse::_mm_mul_pd(a, b) }
    }
    #[inline(always)]
    pub fn div(a: Register, b: Register) -> Register {
        // SAFETY: as above.
        unsafe { sse::_mm_div_pd(a, b) }
    }
    #[inline(always)]
    pub fn le_mask(a: Register, b: Register) -> u32 {
        // SAFETY: as above.
        unsafe { sse::_mm_movemask_pd(sse::_mm_cmple_pd(a, b)) as u32 }
    }
}

#[cfg(not(target_arch = "x86_64"))]
pub(super) mod register {
    pub type Register = [f64; 2];

    #[inline(always)]
    pub fn splat(value: f64) -> Register {
        [value; 2]
    }
    #[inline(always)]
    pub fn add(a: Register, b: Register) -> Register {
        [a[0] + b[0], a[1] + b[1]]
    }
    #[inline(always)]
    pub fn sub(a: Register, b: Register) -> Register {
        [a[0] - b[0], a[1] - b[1]]
    }
    #[inline(always)]
    pub fn mul(a: Register, b: Register) -> Register {
        [a[0] * b[0], a[1] * b[1]]
    }
    #[inline(always)]
    pub fn div(a: Register, b: Register) -> Register {
        [a[0] / b[0], a[1] / b[1]]
    }
    #[inline(always)]
    pub fn le_mask(a: Register, b: Register) -> u32 {
        u32::from(a[0] <= b[0]) | u32::from(a[1] <= b[1]) << 1
    }
}
