//! Rays: as a caller describes them, and as a traversal wants them.

pub mod packet;
mod prepared;
mod segment;

use glam::Vec3;

pub use packet::{PacketRay, PacketVector, RayPacket};
pub(crate) use prepared::Shear;
pub use prepared::{Interval, PreparedRay, max_or_keep, min_or_keep};
pub use segment::RaySegment;

/// What a traversal needs to know of a ray: implement it on a renderer's own
/// ray type and pass that to every query.
///
/// The direction need not have unit length; `t` counts in its lengths.
pub trait Ray {
    /// Where the ray starts, in scene units.
    fn origin(&self) -> Vec3;
    /// Where it goes: any finite vector but zero.
    fn direction(&self) -> Vec3;
    /// Hits nearer than this are not reported. Negative values count as 0.
    fn t_min(&self) -> f32 {
        0.0
    }
    /// Hits farther than this are not reported. May be infinite.
    fn t_max(&self) -> f32 {
        f32::INFINITY
    }
}

impl<R: Ray + ?Sized> Ray for &R {
    fn origin(&self) -> Vec3 {
        (**self).origin()
    }
    fn direction(&self) -> Vec3 {
        (**self).direction()
    }
    fn t_min(&self) -> f32 {
        (**self).t_min()
    }
    fn t_max(&self) -> f32 {
        (**self).t_max()
    }
}

/// Origin and direction, unbounded: `structure.closest_hit(&(origin, direction))`.
impl Ray for (Vec3, Vec3) {
    fn origin(&self) -> Vec3 {
        self.0
    }
    fn direction(&self) -> Vec3 {
        self.1
    }
}
