//! Several floats at once.
//!
//! [`F32x4`] works on every machine. Wider vectors exist only where the machine
//! has them, which is found at run time: code that wants them is written once
//! over [`Lanes`], as [`SimdWork`], and [`SimdLevel::run`] runs the instance for
//! the machine. That is asked once per packet or batch, not per operation.
//!
//! ```
//! use accel_core::simd::{InstructionSet, Lanes, SimdLevel, SimdWork};
//!
//! /// Which of eight numbers are at most 3.
//! struct AtMostThree([f32; 8]);
//!
//! impl SimdWork for AtMostThree {
//!     type Output = u32;
//!     #[inline(always)]
//!     fn run<I: InstructionSet>(self) -> u32 {
//!         I::Eight::from_slice(&self.0).le_mask(I::Eight::splat(3.0))
//!     }
//! }
//!
//! let numbers = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, f32::NAN, -1.0];
//! for level in SimdLevel::available() {
//!     assert_eq!(level.run(AtMostThree(numbers)), 0b1000_1111);
//! }
//! ```

mod doubles;
mod four;
mod lanes;
mod level;
mod pair;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use doubles::{Doubles, PairOfDoubles};
pub use four::F32x4;
pub use lanes::Lanes;
pub use level::{InstructionSet, SimdLevel, SimdWork};
pub use pair::Pair;

#[cfg(test)]
mod tests;
