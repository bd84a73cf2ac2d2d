//! A triangle mesh with shared vertices.

use glam::Vec3;

/// Shared vertices and the triangles between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions in scene units.
    pub positions: Vec<Vec3>,
    /// Three indices into `positions` per triangle.
    pub triangles: Vec<[u32; 3]>,
}
