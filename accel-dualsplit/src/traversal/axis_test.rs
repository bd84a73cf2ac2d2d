//! Meeting two planes on one axis.

use accel_core::PreparedRay;
use accel_core::geometry::Axis;
use accel_core::ray::{max_or_keep, min_or_keep};

use crate::codec::{FirstWord, HeaderSet};

/// What meeting planes takes of a ray, for each axis.
#[derive(Clone, Copy)]
pub struct AxisTests {
    by_axis: [AxisTest; 4],
    /// The headers of nodes on an axis that the ray goes down. Asked in a register,
    /// for where to go next is what everything waits for.
    down: HeaderSet,
}

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
        let down = Axis::ALL.into_iter().filter(|&axis| ray.is_negative(axis));
        Self {
            // One more, so that no index of two bits is out of range.
            by_axis: [x, y, z, z],
            down: down.map(HeaderSet::on).collect(),
        }
    }

    /// For the axis of a splitting or single-axis carving node.
    #[inline(always)]
    pub(crate) fn of(&self, node: FirstWord) -> &AxisTest {
        &self.by_axis[node.axis_index()]
    }

    #[inline(always)]
    pub(crate) fn on(&self, axis: Axis) -> &AxisTest {
        &self.by_axis[axis.index()]
    }

    /// Of the two children of a splitting node, the first of this many words, the one
    /// that the ray comes to first, then the other one.
    #[inline(always)]
    pub(crate) fn in_order(&self, node: FirstWord, first: u32, words: u32) -> [u32; 2] {
        let mask = u32::from(self.down.holds(node)).wrapping_neg();
        [first + (words & mask), first + (words & !mask)]
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codec::Header;
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
        for axis in Axis::ALL {
            for (component, order) in [(1.0, [7, 10]), (-1.0, [10, 7])] {
                let mut direction = [-component; 3];
                direction[axis.index()] = component;
                let ray = RaySegment::new([0.0; 3], direction);
                let tests = AxisTests::new(&PreparedRay::new(&ray).unwrap());
                for first_child_words in [1, 3, 5, 7] {
                    let header = Header::Splitting {
                        axis,
                        first_child_words,
                    };
                    let node = FirstWord(header.encode(3));
                    assert_eq!(
                        tests.in_order(node, 7, 3),
                        order,
                        "{header:?} {direction:?}"
                    );
                }
            }
        }
    }
}
