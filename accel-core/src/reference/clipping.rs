//! Clipping convex polygons against boxes, in double precision.

use arrayvec::ArrayVec;
use glam::{DVec3, Vec3};

use crate::geometry::{Aabb, DAabb};

/// The most corners that a polygon given to the clipper may have.
const MAX_CORNERS: usize = 10;

/// Each of the six planes adds at most one corner to a convex polygon.
pub type ClippedCorners = ArrayVec<DVec3, { MAX_CORNERS + 6 }>;

/// Bounds of the part of a convex polygon inside `cell`; `None` if it lies
/// outside.
///
/// Computed by clipping the polygon against the cell's planes one after the
/// other (Sutherland and Hodgman 1974). Polygons of more than ten corners are
/// bounded by their box instead.
pub fn clip_polygon(corners: &[Vec3], cell: &Aabb) -> Option<DAabb> {
    let whole = Aabb::around(corners);
    if whole.intersection(cell).is_empty() {
        return None;
    }
    if cell.contains(&whole) {
        return Some(whole.into());
    }
    if corners.len() > MAX_CORNERS {
        return Some(whole.intersection(cell).into());
    }
    DAabb::around(&clip_polygon_corners(corners, &DAabb::from(*cell)))
}

/// The corners of the part of a convex polygon of at most ten corners inside
/// `cell`; further corners are ignored.
pub fn clip_polygon_corners(corners: &[Vec3], cell: &DAabb) -> ClippedCorners {
    let mut polygon: ClippedCorners = corners
        .iter()
        .take(MAX_CORNERS)
        .map(|corner| corner.as_dvec3())
        .collect();
    for axis in 0..3 {
        for (position, sign) in [(cell.min[axis], 1.0), (cell.max[axis], -1.0)] {
            let is_outside = |corner: &DVec3| sign * (corner[axis] - position) < 0.0;
            if polygon.iter().any(is_outside) {
                polygon = keep_side(&polygon, axis, position, sign);
            }
        }
    }
    polygon
}

/// The part of the polygon with `sign * (p[axis] - position) >= 0`.
fn keep_side(polygon: &ClippedCorners, axis: usize, position: f64, sign: f64) -> ClippedCorners {
    let mut kept = ClippedCorners::new();
    let Some(&last) = polygon.last() else {
        return kept;
    };
    let distance = |point: DVec3| sign * (point[axis] - position);
    let mut from = last;
    for &to in polygon {
        let (s_from, s_to) = (distance(from), distance(to));
        if (s_from < 0.0 && s_to > 0.0) || (s_from > 0.0 && s_to < 0.0) {
            // Rounding can only push past capacity if the polygon is not
            // convex; then the crossing lies on kept corners' hull anyway.
            let _ = kept.try_push(crossing(from, to, axis, position));
        }
        if s_to >= 0.0 {
            let _ = kept.try_push(to);
        }
        from = to;
    }
    kept
}

/// Where the edge crosses the plane. Ordered by coordinate, so that both
/// triangles at an edge compute the same point.
fn crossing(from: DVec3, to: DVec3, axis: usize, position: f64) -> DVec3 {
    let (low, high) = if from[axis] < to[axis] {
        (from, to)
    } else {
        (to, from)
    };
    let fraction = (position - low[axis]) / (high[axis] - low[axis]);
    let mut point = low + (high - low) * fraction;
    point = point.clamp(low.min(high), low.max(high));
    point[axis] = position;
    point
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    #[test]
    fn a_polygon_inside_keeps_its_box_and_one_outside_has_none() {
        let around = Aabb::new([-1.0; 3], [2.0; 3]);
        let clipped = clip_polygon(&TRIANGLE, &around).unwrap();
        assert_eq!(
            clipped.rounded_outward(),
            Aabb::new([0.0; 3], [1.0, 1.0, 0.0])
        );
        assert_eq!(
            clip_polygon(&TRIANGLE, &Aabb::new([2.0; 3], [3.0; 3])),
            None
        );
    }

    #[test]
    fn a_corner_cut_off_is_bounded_tightly() {
        let cell = Aabb::new([0.75, 0.0, -1.0], [1.0, 1.0, 1.0]);
        let clipped = clip_polygon(&TRIANGLE, &cell).unwrap();
        assert_eq!(
            clipped.rounded_outward(),
            Aabb::new([0.75, 0.0, 0.0], [1.0, 0.25, 0.0])
        );
    }

    #[test]
    fn a_hexagon_is_the_most_that_a_box_makes_of_a_plane_through_it() {
        let big = [
            Vec3::new(6.0, -3.0, -3.0),
            Vec3::new(-3.0, 6.0, -3.0),
            Vec3::new(-3.0, -3.0, 6.0),
        ];
        let unit = DAabb::from(Aabb::new([-1.0; 3], [1.0; 3]));
        assert_eq!(clip_polygon_corners(&big, &unit).len(), 6);
    }
}
