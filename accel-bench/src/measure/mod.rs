//! Measuring: speed in interleaved rounds, and counts of what traversals do.

mod counting;
mod timing;

pub use counting::{count, count_pixels};
pub use timing::{Timings, nanoseconds_of_pixels, time_rounds};
