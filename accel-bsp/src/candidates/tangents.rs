//! Planes through an edge of one polygon and a corner of another (Ize 2008, section
//! 6.1: in a staircase they are tangent to many).

use accel_core::Polygonal;

use super::{Neighbors, edges};
use crate::split_plane::SplitPlane;

/// With so many others for each edge, evenly picked.
pub(super) fn collect<P: Polygonal>(
    node: &Neighbors<'_, P>,
    others: usize,
    planes: &mut Vec<SplitPlane>,
) {
    let count = node.pieces.len();
    let others = others.min(count - 1);
    for piece in node.sampled() {
        let corners = node.corners(piece);
        for step in 1..=others {
            let other = (piece + (step * count).div_ceil(others + 1)) % count;
            for [from, to] in edges(&corners) {
                let edge = to.as_dvec3() - from.as_dvec3();
                let normals = node.corners(other).into_iter().map(|corner| {
                    let spoke = corner.as_dvec3() - from.as_dvec3();
                    edge.cross(spoke)
                });
                let plane = |normal| node.plane(from, normal, [piece, other]);
                planes.extend(normals.filter_map(plane));
            }
        }
    }
}
