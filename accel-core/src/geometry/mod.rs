//! Boxes, axes, planes and the rounding that keeps them conservative.

mod aabb;
mod axis;
mod daabb;
mod plane;
pub mod rounding;

pub use aabb::Aabb;
pub use axis::Axis;
pub use daabb::DAabb;
pub use plane::{Plane, Side};
