//! Points on a triangle's edges and so near beside them that only a
//! watertight test tells right.

use glam::DVec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::random::{log_uniform, sign};

/// A point on the edge from the first corner to the second.
pub(super) fn point_on_edge([start, end, _]: [DVec3; 3], rng: &mut Pcg64Mcg) -> DVec3 {
    start.lerp(end, rng.random::<f64>())
}

/// A point in the triangle's plane, 1e-8 to 1e-6 of the edge's length away
/// from one on the edge between the first two corners; as often within the
/// triangle as outside of it.
pub(super) fn point_beside_edge(corners: [DVec3; 3], rng: &mut Pcg64Mcg) -> DVec3 {
    let [start, end, opposite] = corners;
    let point = point_on_edge(corners, rng);
    let edge = end - start;
    let inward = (opposite - point)
        .reject_from(edge.normalize_or(DVec3::X))
        .normalize_or_zero();
    let distance = edge.length() * log_uniform(rng, 1e-8, 1e-6);
    point + inward * distance * f64::from(sign(rng))
}
