//! Cutting convex polygons into slabs, for estimates.

use glam::Vec3;

use crate::geometry::{Axis, GrowingBox};
use crate::simd::F32x4;

/// Grows each of `parts` to enclose the part of a convex polygon between two
/// planes orthogonal to `axis`: `parts[i]` lies between `planes[i]` and
/// `planes[i + 1]`. The planes ascend, and there is one more than parts. What
/// lies outside all of them is left out. In single precision.
///
/// The corners of a part are the polygon's corners between the planes and the
/// points where its edges cross them, so one walk around the polygon serves all
/// parts.
pub fn chop_polygon(
    corners: impl IntoIterator<Item = Vec3>,
    axis: Axis,
    planes: &[f32],
    parts: &mut [GrowingBox],
) {
    let mut corners = corners.into_iter().map(|corner| {
        let position = axis.of(corner);
        Corner {
            lanes: F32x4::new(corner.x, corner.y, corner.z, corner.z),
            position,
            planes_before: planes.partition_point(|&plane| plane <= position),
        }
    });
    let Some(first) = corners.next() else { return };
    let mut from = first;
    add_corner(&first, planes, parts);
    for to in corners {
        add_corner(&to, planes, parts);
        add_crossings(&from, &to, planes, parts);
        from = to;
    }
    add_crossings(&from, &first, planes, parts);
}

#[derive(Clone, Copy)]
struct Corner {
    lanes: F32x4,
    /// The coordinate along the axis.
    position: f32,
    /// How many planes lie at or before it.
    planes_before: usize,
}

/// A corner belongs to the part that it lies in; on a plane, to both.
fn add_corner(corner: &Corner, planes: &[f32], parts: &mut [GrowingBox]) {
    let Some(last_before) = corner.planes_before.checked_sub(1) else {
        return;
    };
    if let Some(part) = parts.get_mut(last_before) {
        part.add_lanes(corner.lanes);
    }
    if planes[last_before] == corner.position && last_before > 0 {
        parts[last_before - 1].add_lanes(corner.lanes);
    }
}

/// A point where an edge crosses a plane belongs to the parts on both sides.
fn add_crossings(from: &Corner, to: &Corner, planes: &[f32], parts: &mut [GrowingBox]) {
    let [low, high] = if from.position < to.position {
        [from, to]
    } else {
        [to, from]
    };
    let length = high.position - low.position;
    let slope = (high.lanes - low.lanes) * F32x4::splat(1.0 / length);
    for plane in low.planes_before..high.planes_before {
        let position = planes[plane];
        if position >= high.position {
            break;
        }
        let crossing = low.lanes + slope * F32x4::splat(position - low.position);
        if plane > 0 {
            parts[plane - 1].add_lanes(crossing);
        }
        if let Some(part) = parts.get_mut(plane) {
            part.add_lanes(crossing);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;
    use crate::primitive::{Clip, Triangle};
    use glam::Vec3;
    use proptest::prelude::*;

    fn chopped(triangle: &Triangle, cell: &Aabb, axis: Axis, planes: &[f32]) -> Vec<Aabb> {
        let mut parts = vec![GrowingBox::empty(); planes.len() - 1];
        triangle.chop(cell, axis, planes, &mut parts);
        parts.iter().map(GrowingBox::bounds).collect()
    }

    #[test]
    fn a_corner_on_a_plane_belongs_to_both_parts() {
        let triangle = Triangle::new([0.0; 3], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0]);
        let cell = Aabb::new([0.0; 3], [2.0, 1.0, 0.0]);
        let parts = chopped(&triangle, &cell, Axis::X, &[0.0, 1.0, 2.0]);
        assert_eq!(parts[0], Aabb::new([0.0; 3], [1.0, 1.0, 0.0]));
        assert_eq!(parts[1], Aabb::new([1.0, 0.0, 0.0], [2.0, 1.0, 0.0]));
    }

    fn point() -> impl Strategy<Value = Vec3> {
        // Eighths, so that corners often lie on planes.
        [-8_i8..=8, -8_i8..=8, -8_i8..=8].prop_map(|v| Vec3::from_array(v.map(f32::from)) / 8.0)
    }

    /// Whether a box is at most the touch of a face: there rounding decides whether
    /// there is a part at all.
    fn is_touch(bounds: &Aabb) -> bool {
        bounds.is_empty() || (bounds.max - bounds.min).min_element() <= 1e-6
    }

    fn check_slabs(corners: [Vec3; 3], cell: &Aabb, axis: Axis) {
        let triangle = Triangle::from(corners);
        let planes = [-1.0, -0.5, 0.0, 0.125, 0.25, 1.0];
        let parts = chopped(&triangle, cell, axis, &planes);
        for (slab, part) in planes.windows(2).zip(parts) {
            let clipped = triangle.clip(&cell.with_range(axis, slab[0], slab[1]));
            let clipped = clipped.map_or(Aabb::EMPTY, |clipped| clipped.rounded_outward());
            if clipped.is_empty() != part.is_empty() {
                assert!(
                    is_touch(&clipped) && is_touch(&part),
                    "{clipped:?} {part:?}"
                );
            } else if !part.is_empty() {
                assert!(
                    clipped.min.abs_diff_eq(part.min, 1e-6),
                    "{clipped:?} {part:?}"
                );
                assert!(
                    clipped.max.abs_diff_eq(part.max, 1e-6),
                    "{clipped:?} {part:?}"
                );
            }
        }
    }

    #[test]
    fn a_touch_in_one_point_may_be_a_part_or_none() {
        let corners = [[0.625, 0.875, 0.0], [0.0; 3], [-0.75, -0.375, -0.25]];
        let cell = Aabb::new([-0.5, 0.0, -0.125], [0.25, 0.25, -0.125]);
        check_slabs(corners.map(Vec3::from), &cell, Axis::Y);
    }

    proptest! {
        #[test]
        fn chopping_equals_clipping_to_each_slab(
            corners in [point(), point(), point()],
            (low, high) in (point(), point()),
            axis in 0_usize..3,
        ) {
            check_slabs(corners, &Aabb::around(&[low, high]), Axis::ALL[axis]);
        }
    }
}
