//! The convex cell of a node, cut by planes in double precision (Ize 2008,
//! sections 3.1 and 3.2).
//!
//! ```text
//! class of a vertex := behind, on or in front of the plane, decided once
//! for each side:
//!     each face keeps its vertices there or on the plane, and the crossings of
//!         its edges, which both faces of an edge share
//!     the edges that come to lie on the plane, reversed and linked, are the cap
//!     refuse the cut if they do not close, or if V - E + F is not 2
//! ```
//!
//! Cells reach over planes by the slack, as what they hold does and as rays visit them
//! ([`Reach`]).

mod cut;

use accel_core::Aabb;
use accel_core::glam::DVec3;

use self::cut::Cut;
use crate::split_plane::SplitPlane;

pub(crate) use self::cut::CutError;

/// A convex polytope: corners, and faces as loops of them, counter-clockwise
/// seen from outside.
#[derive(Clone, Debug)]
pub(crate) struct Polytope {
    corners: Vec<DVec3>,
    faces: Vec<Face>,
    area: f64,
    /// How many planes have cut it: the depth of its node.
    cuts: u32,
}

#[derive(Clone, Debug)]
struct Face {
    corners: Vec<u32>,
    area: f64,
    /// Which of the cuts made it, if the box did not.
    made_by: Option<u32>,
}

/// How far cells reach over the planes that cut them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reach {
    /// By the slack. Without it a cell can have less area than what it holds: two planes
    /// that differ by rounding are a wedge along a bit of the sheet that lies on both,
    /// and a search takes the wedge for almost free.
    Slack,
    /// Not at all, for cells whose faces are to be those of primitives. No part may be
    /// thinner than the slack: there is nothing between two planes that differ by less.
    Exact,
}

impl Reach {
    fn over(self, plane: &SplitPlane) -> f64 {
        match self {
            Self::Slack => plane.slack(),
            Self::Exact => 0.0,
        }
    }
}

/// Corners nearer to a plane than this, relative to the terms of the signed
/// distance, are on it.
const ON_PLANE: f64 = 1.0 / (1_u64 << 40) as f64;

impl Polytope {
    /// The cell of the root.
    pub(crate) fn of_box(bounds: &Aabb) -> Self {
        let corner = |index: u32| bounds.corner([0, 1, 2].map(|axis| index >> axis & 1 == 1));
        let corners = (0..8).map(|index| corner(index).as_dvec3()).collect();
        let loops = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        Self::new(corners, loops.map(|face| (Vec::from(face), None)).into(), 0)
    }

    fn new(corners: Vec<DVec3>, loops: Vec<(Vec<u32>, Option<u32>)>, cuts: u32) -> Self {
        let faces: Vec<Face> = loops
            .into_iter()
            .map(|(loop_corners, made_by)| Face {
                area: loop_area(loop_corners.iter().map(|&index| corners[index as usize])),
                corners: loop_corners,
                made_by,
            })
            .collect();
        let area = faces.iter().map(|face| face.area).sum();
        Self {
            corners,
            faces,
            area,
            cuts,
        }
    }

    /// The faces that cuts have made, by the number of the cut from 0, with their
    /// corners.
    pub(crate) fn cut_faces(&self) -> impl Iterator<Item = (u32, impl Iterator<Item = DVec3>)> {
        self.faces.iter().filter_map(|face| {
            let corners = face
                .corners
                .iter()
                .map(|&index| self.corners[index as usize]);
            Some((face.made_by?, corners))
        })
    }

    /// The surface area; of a flat cell both sides count.
    pub(crate) fn area(&self) -> f64 {
        self.area
    }

    /// The smallest box around the cell.
    pub(crate) fn bounds(&self) -> [DVec3; 2] {
        crate::pieces::bounds_of(&self.corners)
    }

    /// The surface areas of the parts behind and in front of `plane`, without making
    /// them; `None` if one would be empty.
    ///
    /// The slack hardly shows in parts that reach further than that, so it is left out
    /// of them unless something `is_on_plane`, and might lie on a face, too.
    pub(crate) fn split_areas(
        &self,
        plane: &SplitPlane,
        reach: Reach,
        is_on_plane: bool,
        distances: &mut Vec<f64>,
    ) -> Option<[f64; 2]> {
        let slack = plane.slack();
        self.measure(plane, 0.0, distances);
        let reaches = |side: f64| distances.iter().any(|&s| s * side > slack);
        let are_thick = reaches(-1.0) && reaches(1.0);
        if reach == Reach::Exact {
            return are_thick.then(|| self.areas(distances));
        }
        if are_thick && !(is_on_plane && plane.axis().is_none()) {
            return Some(self.areas(distances));
        }
        self.measure(plane, slack, distances);
        let [behind, _] = self.areas(distances);
        self.measure(plane, -slack, distances);
        let [_, in_front] = self.areas(distances);
        (behind > 0.0 && in_front > 0.0).then_some([behind, in_front])
    }

    /// The surface areas of the parts behind and in front of a plane at these
    /// distances; 0 for none.
    ///
    /// The cap needs no linking here: the area of a closed polygon is half the
    /// sum of the cross products of its edges, in any order.
    fn areas(&self, distances: &[f64]) -> [f64; 2] {
        if distances.iter().all(|&s| s >= 0.0) {
            return [0.0, self.area];
        }
        if distances.iter().all(|&s| s <= 0.0) {
            return [self.area, 0.0];
        }
        let (mut behind, mut in_front, mut cap) = (0.0, 0.0, DVec3::ZERO);
        let center = self.corners[0];
        for face in &self.faces {
            let s = |index: u32| distances[index as usize];
            let is_behind = face.corners.iter().any(|&index| s(index) < 0.0);
            if !is_behind {
                in_front += face.area;
                continue;
            }
            let mut loop_area = LoopArea::default();
            let mut previous: Option<(DVec3, bool)> = None;
            let mut first = None;
            let mut visit = |point: DVec3, is_on: bool| {
                loop_area.add(point);
                if let Some((from, true)) = previous
                    && is_on
                {
                    cap += (from - center).cross(point - center);
                }
                previous = Some((point, is_on));
                first.get_or_insert((point, is_on));
            };
            for (index, &from) in face.corners.iter().enumerate() {
                let to = face.corners[(index + 1) % face.corners.len()];
                let (s_from, s_to) = (s(from), s(to));
                if s_from <= 0.0 {
                    visit(self.corners[from as usize], s_from == 0.0);
                }
                if s_from * s_to < 0.0 {
                    visit(self.crossing(from, to, s_from, s_to), true);
                }
            }
            if let (Some((from, true)), Some((to, true))) = (previous, first) {
                cap += (from - center).cross(to - center);
            }
            let part = loop_area.area().min(face.area);
            behind += part;
            in_front += face.area - part;
        }
        let cap = 0.5 * cap.length();
        [behind, in_front].map(|part| (part + cap).min(self.area))
    }

    /// The parts behind and in front of `plane`.
    pub(crate) fn cut(&self, plane: &SplitPlane, reach: Reach) -> Result<[Self; 2], CutError> {
        let overlap = reach.over(plane);
        let mut distances = Vec::with_capacity(self.corners.len());
        self.measure(plane, overlap, &mut distances);
        let behind = self.part(&distances, -1.0)?;
        self.measure(plane, -overlap, &mut distances);
        let in_front = self.part(&distances, 1.0)?;
        Ok([behind, in_front])
    }

    /// The part where the signed distances have this sign.
    fn part(&self, distances: &[f64], sign: f64) -> Result<Self, CutError> {
        if distances.iter().all(|&s| s * sign <= 0.0) {
            return Err(CutError::Misses);
        }
        if distances.iter().all(|&s| s * sign >= 0.0) {
            let mut whole = self.clone();
            whole.cuts += 1;
            return Ok(whole);
        }
        Cut::new(self, distances).side(sign)
    }

    /// The signed distance of each corner from the plane moved to its front by `shift`,
    /// exactly zero for those on it.
    fn measure(&self, plane: &SplitPlane, shift: f64, distances: &mut Vec<f64>) {
        distances.clear();
        let absolute = plane.normal().abs();
        distances.extend(self.corners.iter().map(|&corner| {
            let s = plane.signed_distance(corner) - shift;
            let noise = ON_PLANE * (absolute.dot(corner.abs()) + plane.offset().abs());
            if s.abs() <= noise { 0.0 } else { s }
        }));
    }

    /// Where an edge crosses the plane: the same point for both its directions.
    fn crossing(&self, from: u32, to: u32, s_from: f64, s_to: f64) -> DVec3 {
        let (low, high, s_low, s_high) = if from < to {
            (from, to, s_from, s_to)
        } else {
            (to, from, s_to, s_from)
        };
        let (low, high) = (self.corners[low as usize], self.corners[high as usize]);
        low + (high - low) * (s_low / (s_low - s_high))
    }
}

/// The area of a polygon: half the length of the sum of
/// `(v_i - v_0) x (v_(i+1) - v_0)`.
#[derive(Default)]
struct LoopArea {
    first: Option<DVec3>,
    last: DVec3,
    sum: DVec3,
}

impl LoopArea {
    #[inline]
    fn add(&mut self, point: DVec3) {
        match self.first {
            None => self.first = Some(point),
            Some(first) => self.sum += (self.last - first).cross(point - first),
        }
        self.last = point;
    }

    fn area(&self) -> f64 {
        0.5 * self.sum.length()
    }
}

fn loop_area(points: impl Iterator<Item = DVec3>) -> f64 {
    let mut area = LoopArea::default();
    points.for_each(|point| area.add(point));
    area.area()
}

#[cfg(test)]
mod tests {
    use super::*;
    use accel_core::geometry::{Axis, Plane};
    use accel_core::glam::Vec3;

    fn unit_cube() -> Polytope {
        Polytope::of_box(&Aabb::new([0.0; 3], [1.0; 3]))
    }

    fn through(point: [f32; 3], normal: [f32; 3]) -> SplitPlane {
        let plane = Plane::through(point.into(), Vec3::from(normal).normalize());
        SplitPlane::general(&plane, point.into(), 1e-6).unwrap()
    }

    #[test]
    fn a_cube_is_cut_in_half() {
        let plane = SplitPlane::axis_aligned(Axis::X, 0.5, 1e-6);
        let parts = unit_cube().cut(&plane, Reach::Exact).unwrap();
        assert_eq!(unit_cube().area(), 6.0);
        assert_eq!(parts.map(|part| part.area()), [4.0, 4.0]);
    }

    #[test]
    fn a_corner_cut_off_is_a_tetrahedron_with_areas_known_by_hand() {
        let plane = through([0.5, 0.0, 0.0], [1.0, 1.0, 1.0]);
        let [corner, rest] = unit_cube().cut(&plane, Reach::Exact).unwrap();
        let cap = 3.0_f64.sqrt() / 8.0;
        assert!((corner.area() - (3.0 / 8.0 + cap)).abs() < 1e-6);
        assert!((rest.area() - (6.0 - 3.0 / 8.0 + cap)).abs() < 1e-6);
    }

    #[test]
    fn a_plane_through_corners_and_edges_closes() {
        let [a, b] = unit_cube()
            .cut(&through([0.0; 3], [1.0, -1.0, 0.0]), Reach::Exact)
            .unwrap();
        assert_eq!((a.corners.len(), b.corners.len()), (6, 6));
        let touching = through([0.0; 3], [1.0, 1.0, 1.0]);
        assert_eq!(
            unit_cube().cut(&touching, Reach::Exact).unwrap_err(),
            CutError::Misses
        );
    }

    #[test]
    fn estimated_areas_equal_those_of_the_parts_through_many_cuts() {
        check_estimates(Reach::Exact, false);
        check_estimates(Reach::Slack, true);
    }

    fn check_estimates(reach: Reach, is_on_plane: bool) {
        let mut random = 1_u32;
        let mut next = || {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (random >> 8) as f32 / (1 << 24) as f32
        };
        let (mut cell, mut cuts, mut distances) = (unit_cube(), 0, Vec::new());
        for _ in 0..2000 {
            let normal = [next() - 0.5, next() - 0.5, next() - 0.5];
            let [low, high] = cell.bounds();
            let at = low + (high - low) * f64::from(next());
            let plane = through(at.as_vec3().to_array(), normal);
            let Some(areas) = cell.split_areas(&plane, reach, is_on_plane, &mut distances) else {
                continue;
            };
            let parts = cell.cut(&plane, reach).unwrap();
            for (part, area) in parts.iter().zip(areas) {
                assert!((part.area() - area).abs() <= 1e-9 * cell.area());
            }
            cuts += 1;
            let [behind, in_front] = parts;
            cell = if next() < 0.5 { behind } else { in_front };
            if cell.area() < 1e-3 {
                cell = unit_cube();
            }
        }
        assert!(cuts > 500, "{cuts}");
    }
}
