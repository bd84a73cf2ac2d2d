//! Axis-aligned bounding boxes.

use glam::{DVec3, Vec3};

use super::{Axis, DAabb, GrowingBox};
use crate::simd::F32x4;

/// An axis-aligned bounding box: all points between `min` and `max`, faces
/// included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The smallest coordinates.
    pub min: Vec3,
    /// The largest coordinates.
    pub max: Vec3,
}

impl Aabb {
    /// The box of no points: the neutral element of [`union`](Self::union).
    pub const EMPTY: Self = Self {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };

    /// What a primitive that can't be bounded answers; [`is_valid`](Self::is_valid)
    /// is false for it.
    pub const INVALID: Self = Self {
        min: Vec3::NAN,
        max: Vec3::NAN,
    };

    /// The box between two corners, `min` at most `max` on every axis.
    pub fn new(min: impl Into<Vec3>, max: impl Into<Vec3>) -> Self {
        Self {
            min: min.into(),
            max: max.into(),
        }
    }

    /// The smallest box around `points`; [`INVALID`](Self::INVALID) if any is
    /// not finite, [`EMPTY`](Self::EMPTY) if there are none.
    #[inline]
    pub fn around(points: &[Vec3]) -> Self {
        let mut bounds = GrowingBox::empty();
        let mut zero = F32x4::splat(0.0);
        for &point in points {
            let point = F32x4::of_axes(point, 0.0);
            bounds.add_lanes(point);
            // NaN for what is not finite, which stays.
            zero = zero * point;
        }
        if zero.is_finite() {
            bounds.bounds()
        } else {
            Self::INVALID
        }
    }

    /// Whether the box is finite and holds at least one point.
    pub fn is_valid(&self) -> bool {
        self.min.is_finite() && self.max.is_finite() && self.min.cmple(self.max).all()
    }

    /// Whether the box holds no point.
    pub fn is_empty(&self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// The smallest box around both.
    #[inline]
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self {
            min: smaller(self.min, other.min),
            max: larger(self.max, other.max),
        }
    }

    /// The smallest box around this one and `point`.
    #[inline]
    #[must_use]
    pub fn grown_to(&self, point: Vec3) -> Self {
        Self {
            min: smaller(self.min, point),
            max: larger(self.max, point),
        }
    }

    /// The common part; empty where the two do not touch.
    #[inline]
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        Self {
            min: larger(self.min, other.min),
            max: smaller(self.max, other.max),
        }
    }

    /// Whether every point of `other` lies in this box.
    pub fn contains(&self, other: &Self) -> bool {
        self.min.cmple(other.min).all() && self.max.cmpge(other.max).all()
    }

    /// The middle, computed so that it never overflows.
    #[inline]
    pub fn center(&self) -> Vec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// The middle along one axis: the same value as that component of
    /// [`center`](Self::center).
    #[inline]
    pub fn center_along(&self, axis: Axis) -> f32 {
        axis.of(self.min) * 0.5 + axis.of(self.max) * 0.5
    }

    /// Edge lengths in double precision, where no finite box overflows; zero
    /// for the empty box.
    #[inline]
    pub fn extent(&self) -> DVec3 {
        (self.max.as_dvec3() - self.min.as_dvec3()).max(DVec3::ZERO)
    }

    /// The largest edge length.
    #[inline]
    pub fn largest_extent(&self) -> f64 {
        self.extent().max_element()
    }

    /// This box with another range on one axis, empty where the two do not
    /// overlap.
    #[inline]
    #[must_use]
    pub fn with_range(mut self, axis: Axis, low: f32, high: f32) -> Self {
        let axis = axis.index();
        self.min[axis] = self.min[axis].max(low);
        self.max[axis] = self.max[axis].min(high);
        self
    }

    /// The axis of the largest edge; the first of equals.
    pub fn widest_axis(&self) -> Axis {
        let extent = self.extent();
        if extent.x >= extent.y && extent.x >= extent.z {
            Axis::X
        } else if extent.y >= extent.z {
            Axis::Y
        } else {
            Axis::Z
        }
    }

    /// Half the surface area, in square scene units and double precision: in
    /// single precision areas overflow at 1e20 and vanish at 1e-30.
    #[inline]
    pub fn half_area(&self) -> f64 {
        let extent = self.extent();
        extent.x * (extent.y + extent.z) + extent.y * extent.z
    }

    /// The box enlarged by `pad` on every side, rounded outward and kept
    /// finite.
    #[must_use]
    pub fn padded(&self, pad: f64) -> Self {
        DAabb::from(*self).padded(pad)
    }

    /// The *gate box* of a primitive with these bounds: enlarged on every side
    /// by 2^-21 of the largest extent, rounded outward.
    ///
    /// The intersection kernel moves vertices by about one unit of rounding of
    /// the primitive's extent, so a hit may lie that far outside the bounds.
    /// Builders reference a primitive by this box, and the leaf loop accepts no
    /// hit outside it: together they make every enclosing box see every hit.
    ///
    /// Computed in single precision, because it is computed for every hit: the
    /// rounding outward is by a step of at least one unit in the last place.
    #[inline]
    #[must_use]
    pub fn gate(&self) -> Self {
        const RELATIVE_PAD: f32 = 1.0 / (1 << 21) as f32;
        const RELATIVE_STEP: f32 = 1.0 / (1 << 23) as f32;
        // Where a relative step would vanish: some subnormal units.
        const SMALLEST_STEP: f32 = f32::from_bits(4);
        let (low, high) = (F32x4::of_axes(self.min, 0.0), F32x4::of_axes(self.max, 0.0));
        let pad = F32x4::splat((high - low).largest() * RELATIVE_PAD);
        let (low, high) = (low - pad, high + pad);
        let step =
            |plane: F32x4| plane.abs() * F32x4::splat(RELATIVE_STEP) + F32x4::splat(SMALLEST_STEP);
        // Steps from and to infinity are not numbers; the limits replace them.
        let lowest = F32x4::splat(-f32::MAX);
        let highest = F32x4::splat(f32::MAX);
        Self {
            min: lowest.max_or_keep(low - step(low)).axes(),
            max: highest.min_or_keep(high + step(high)).axes(),
        }
    }

    /// The corner on the low side where `high` is false and on the high side
    /// where it is true, axis by axis.
    pub fn corner(&self, high: [bool; 3]) -> Vec3 {
        let pick = |axis: Axis| {
            axis.of(if high[axis.index()] {
                self.max
            } else {
                self.min
            })
        };
        Vec3::new(pick(Axis::X), pick(Axis::Y), pick(Axis::Z))
    }
}

// One comparison and one move each, unlike `f32::min`, whose NaN rule costs
// more. Where `b` is NaN, `a` stays.
#[inline]
fn smaller(a: Vec3, b: Vec3) -> Vec3 {
    let pick = |a: f32, b: f32| if b < a { b } else { a };
    Vec3::new(pick(a.x, b.x), pick(a.y, b.y), pick(a.z, b.z))
}

#[inline]
fn larger(a: Vec3, b: Vec3) -> Vec3 {
    let pick = |a: f32, b: f32| if b > a { b } else { a };
    Vec3::new(pick(a.x, b.x), pick(a.y, b.y), pick(a.z, b.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_empty_box_is_neutral_and_has_no_area() {
        let bounds = Aabb::new([1.0, 2.0, 3.0], [2.0, 4.0, 6.0]);
        assert_eq!(Aabb::EMPTY.union(&bounds), bounds);
        assert_eq!(Aabb::EMPTY.half_area(), 0.0);
        assert!(Aabb::EMPTY.is_empty() && !Aabb::EMPTY.is_valid());
        assert!(!Aabb::INVALID.is_valid());
    }

    #[test]
    fn half_area_is_that_of_three_faces() {
        let bounds = Aabb::new([0.0; 3], [1.0, 2.0, 3.0]);
        assert_eq!(bounds.half_area(), 2.0 + 3.0 + 6.0);
    }

    #[test]
    fn areas_and_gates_stay_finite_at_the_ends_of_the_range() {
        let huge = Aabb::new([-f32::MAX; 3], [f32::MAX; 3]);
        assert!(huge.half_area().is_finite());
        assert_eq!(huge.gate(), huge);
        assert!(huge.center().is_finite());
        let tiny = Aabb::new([0.0; 3], [1e-30; 3]);
        assert!(tiny.half_area() > 0.0);
    }

    #[test]
    fn a_gate_is_strictly_larger_by_no_less_than_its_pad() {
        for scale in [1e-44, 1e-38, 1e-20, 1.0, 3e7, 1e30] {
            for extent in [0.0, 1e-6, 1.0] {
                let low = Vec3::new(1.0, -1.0, 0.0) * scale;
                let bounds = Aabb::new(low, low + Vec3::new(extent, 0.0, 0.5 * extent) * scale);
                let gate = bounds.gate();
                let pad = bounds.largest_extent() / f64::from(1 << 21);
                let below = bounds.min.as_dvec3() - gate.min.as_dvec3();
                let above = gate.max.as_dvec3() - bounds.max.as_dvec3();
                let least = below.min(above).min_element();
                assert!(
                    least > 0.0 && least >= pad * (1.0 - 1e-6),
                    "{bounds:?} {gate:?}"
                );
            }
        }
    }

    #[test]
    fn a_non_finite_point_makes_bounds_invalid() {
        let points = [Vec3::ZERO, Vec3::new(0.0, f32::NAN, 0.0)];
        assert!(!Aabb::around(&points).is_valid());
    }
}
