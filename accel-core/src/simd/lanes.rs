//! What vectors of every width can do.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Sub};

use super::Doubles;

/// A vector of `f32`. Operations are lane by lane, in IEEE single precision and
/// never fused, so that every width and instruction set gives the same bits.
///
/// Masks hold a bit per lane, the first lane lowest.
pub trait Lanes:
    Copy
    + Debug
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    /// How many lanes there are: at most 16.
    const COUNT: usize;

    /// As many `f64`.
    type Doubles: Doubles;

    /// The same value in all lanes.
    fn splat(value: f32) -> Self;

    /// The first numbers of `values`, in order.
    ///
    /// # Panics
    /// If there are fewer than lanes.
    fn from_slice(values: &[f32]) -> Self;

    /// `number` of each lane's index, in order.
    fn from_fn(number: impl Fn(usize) -> f32) -> Self;

    /// The numbers with these bits, in order, of the first words.
    ///
    /// # Panics
    /// If there are fewer than lanes.
    #[inline(always)]
    fn from_bits(words: &[u32]) -> Self {
        Self::from_fn(|lane| f32::from_bits(words[lane]))
    }

    /// For each lane the number of `table` whose index stands in its three bits of
    /// `indices`, the first lane's lowest.
    #[inline(always)]
    fn pick(table: &[f32; 8], indices: u64) -> Self {
        Self::from_fn(|lane| table[(indices >> (3 * lane)) as usize & 0b111])
    }

    /// The lanes in memory, in order.
    fn lanes(&self) -> &[f32];

    /// The lanes in memory, to be changed.
    fn lanes_mut(&mut self) -> &mut [f32];

    /// Lane by lane the larger; the lane of `self` where `other` is NaN.
    #[must_use]
    fn max_or_keep(self, other: Self) -> Self;

    /// Lane by lane the smaller; the lane of `self` where `other` is NaN.
    #[must_use]
    fn min_or_keep(self, other: Self) -> Self;

    /// Set where `self <= other`; clear where either is NaN.
    fn le_mask(self, other: Self) -> u32;

    /// Set where `self < other`; clear where either is NaN.
    fn lt_mask(self, other: Self) -> u32;

    /// The same numbers in double precision.
    fn to_doubles(self) -> Self::Doubles;

    /// The nearest numbers in single precision.
    fn from_doubles(doubles: Self::Doubles) -> Self;

    /// The mask of all lanes.
    const ALL: u32 = (1 << Self::COUNT) - 1;
}
