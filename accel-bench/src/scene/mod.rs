//! Scenes: triangle meshes with cameras.

pub mod camera;
pub mod embedded;
pub mod mesh;
pub mod obj;

pub use mesh::Mesh;
