//! Four floats at once.
//!
//! On x86-64 these are SSE2 registers, which every such machine has, so a
//! default build uses them without any detection. Elsewhere they are arrays,
//! with the same results bit for bit.

use glam::{Vec3, Vec4};

use super::doubles::F64x2;
use super::{Lanes, PairOfDoubles};
use crate::ray::{max_or_keep, min_or_keep};

/// Four `f32`. Operations are lane by lane, in IEEE single precision.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct F32x4(lanes::Lanes);

impl F32x4 {
    /// The lanes in order.
    #[inline(always)]
    pub fn new(a: f32, b: f32, c: f32, d: f32) -> Self {
        Self(lanes::new(a, b, c, d))
    }

    /// The same value in all lanes.
    #[inline(always)]
    pub fn splat(value: f32) -> Self {
        Self::new(value, value, value, value)
    }

    /// The axes of `v`, and `last`.
    #[inline(always)]
    pub fn of_axes(v: Vec3, last: f32) -> Self {
        Self::new(v.x, v.y, v.z, last)
    }

    /// The first three lanes.
    #[inline(always)]
    pub fn axes(self) -> Vec3 {
        let [x, y, z, _] = self.to_array();
        Vec3::new(x, y, z)
    }

    /// Lane by lane the larger; the lane of `self` where `other` is NaN.
    #[inline(always)]
    #[must_use]
    pub fn max_or_keep(self, other: Self) -> Self {
        Self(lanes::max_or_keep(self.0, other.0))
    }

    /// Lane by lane the smaller; the lane of `self` where `other` is NaN.
    #[inline(always)]
    #[must_use]
    pub fn min_or_keep(self, other: Self) -> Self {
        Self(lanes::min_or_keep(self.0, other.0))
    }

    /// Lane by lane without its sign.
    #[inline(always)]
    #[must_use]
    pub fn abs(self) -> Self {
        Self(lanes::abs(self.0))
    }

    /// Whether no lane is infinite or NaN.
    #[inline(always)]
    pub fn is_finite(self) -> bool {
        let zero = Self::splat(0.0);
        (self * zero).le_mask(zero) == Self::ALL
    }

    /// The largest lane, none of them NaN.
    #[inline(always)]
    pub fn largest(self) -> f32 {
        let [first, second] = self.max_or_keep(self.high()).first_two();
        max_or_keep(first, second)
    }

    /// The smallest lane, none of them NaN.
    #[inline(always)]
    pub fn smallest(self) -> f32 {
        let [first, second] = self.min_or_keep(self.high()).first_two();
        min_or_keep(first, second)
    }

    /// The last two lanes, followed by themselves again.
    #[inline(always)]
    #[must_use]
    pub fn high(self) -> Self {
        Self(lanes::high(self.0))
    }

    /// This and `other`, the lanes of both exchanged where `sign` has its sign bit.
    #[inline(always)]
    pub fn exchanged_where_negative(self, other: Self, sign: Self) -> [Self; 2] {
        lanes::exchanged_where_negative(self.0, other.0, sign.0).map(Self)
    }

    /// A bit per lane, the first lane lowest: set where `self <= other`.
    #[inline(always)]
    pub fn le_mask(self, other: Self) -> u32 {
        lanes::le_mask(self.0, other.0)
    }

    /// The lanes in order.
    #[inline(always)]
    pub fn to_array(self) -> [f32; 4] {
        lanes::to_array(self.0)
    }

    /// The first two lanes.
    #[inline(always)]
    pub fn first_two(self) -> [f32; 2] {
        lanes::first_two(self.0)
    }
}

#[allow(unsafe_code)]
impl Lanes for F32x4 {
    const COUNT: usize = 4;

    type Doubles = PairOfDoubles<F64x2>;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self::splat(value)
    }
    #[inline(always)]
    fn from_slice(values: &[f32]) -> Self {
        let values = &values[..4];
        Self::new(values[0], values[1], values[2], values[3])
    }
    #[inline(always)]
    fn from_fn(number: impl Fn(usize) -> f32) -> Self {
        Self::new(number(0), number(1), number(2), number(3))
    }
    #[inline(always)]
    fn lanes(&self) -> &[f32] {
        // SAFETY: a vector in memory is its lanes, side by side.
        unsafe { std::slice::from_raw_parts((&raw const *self).cast(), 4) }
    }
    #[inline(always)]
    fn lanes_mut(&mut self) -> &mut [f32] {
        // SAFETY: as above, and every bit pattern is a lane.
        unsafe { std::slice::from_raw_parts_mut((&raw mut *self).cast(), 4) }
    }
    #[inline(always)]
    fn max_or_keep(self, other: Self) -> Self {
        self.max_or_keep(other)
    }
    #[inline(always)]
    fn min_or_keep(self, other: Self) -> Self {
        self.min_or_keep(other)
    }
    #[inline(always)]
    fn le_mask(self, other: Self) -> u32 {
        self.le_mask(other)
    }
    #[inline(always)]
    fn lt_mask(self, other: Self) -> u32 {
        lanes::lt_mask(self.0, other.0)
    }
    #[inline(always)]
    fn to_doubles(self) -> Self::Doubles {
        let [low, high] = lanes::to_doubles(self.0);
        PairOfDoubles(F64x2(low), F64x2(high))
    }
    #[inline(always)]
    fn from_doubles(doubles: Self::Doubles) -> Self {
        Self(lanes::from_doubles(doubles.0.0, doubles.1.0))
    }
}

impl From<Vec4> for F32x4 {
    #[inline(always)]
    fn from(lanes: Vec4) -> Self {
        Self::new(lanes.x, lanes.y, lanes.z, lanes.w)
    }
}

impl From<F32x4> for Vec4 {
    #[inline(always)]
    fn from(lanes: F32x4) -> Self {
        Self::from_array(lanes.to_array())
    }
}

impl std::ops::Add for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(lanes::add(self.0, other.0))
    }
}

impl std::ops::Sub for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(lanes::sub(self.0, other.0))
    }
}

impl std::ops::Mul for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(lanes::mul(self.0, other.0))
    }
}

impl std::ops::Div for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(lanes::div(self.0, other.0))
    }
}

// Arrays instead made traversal of a binary BVH 1.1 to 1.2 times slower and its
// builds 1.1 times: the compiler turns the NaN rule into comparisons and masks.
#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
mod lanes {
    use core::arch::x86_64 as sse;

    use super::super::doubles::register::Register;

    pub type Lanes = sse::__m128;

    #[inline(always)]
    pub fn new(a: f32, b: f32, c: f32, d: f32) -> Lanes {
        // SAFETY: every x86-64 machine has SSE2; so in all functions here.
        unsafe { sse::_mm_setr_ps(a, b, c, d) }
    }
    #[inline(always)]
    pub fn add(a: Lanes, b: Lanes) -> Lanes {
        // SAFETY: as above.
        unsafe { sse::_mm_add_ps(a, b) }
    }
    #[inline(always)]
    pub fn sub(a: Lanes, b: Lanes) -> Lanes {
        // SAFETY: as above.
        unsafe { sse::_mm_sub_ps(a, b) }
    }
    #[inline(always)]
    pub fn mul(a: Lanes, b: Lanes) -> Lanes {
        // SAFETY: as above.
        unsafe { sse::_mm_mul_ps(a, b) }
    }
    #[inline(always)]
    pub fn div(a: Lanes, b: Lanes) -> Lanes {
        // SAFETY: as above.
        unsafe { sse::_mm_div_ps(a, b) }
    }
    // The instructions answer their second operand where either is NaN.
    #[inline(always)]
    pub fn max_or_keep(a: Lanes, b: Lanes) -> Lanes {
        // SAFETY: as above.
        unsafe { sse::_mm_max_ps(b, a) }
    }
    #[inline(always)]
    pub fn min_or_keep(a: Lanes, b: Lanes) -> Lanes {
        // SAFETY: as above.
        unsafe { sse::_mm_min_ps(b, a) }
    }
    #[inline(always)]
    pub fn abs(a: Lanes) -> Lanes {
        // SAFETY: as above.
        unsafe { sse::_mm_andnot_ps(sse::_mm_set1_ps(-0.0), a) }
    }
    #[inline(always)]
    pub fn high(a: Lanes) -> Lanes {
        // SAFETY: as above.
        unsafe { sse::_mm_movehl_ps(a, a) }
    }
    #[inline(always)]
    pub fn exchanged_where_negative(a: Lanes, b: Lanes, sign: Lanes) -> [Lanes; 2] {
        // SAFETY: as above.
        unsafe {
            let all_bits = sse::_mm_srai_epi32::<31>(sse::_mm_castps_si128(sign));
            let differing = sse::_mm_and_ps(sse::_mm_xor_ps(a, b), sse::_mm_castsi128_ps(all_bits));
            [sse::_mm_xor_ps(a, differing), sse::_mm_xor_ps(b, differing)]
        }
    }
    #[inline(always)]
    pub fn le_mask(a: Lanes, b: Lanes) -> u32 {
        // SAFETY: as above.
        unsafe { sse::_mm_movemask_ps(sse::_mm_cmple_ps(a, b)) as u32 }
    }
    #[inline(always)]
    pub fn lt_mask(a: Lanes, b: Lanes) -> u32 {
        // SAFETY: as above.
        unsafe { sse::_mm_movemask_ps(sse::_mm_cmplt_ps(a, b)) as u32 }
    }
    #[inline(always)]
    pub fn to_doubles(a: Lanes) -> [Register; 2] {
        // SAFETY: as above.
        unsafe {
            [
                sse::_mm_cvtps_pd(a),
                sse::_mm_cvtps_pd(sse::_mm_movehl_ps(a, a)),
            ]
        }
    }
    #[inline(always)]
    pub fn from_doubles(low: Register, high: Register) -> Lanes {
        // SAFETY: as above.
        unsafe { sse::_mm_movelh_ps(sse::_mm_cvtpd_ps(low), sse::_mm_cvtpd_ps(high)) }
    }
    #[inline(always)]
    pub fn to_array(a: Lanes) -> [f32; 4] {
        let mut array = [0.0; 4];
        // SAFETY: as above, and the array has room for four lanes.
        unsafe { sse::_mm_storeu_ps(array.as_mut_ptr(), a) };
        array
    }
    #[inline(always)]
    pub fn first_two(a: Lanes) -> [f32; 2] {
        // SAFETY: as above.
        let second = unsafe { sse::_mm_shuffle_ps::<0b01_01_01_01>(a, a) };
        // SAFETY: as above.
        unsafe { [sse::_mm_cvtss_f32(a), sse::_mm_cvtss_f32(second)] }
    }
}

#[cfg(not(target_arch = "x86_64"))]
mod lanes {
    use super::super::doubles::register::Register;
    use crate::ray;

    pub type Lanes = [f32; 4];

    #[inline(always)]
    fn zip(a: Lanes, b: Lanes, f: impl Fn(f32, f32) -> f32) -> Lanes {
        [f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3])]
    }
    #[inline(always)]
    pub fn new(a: f32, b: f32, c: f32, d: f32) -> Lanes {
        [a, b, c, d]
    }
    #[inline(always)]
    pub fn add(a: Lanes, b: Lanes) -> Lanes {
        zip(a, b, |a, b| a + b)
    }
    #[inline(always)]
    pub fn sub(a: Lanes, b: Lanes) -> Lanes {
        zip(a, b, |a, b| a - b)
    }
    #[inline(always)]
    pub fn mul(a: Lanes, b: Lanes) -> Lanes {
        zip(a, b, |a, b| a * b)
    }
    #[inline(always)]
    pub fn div(a: Lanes, b: Lanes) -> Lanes {
        zip(a, b, |a, b| a / b)
    }
    #[inline(always)]
    pub fn max_or_keep(a: Lanes, b: Lanes) -> Lanes {
        zip(a, b, ray::max_or_keep)
    }
    #[inline(always)]
    pub fn min_or_keep(a: Lanes, b: Lanes) -> Lanes {
        zip(a, b, ray::min_or_keep)
    }
    #[inline(always)]
    pub fn abs(a: Lanes) -> Lanes {
        a.map(f32::abs)
    }
    #[inline(always)]
    pub fn high(a: Lanes) -> Lanes {
        [a[2], a[3], a[2], a[3]]
    }
    #[inline(always)]
    pub fn exchanged_where_negative(a: Lanes, b: Lanes, sign: Lanes) -> [Lanes; 2] {
        let (mut first, mut second) = (a, b);
        for lane in 0..4 {
            if sign[lane].is_sign_negative() {
                (first[lane], second[lane]) = (b[lane], a[lane]);
            }
        }
        [first, second]
    }
    #[inline(always)]
    pub fn le_mask(a: Lanes, b: Lanes) -> u32 {
        (0..4)
            .map(|lane| u32::from(a[lane] <= b[lane]) << lane)
            .sum()
    }
    #[inline(always)]
    pub fn lt_mask(a: Lanes, b: Lanes) -> u32 {
        (0..4)
            .map(|lane| u32::from(a[lane] < b[lane]) << lane)
            .sum()
    }
    #[inline(always)]
    pub fn to_doubles(a: Lanes) -> [Register; 2] {
        let a = a.map(f64::from);
        [[a[0], a[1]], [a[2], a[3]]]
    }
    #[inline(always)]
    pub fn from_doubles(low: Register, high: Register) -> Lanes {
        [low[0] as f32, low[1] as f32, high[0] as f32, high[1] as f32]
    }
    #[inline(always)]
    pub fn to_array(a: Lanes) -> [f32; 4] {
        a
    }
    #[inline(always)]
    pub fn first_two(a: Lanes) -> [f32; 2] {
        [a[0], a[1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ray::{max_or_keep, min_or_keep};

    #[test]
    fn lanes_agree_with_scalars_on_special_values() {
        let values = [
            0.0,
            -0.0,
            1.5,
            -2.0,
            f32::INFINITY,
            f32::NEG_INFINITY,
            f32::NAN,
            1e-45,
        ];
        let bits = |pair: [f32; 2]| pair.map(f32::to_bits);
        for a in values {
            for b in values {
                let (x, y) = (F32x4::new(a, b, 0.0, 1.0), F32x4::new(b, a, 0.0, 1.0));
                let larger = [max_or_keep(a, b), max_or_keep(b, a)];
                assert_eq!(bits(x.max_or_keep(y).first_two()), bits(larger), "{a} {b}");
                let smaller = [min_or_keep(a, b), min_or_keep(b, a)];
                assert_eq!(bits(x.min_or_keep(y).first_two()), bits(smaller), "{a} {b}");
                let mask = u32::from(a <= b) | u32::from(b <= a) << 1 | 0b1100;
                assert_eq!(x.le_mask(y), mask, "{a} {b}");
            }
        }
        let four = F32x4::new(1.0, 2.0, 3.0, 4.0);
        let signs = F32x4::new(-0.0, 0.0, f32::NEG_INFINITY, 1.0);
        let [first, second] = four.exchanged_where_negative(F32x4::splat(9.0), signs);
        assert_eq!(first.to_array(), [9.0, 2.0, 9.0, 4.0]);
        assert_eq!(second.to_array(), [1.0, 9.0, 3.0, 9.0]);
        assert_eq!(four.high().first_two(), [3.0, 4.0]);
        assert_eq!(four.to_array(), [1.0, 2.0, 3.0, 4.0]);
        assert_eq!((four * four - F32x4::splat(1.0)).first_two(), [0.0, 3.0]);
        let mixed = F32x4::of_axes(Vec3::new(-3.0, -0.0, 2.0), -1.0);
        assert_eq!(
            mixed.abs().to_array().map(f32::to_bits),
            [3.0, 0.0, 2.0, 1.0].map(f32::to_bits)
        );
        assert_eq!([mixed.largest(), mixed.smallest()], [2.0, -3.0]);
        assert_eq!(mixed.axes(), Vec3::new(-3.0, 0.0, 2.0));
        assert_eq!(
            F32x4::from(Vec4::from(mixed)).to_array(),
            [-3.0, 0.0, 2.0, -1.0]
        );
    }

    #[test]
    fn a_lane_that_is_not_finite_is_found() {
        assert!(F32x4::new(0.0, f32::MAX, -f32::MAX, 1e-45).is_finite());
        for lane in 0..4 {
            for value in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
                let mut lanes = F32x4::splat(1.0);
                lanes.lanes_mut()[lane] = value;
                assert!(!lanes.is_finite(), "{lane} {value}");
            }
        }
    }
}
