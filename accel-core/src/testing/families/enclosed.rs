//! Closed surfaces with shared vertices.

use super::{Family, family};
use crate::Triangle;
use crate::testing::closed::ClosedMesh;

pub(super) const FAMILIES: &[Family] = &[
    family("room-30", "a closed room of 1 x 30 strips", |_, count| {
        room(count, 30.0)
    }),
    family(
        "room-1000",
        "a closed room of 1 x 1000 strips",
        |_, count| room(count, 1000.0),
    ),
    family("sphere", "a closed sphere", |_, count| {
        super::shapes::sphere(glam::Vec3::ZERO, 1.0, count)
    }),
    family(
        "icosphere",
        "a closed sphere of equal triangles",
        |_, count| {
            let level = (0..8)
                .rev()
                .find(|level| 20 << (2 * level) <= count)
                .unwrap_or(0);
            ClosedMesh::icosphere(level).triangle_list()
        },
    ),
    family("torus", "a closed torus", |_, count| {
        let side = super::shapes::grid_side(count).max(3);
        ClosedMesh::torus(side, side).triangle_list()
    }),
];

/// A room whose walls are `count` / 12 strips each.
fn room(count: usize, aspect: f32) -> Vec<Triangle> {
    ClosedMesh::room((count / 12).max(1), aspect).triangle_list()
}
