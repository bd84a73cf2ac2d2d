//! Planes through an edge that two polygons share, halfway between theirs (Ize
//! 2008, section 6.1).

use std::collections::HashMap;

use accel_core::Polygonal;
use accel_core::glam::{DVec3, Vec3};

use super::{Neighbors, edges, normal_of};
use crate::split_plane::SplitPlane;

/// The same for both directions of an edge.
type EdgeKey = [[u32; 3]; 2];

pub(super) fn collect<P: Polygonal>(node: &Neighbors<'_, P>, planes: &mut Vec<SplitPlane>) {
    let mut owners: HashMap<EdgeKey, Vec<usize>> = HashMap::new();
    for piece in 0..node.pieces.len() {
        for edge in edges(&node.corners(piece)) {
            owners.entry(key(edge)).or_default().push(piece);
        }
    }
    for piece in node.sampled() {
        let corners = node.corners(piece);
        for edge in edges(&corners) {
            let others = owners[&key(edge)].iter().copied();
            // Pairs of sampled pieces meet twice.
            let is_new = |&other: &usize| other > piece || !other.is_multiple_of(node.stride);
            for other in others.filter(|&other| other != piece).filter(is_new) {
                let normals = [&corners, &node.corners(other)]
                    .map(|corners| normal_of(corners).normalize_or_zero());
                let halfway: [DVec3; 2] = [normals[0] + normals[1], normals[0] - normals[1]];
                let plane = |normal| node.plane(edge[0], normal, [piece, other]);
                planes.extend(halfway.into_iter().filter_map(plane));
            }
        }
    }
}

fn key(edge: [Vec3; 2]) -> EdgeKey {
    // The sum turns -0 into 0.
    let mut ends = edge.map(|end| (end + 0.0).to_array().map(f32::to_bits));
    ends.sort_unstable();
    ends
}
