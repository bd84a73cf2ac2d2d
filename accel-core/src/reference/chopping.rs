//! Cutting convex polygons into slabs, for estimates.

use glam::DVec3;

use crate::geometry::{Axis, GrowingBox};

/// Grows each of `parts` to enclose the part of a convex polygon between two
/// planes orthogonal to `axis`: `parts[i]` lies between `planes[i]` and
/// `planes[i + 1]`. The planes ascend, and there is one more than parts. What
/// lies outside all of them is left out. Rounds to nearest.
///
/// The corners of a part are the polygon's corners between the planes and the
/// points where its edges cross them, so one walk around the polygon serves all
/// parts.
pub fn chop_polygon(corners: &[DVec3], axis: Axis, planes: &[f32], parts: &mut [GrowingBox]) {
    let Some(&last) = corners.last() else { return };
    let mut from = last;
    for &to in corners {
        add_corner(to, axis, planes, parts);
        add_crossings([from, to], axis, planes, parts);
        from = to;
    }
}

/// How many of the planes lie at or before `position`.
fn planes_up_to(planes: &[f32], position: f64) -> usize {
    planes.partition_point(|&plane| f64::from(plane) <= position)
}

/// A corner belongs to the part that it lies in; on a plane, to both.
fn add_corner(corner: DVec3, axis: Axis, planes: &[f32], parts: &mut [GrowingBox]) {
    let position = corner[axis.index()];
    let after = planes_up_to(planes, position);
    if let Some(part) = parts.get_mut(after.wrapping_sub(1)) {
        part.add_point(corner.as_vec3());
    }
    let is_on_plane = after > 0 && f64::from(planes[after - 1]) == position;
    if is_on_plane && after > 1 {
        parts[after - 2].add_point(corner.as_vec3());
    }
}

/// A point where an edge crosses a plane belongs to the parts on both sides.
fn add_crossings(edge: [DVec3; 2], axis: Axis, planes: &[f32], parts: &mut [GrowingBox]) {
    let index = axis.index();
    let [low, high] = if edge[0][index] < edge[1][index] {
        edge
    } else {
        [edge[1], edge[0]]
    };
    let first = planes_up_to(planes, low[index]);
    let slope = (high - low) / (high[index] - low[index]);
    for (plane, &position) in planes.iter().enumerate().skip(first) {
        let position = f64::from(position);
        if position >= high[index] {
            break;
        }
        let mut crossing = low + slope * (position - low[index]);
        crossing[index] = position;
        let crossing = crossing.as_vec3();
        for part in [plane.wrapping_sub(1), plane] {
            if let Some(part) = parts.get_mut(part) {
                part.add_point(crossing);
            }
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

    proptest! {
        #[test]
        fn chopping_equals_clipping_to_each_slab(
            corners in [point(), point(), point()],
            (low, high) in (point(), point()),
            axis in 0_usize..3,
        ) {
            let triangle = Triangle::from(corners);
            let cell = Aabb::around(&[low, high]);
            let planes = [-1.0, -0.5, 0.0, 0.125, 0.25, 1.0];
            let axis = Axis::ALL[axis];
            let parts = chopped(&triangle, &cell, axis, &planes);
            for (slab, part) in planes.windows(2).zip(parts) {
                let clipped = triangle.clip(&cell.with_range(axis, slab[0], slab[1]));
                prop_assert_eq!(clipped.is_none(), part.is_empty(), "{:?} {:?}", clipped, part);
                if let Some(clipped) = clipped {
                    let clipped = clipped.rounded_outward();
                    prop_assert!(clipped.min.abs_diff_eq(part.min, 1e-6), "{clipped:?} {part:?}");
                    prop_assert!(clipped.max.abs_diff_eq(part.max, 1e-6), "{clipped:?} {part:?}");
                }
            }
        }
    }
}
