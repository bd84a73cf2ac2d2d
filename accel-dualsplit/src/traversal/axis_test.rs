//! Meeting two planes on one axis.

use accel_core::PreparedRay;
use accel_core::geometry::Axis;
use accel_core::ray::{max_or_keep, min_or_keep};

use crate::codec::FirstWord;

/// What meeting planes takes of a ray, for each axis.
#[derive(Clone, Copy)]
pub struct AxisTests([AxisTest; 4]);

#[derive(Clone, Copy)]
pub(crate) struct AxisTest {
    origin: f32,
    near_reciprocal: f32,
    far_reciprocal: f32,
    /// Which of two planes, high and low, the ray leaves through: 1 where it goes
    /// down the axis.
    exit: u32,
}

impl AxisTests {
    #[inline]
    pub(crate) fn new(ray: &PreparedRay) -> Self {
        let test = |axis: Axis| AxisTest {
            origin: axis.of(ray.origin()),
            near_reciprocal: axis.of(ray.near_reciprocal()),
            far_reciprocal: axis.of(ray.far_reciprocal()),
            exit: u32::from(ray.is_negative(axis)),
        };
        let [x, y, z] = Axis::ALL.map(test);
        // One more, so that no index of two bits is out of range.
        Self([x, y, z, z])
    }

    /// For the axis of a splitting or single-axis carving node.
    #[inline(always)]
    pub(crate) fn of(&self, node: FirstWord) -> &AxisTest {
        &self.0[node.axis_index()]
    }

    #[inline(always)]
    pub(crate) fn on(&self, axis: Axis) -> &AxisTest {
        &self.0[axis.index()]
    }
}

impl AxisTest {
    /// Where the ray leaves through one of two planes and enters through the
    /// other. The first plane bounds a box from above, the second one another
    /// (or the same) from below.
    ///
    /// Which is which selects an address, not a branch: axes are hard to predict,
    /// and with them the sign.
    #[inline(always)]
    pub(crate) fn exit_and_entry(&self, planes: &[u32; 2]) -> [f32; 2] {
        let exit = f32::from_bits(planes[self.exit as usize & 1]);
        let entry = f32::from_bits(planes[(self.exit ^ 1) as usize & 1]);
        [
            (exit - self.origin) * self.far_reciprocal,
            (entry - self.origin) * self.near_reciprocal,
        ]
    }

    /// What a high and a low plane leave of an interval.
    #[inline(always)]
    pub(crate) fn cut(&self, planes: &[u32; 2], (near, far): (f32, f32)) -> (f32, f32) {
        let [exit, entry] = self.exit_and_entry(planes);
        (max_or_keep(near, entry), min_or_keep(far, exit))
    }

    /// Of two children, the first of this many words, the one that the ray comes
    /// to first, then the other one.
    #[inline(always)]
    pub(crate) fn in_order(&self, first: u32, words: u32) -> [u32; 2] {
        let mask = self.exit.wrapping_neg();
        [first + (words & mask), first + (words & !mask)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::traversal::side_test::tests::{directions, origins};
    use accel_core::{Aabb, RaySegment};

    #[test]
    fn both_planes_of_an_axis_cut_the_interval_to_that_of_the_carved_box() {
        let unit = Aabb::new([0.0; 3], [1.0; 3]);
        for axis in Axis::ALL {
            let carved = unit.with_range(axis, 0.25, 0.5);
            for (origin, direction) in
                origins().flat_map(|origin| directions().map(move |d| (origin, d)))
            {
                let ray = PreparedRay::new(&RaySegment::new(origin, direction)).unwrap();
                let (whole, part) = (ray.slab(&unit), ray.slab(&carved));
                let planes = [0.5_f32, 0.25].map(f32::to_bits);
                let tests = AxisTests::new(&ray);
                let cut = tests.on(axis).cut(&planes, (whole.near, whole.far));
                assert_eq!(
                    cut,
                    (part.near, part.far),
                    "{axis:?} {origin:?} {direction:?}"
                );
            }
        }
    }

    #[test]
    fn the_first_child_comes_first_up_the_axis_and_last_down_it() {
        for (direction, order) in [(1.0, [7, 10]), (-1.0, [10, 7])] {
            let ray = RaySegment::new([0.0; 3], [direction, 0.0, 0.0]);
            let tests = AxisTests::new(&PreparedRay::new(&ray).unwrap());
            assert_eq!(tests.on(Axis::X).in_order(7, 3), order);
        }
    }
}
