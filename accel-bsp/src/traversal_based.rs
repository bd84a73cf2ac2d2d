//! Which leaves the traversal itself can answer (Ize 2008, section 4.3,
//! "traversal based triangle intersection").
//!
//! A leaf qualifies if it holds one polygon, if a plane above is the plane of the
//! polygon, and if the face that this plane cuts into the cell and the polygon's
//! part in the cell are the same. Then a ray hits the polygon there exactly if it enters or leaves the
//! cell through that face, rounding aside.

use accel_core::Polygonal;
use accel_core::glam::{DVec3, Vec3};

use crate::BspTree;
use crate::candidates::{lies_on, slack_of};
use crate::cells::{Ancestor, for_each_cell};
use crate::node::{Node, NodeKind};
use crate::pieces::Pieces;
use crate::polytope::{Polytope, Reach};
use crate::split_plane::SplitPlane;

impl<P: Polygonal> BspTree<P> {
    /// Writes into each leaf that qualifies the depth of its plane.
    pub(crate) fn mark_bounded_leaves(&mut self, primitives: &[P]) {
        let Some(bounds) = self.bounds else { return };
        let mut marked = Vec::new();
        let all_cut = for_each_cell(&self.nodes, &bounds, Reach::Exact, |index, cell, path| {
            let node = self.nodes.node(index);
            if let NodeKind::Leaf(leaf) = node.kind()
                && let mut ids = self.ids_of(node)
                && let (Some(id), None) = (ids.next(), ids.next())
                && let Some(depth) = bounding_depth(&primitives[id as usize], cell, path)
            {
                marked.push((index, Node::bounded_leaf(leaf, depth)));
            }
        });
        debug_assert!(all_cut.is_ok(), "the build has made the same cuts");
        for (index, node) in marked {
            self.nodes.replace(index, node);
        }
    }
}

/// The depth of the plane whose face of `cell` is the part of the polygon there;
/// `path` holds the planes by depth.
fn bounding_depth<P: Polygonal>(primitive: &P, cell: &Polytope, path: &[Ancestor]) -> Option<u32> {
    if !primitive.is_convex_polygon() {
        return None;
    }
    let corners: Vec<DVec3> = primitive.vertices().map(Vec3::as_dvec3).collect();
    let tolerance = slack_of(primitive);
    let mut faces = cell.cut_faces();
    faces.find_map(|(depth, face)| {
        let plane = with_slack(&path[depth as usize].plane, tolerance);
        let face: Vec<DVec3> = face.collect();
        let is_face_inside = || {
            face.iter()
                .all(|&point| is_inside(point, &corners, tolerance))
        };
        // Between two planes that differ by rounding, a cell may end inside the
        // polygon.
        let is_part_inside = || {
            let part = Pieces::part_of(primitive, path);
            part.is_some_and(|part| {
                let mut corners = part.corners(0).iter();
                corners.all(|&point| is_inside(point, &face, tolerance))
            })
        };
        let qualifies = lies_on(primitive, &plane) && is_face_inside() && is_part_inside();
        qualifies.then_some(depth)
    })
}

/// The plane with a slack that suits the primitive: axis-aligned ones share a larger.
fn with_slack(plane: &SplitPlane, slack: f64) -> SplitPlane {
    plane.axis().map_or(*plane, |axis| {
        SplitPlane::axis_aligned(axis, plane.offset() as f32, slack)
    })
}

/// Whether a point of the plane of a convex polygon lies inside it, or outside by
/// no more than `tolerance`.
fn is_inside(point: DVec3, polygon: &[DVec3], tolerance: f64) -> bool {
    let next = |index: usize| polygon[(index + 1) % polygon.len()];
    let edges = || (0..polygon.len()).map(|index| next(index) - polygon[index]);
    let cross_products = edges().zip((1..=polygon.len()).map(|index| {
        let index = index % polygon.len();
        next(index) - polygon[index]
    }));
    let normal: DVec3 = cross_products.map(|(edge, after)| edge.cross(after)).sum();
    edges().zip(polygon).all(|(edge, &corner)| {
        let inward = normal.cross(edge).normalize_or_zero();
        inward != DVec3::ZERO && inward.dot(point - corner) >= -tolerance
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_inside_up_to_the_tolerance() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let square = square.map(|[x, y]| DVec3::new(x, y, 2.0));
        let is_inside = |x, y| is_inside(DVec3::new(x, y, 2.0), &square, 0.125);
        assert!(is_inside(0.5, 0.5) && is_inside(1.0, 0.0) && is_inside(1.125, 0.5));
        assert!(!is_inside(1.25, 0.5) && !is_inside(0.5, -0.25));
        let reversed: Vec<DVec3> = square.iter().rev().copied().collect();
        assert!(super::is_inside(DVec3::new(0.5, 0.5, 2.0), &reversed, 0.0));
        let line = [DVec3::ZERO, DVec3::X, DVec3::X * 2.0];
        assert!(!super::is_inside(DVec3::X, &line, 1.0));
    }
}
