//! The tilted cylinder of Ize 2008, section 5, figure 2: 596 long skinny
//! triangles.

use accel_core::glam::{Mat3, Vec3};

use super::builder::MeshBuilder;
use crate::scene::Mesh;

/// Radius and length in scene units, and the tilt from the vertical, towards z
/// and x: the paper gives none of them. A side of the default 298 is 0.0127 wide
/// and 5 long.
const RADIUS: f32 = 0.6;
const LENGTH: f32 = 5.0;
const TILT_X: f32 = 0.7;
const TILT_Z: f32 = 0.6;

/// Without caps: two triangles a side.
pub(super) fn mesh(triangles: usize) -> Mesh {
    let mut builder = MeshBuilder::default();
    let base = Vec3::Y * (-LENGTH / 2.0);
    builder.revolution(base, (triangles / 2).max(3), 1, |v| (RADIUS, v * LENGTH));
    builder.rotate(Mat3::from_rotation_x(TILT_X) * Mat3::from_rotation_z(TILT_Z));
    builder.finish()
}
