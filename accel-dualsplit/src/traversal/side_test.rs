//! Meeting the planes of a carving node of a dual-split tree, whatever they are.

use accel_core::PreparedRay;
use accel_core::geometry::Axis;
use accel_core::simd::F32x4;

use crate::codec::FirstWord;

/// What meeting each of the six planes of a box takes of a ray, by
/// [`BoxPlane::index`](crate::codec::BoxPlane::index), and two that cut nothing.
///
/// A branch on whether a node carves on one axis or on two is hard to predict, and
/// no instruction differs: single-axis nodes carve two planes of a box like others,
/// and a plain leaf carves two that are none.
#[derive(Clone, Copy)]
pub struct SideTests([SideTest; 8]);

/// One plane of a box: a ray enters through it or leaves through it. The
/// reciprocal for what it does not do is NaN, which constrains nothing.
///
/// An interval is kept as its near end and its far end negated, so that one maximum
/// cuts both.
#[derive(Clone, Copy)]
#[repr(align(16))]
struct SideTest {
    near_reciprocal: f32,
    negated_far_reciprocal: f32,
    origin: f32,
}

impl SideTests {
    #[inline]
    pub(crate) fn new(ray: &PreparedRay) -> Self {
        let none = SideTest {
            near_reciprocal: f32::NAN,
            negated_far_reciprocal: f32::NAN,
            origin: 0.0,
        };
        let mut sides = [none; 8];
        for axis in Axis::ALL {
            let origin = axis.of(ray.origin());
            // Signs select addresses: a branch on them would be mispredicted for
            // every other ray.
            let is_negative = usize::from(ray.is_negative(axis));
            let low = 2 * axis.index();
            sides[low + is_negative] = SideTest {
                near_reciprocal: axis.of(ray.near_reciprocal()),
                origin,
                ..none
            };
            sides[low + (is_negative ^ 1)] = SideTest {
                negated_far_reciprocal: -axis.of(ray.far_reciprocal()),
                origin,
                ..none
            };
        }
        Self(sides)
    }

    /// What the planes of a carving node leave of an interval; a leaf without
    /// planes, which has none at `planes`, leaves all.
    #[inline(always)]
    pub(crate) fn cut(
        &self,
        node: FirstWord,
        planes: &[u32; 2],
        (near, far): (f32, f32),
    ) -> (f32, f32) {
        let [a, b] = node.carved_planes().map(|index| &self.0[index & 7]);
        let [first, second] = planes.map(f32::from_bits);
        let interval = F32x4::new(near, -far, 0.0, 0.0);
        let interval = interval
            .max_or_keep(a.meet(first))
            .max_or_keep(b.meet(second));
        let [near, negated_far] = interval.first_two();
        (near, -negated_far)
    }
}

impl SideTest {
    /// Where the ray enters through the plane and, negated, where it leaves through
    /// it, NaN for what it does not do.
    #[inline(always)]
    fn meet(&self, plane: f32) -> F32x4 {
        let reciprocals = F32x4::new(self.near_reciprocal, self.negated_far_reciprocal, 0.0, 0.0);
        F32x4::splat(plane - self.origin) * reciprocals
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::codec::{BoxPlane, CarvingPlanes, Header};
    use accel_core::{Aabb, RaySegment};

    /// Directions into all 27 octants, zero components included.
    pub(in crate::traversal) fn directions() -> impl Iterator<Item = [f32; 3]> {
        let signs = [-1.0_f32, 0.0, 1.0];
        let all = signs.into_iter().flat_map(move |x| {
            signs
                .into_iter()
                .flat_map(move |y| signs.map(|z| [x, y, z]))
        });
        let scale = [0.7, 1.3, 0.9];
        all.filter(|direction| *direction != [0.0; 3])
            .map(move |direction| [0, 1, 2].map(|axis| direction[axis] * scale[axis]))
    }

    pub(in crate::traversal) fn origins() -> impl Iterator<Item = [f32; 3]> {
        // On the planes, inside, outside.
        let steps = [-1.0_f32, 0.0, 0.25, 0.5, 1.0, 2.0];
        steps.into_iter().flat_map(move |x| {
            steps
                .into_iter()
                .flat_map(move |y| steps.map(|z| [x, y, z]))
        })
    }

    /// Whole boxes by way of two planes: the planes that are carved come from
    /// `inner`, all others are those of the unit box, already met.
    #[test]
    fn all_12_corners_cut_the_interval_to_that_of_the_carved_box() {
        let unit = Aabb::new([0.0; 3], [1.0; 3]);
        let inner = Aabb::new([0.25; 3], [0.5; 3]);
        let (mut met, mut missed) = (0, 0);
        for [first, second] in [[Axis::X, Axis::Y], [Axis::X, Axis::Z], [Axis::Y, Axis::Z]] {
            for corner in 0..4 {
                let plane = |axis, is_high| BoxPlane { axis, is_high };
                let pair = [
                    plane(first, corner & 2 != 0),
                    plane(second, corner & 1 != 0),
                ];
                let at = |plane: BoxPlane| {
                    plane
                        .axis
                        .of(if plane.is_high { inner.max } else { inner.min })
                };
                let header = Header::Carving {
                    planes: CarvingPlanes::Dual(pair[0], pair[1]),
                    is_leaf: false,
                };
                let carved = pair[0].carve(pair[1].carve(unit, at(pair[1])), at(pair[0]));
                for (origin, direction) in
                    origins().flat_map(|origin| directions().map(move |d| (origin, d)))
                {
                    let ray = PreparedRay::new(&RaySegment::new(origin, direction)).unwrap();
                    let (whole, part) = (ray.slab(&unit), ray.slab(&carved));
                    let planes = pair.map(|plane| at(plane).to_bits());
                    let node = FirstWord(header.encode(3));
                    let cut = SideTests::new(&ray).cut(node, &planes, (whole.near, whole.far));
                    assert_eq!(
                        cut,
                        (part.near, part.far),
                        "{pair:?} {origin:?} {direction:?}"
                    );
                    let count = if part.is_empty() {
                        &mut missed
                    } else {
                        &mut met
                    };
                    *count += 1;
                }
            }
        }
        assert!(met > 10_000 && missed > 10_000, "{met} {missed}");
    }

    #[test]
    fn single_axis_nodes_cut_as_they_do_on_their_axis_and_plain_leaves_not_at_all() {
        let unit = Aabb::new([0.0; 3], [1.0; 3]);
        for axis in Axis::ALL {
            let carved = unit.with_range(axis, 0.25, 0.5);
            let planes = [0.5_f32, 0.25].map(f32::to_bits);
            let single = Header::Carving {
                planes: CarvingPlanes::Single(axis),
                is_leaf: true,
            };
            for (origin, direction) in
                origins().flat_map(|origin| directions().map(move |d| (origin, d)))
            {
                let ray = PreparedRay::new(&RaySegment::new(origin, direction)).unwrap();
                let sides = SideTests::new(&ray);
                let (whole, part) = (ray.slab(&unit), ray.slab(&carved));
                let interval = (whole.near, whole.far);
                let cut = sides.cut(FirstWord(single.encode(3)), &planes, interval);
                assert_eq!(cut, (part.near, part.far), "{axis:?} {ray:?}");
                let leaf = FirstWord(Header::Leaf.encode(3));
                assert_eq!(sides.cut(leaf, &planes, interval), interval);
            }
        }
    }
}
