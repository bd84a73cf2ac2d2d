//! Shared foundation of the ray-tracing acceleration structures.

pub use glam;

pub mod primitive;
pub mod ray;
#[cfg(feature = "testing")]
pub mod testing;

pub use primitive::Triangle;
pub use ray::{Ray, RaySegment};
