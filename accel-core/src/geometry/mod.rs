//! Boxes, axes, planes and the rounding that keeps them conservative.

mod aabb;
mod axis;
mod daabb;
mod growing_box;
mod plane;
pub mod rounding;

pub use aabb::Aabb;
pub use axis::Axis;
pub use daabb::DAabb;
pub use growing_box::GrowingBox;
pub use plane::{Plane, Side};
