//! Every plane through three corners: what the other candidates are judged by (Ize
//! 2008, section 5.1).

use accel_core::Polygonal;
use accel_core::glam::Vec3;

use super::Neighbors;
use crate::split_plane::SplitPlane;

pub(super) fn collect<P: Polygonal>(node: &Neighbors<'_, P>, planes: &mut Vec<SplitPlane>) {
    let mut corners: Vec<(Vec3, usize)> = Vec::new();
    for piece in 0..node.pieces.len() {
        for corner in node.corners(piece) {
            if corners.iter().all(|(known, _)| *known != corner) {
                corners.push((corner, piece));
            }
        }
    }
    for (first, &(a, piece)) in corners.iter().enumerate() {
        for (second, &(b, other)) in corners.iter().enumerate().skip(first + 1) {
            for &(c, _) in &corners[second + 1..] {
                let [to_b, to_c] = [b, c].map(|end| end.as_dvec3() - a.as_dvec3());
                planes.extend(node.plane(a, to_b.cross(to_c), [piece, other]));
            }
        }
    }
}
