//! A box that grows, in registers: for the loops of builders.

use glam::{DVec3, Vec3};

use super::Aabb;
use crate::simd::F32x4;

/// An [`Aabb`] held in two vector registers while boxes are added to it.
#[derive(Clone, Copy, Debug)]
pub struct GrowingBox {
    // The fourth lanes hold nothing of interest.
    low: F32x4,
    high: F32x4,
}

impl GrowingBox {
    /// The box of no points.
    #[inline(always)]
    pub fn empty() -> Self {
        Self {
            low: F32x4::splat(f32::INFINITY),
            high: F32x4::splat(f32::NEG_INFINITY),
        }
    }

    /// Grows to enclose `bounds`.
    #[inline(always)]
    pub fn add(&mut self, bounds: &Aabb) {
        let Aabb { min, max } = bounds;
        // Four floats that lie side by side in memory are loaded as one.
        self.low = self.low.min_or_keep(F32x4::new(min.x, min.y, min.z, max.x));
        self.high = self
            .high
            .max_or_keep(F32x4::new(max.x, max.y, max.z, max.z));
    }

    /// Grows to enclose `point`.
    #[inline(always)]
    pub fn add_point(&mut self, point: Vec3) {
        let point = F32x4::new(point.x, point.y, point.z, point.z);
        self.low = self.low.min_or_keep(point);
        self.high = self.high.max_or_keep(point);
    }

    /// Grows to enclose the point in the first three lanes; lanes that are not
    /// numbers change nothing.
    #[inline(always)]
    pub fn add_lanes(&mut self, point: F32x4) {
        self.low = self.low.min_or_keep(point);
        self.high = self.high.max_or_keep(point);
    }

    /// Grows to enclose `other`.
    #[inline(always)]
    pub fn merge(&mut self, other: &Self) {
        self.low = self.low.min_or_keep(other.low);
        self.high = self.high.max_or_keep(other.high);
    }

    /// As [`Aabb::half_area`], for a box that is not empty.
    #[inline(always)]
    pub fn half_area(&self) -> f64 {
        let [low_x, low_y, low_z, _] = self.low.to_array().map(f64::from);
        let [high_x, high_y, high_z, _] = self.high.to_array().map(f64::from);
        let extent = DVec3::new(high_x - low_x, high_y - low_y, high_z - low_z);
        extent.x * (extent.y + extent.z) + extent.y * extent.z
    }

    /// The box.
    #[inline]
    pub fn bounds(&self) -> Aabb {
        Aabb {
            min: self.low.axes(),
            max: self.high.axes(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growing_equals_uniting() {
        let boxes = [
            Aabb::new([1.0, -2.0, 3.0], [2.0, 0.5, 9.0]),
            Aabb::new([-1.0, 4.0, 3.5], [f32::MAX, 4.0, 4.0]),
        ];
        let mut growing = GrowingBox::empty();
        assert_eq!(growing.bounds(), Aabb::EMPTY);
        for bounds in &boxes {
            growing.add(bounds);
        }
        let united = boxes[0].union(&boxes[1]);
        assert_eq!(growing.bounds(), united);
        assert_eq!(growing.half_area(), united.half_area());
        let mut merged = GrowingBox::empty();
        merged.add_point(Vec3::splat(-3.0));
        merged.merge(&growing);
        assert_eq!(merged.bounds(), united.grown_to(Vec3::splat(-3.0)));
    }
}
