//! The early miss test: interval arithmetic over all rays of a group.

use accel_core::glam::Vec3;
use accel_core::ray::packet::PacketBounds;
use accel_core::simd::F32x4;

use crate::node::InnerNode;

/// The slab test of [`PacketBounds`] for two boxes at once, in the lanes of the
/// single ray's sibling test.
pub(super) struct SiblingCull {
    near_origin_xy: F32x4,
    far_origin_xy: F32x4,
    /// Near twice, then far twice.
    origin_z: F32x4,
    near_reciprocals_xy: [F32x4; 2],
    far_reciprocals_xy: [F32x4; 2],
    /// Near twice, then far twice.
    reciprocals_z: [F32x4; 2],
    t_min: F32x4,
    negative: [bool; 3],
}

impl SiblingCull {
    #[inline(always)]
    pub(super) fn new(bounds: &PacketBounds) -> Self {
        let pairs = |v: Vec3| F32x4::new(v.x, v.x, v.y, v.y);
        let twice = |near: Vec3, far: Vec3| F32x4::new(near.z, near.z, far.z, far.z);
        let (near, far) = (bounds.near_reciprocal, bounds.far_reciprocal);
        Self {
            near_origin_xy: pairs(bounds.near_origin),
            far_origin_xy: pairs(bounds.far_origin),
            origin_z: twice(bounds.near_origin, bounds.far_origin),
            near_reciprocals_xy: near.map(pairs),
            far_reciprocals_xy: far.map(pairs),
            reciprocals_z: [0, 1].map(|end| twice(near[end], far[end])),
            t_min: F32x4::splat(bounds.t_min),
            negative: near[0].to_array().map(|reciprocal| reciprocal < 0.0),
        }
    }

    /// Which of the boxes some ray may meet before `farthest`: bit 0 for the
    /// left one, bit 1 for the right one.
    #[inline(always)]
    pub(super) fn may_meet(&self, node: &InnerNode<'_>, farthest: f32) -> u32 {
        let [x, y, z] = self.negative;
        let planes = |first: [f32; 2], second: [f32; 2]| {
            F32x4::new(first[0], first[1], second[0], second[1])
        };
        let entry_xy = planes(node.planes(0, x), node.planes(1, y)) - self.near_origin_xy;
        let exit_xy = planes(node.planes(0, !x), node.planes(1, !y)) - self.far_origin_xy;
        let both_z = planes(node.planes(2, z), node.planes(2, !z)) - self.origin_z;

        let [low, high] = self
            .near_reciprocals_xy
            .map(|reciprocal| entry_xy * reciprocal);
        let near = self.t_min.max_or_keep(low.min_or_keep(high));
        let [low, high] = self
            .far_reciprocals_xy
            .map(|reciprocal| exit_xy * reciprocal);
        let far = F32x4::splat(farthest).min_or_keep(low.max_or_keep(high));
        let [low, high] = self.reciprocals_z.map(|reciprocal| both_z * reciprocal);
        let near = near
            .max_or_keep(near.high())
            .max_or_keep(low.min_or_keep(high));
        let far = far
            .min_or_keep(far.high())
            .min_or_keep(low.max_or_keep(high).high());
        near.le_mask(far) & 0b11
    }
}
