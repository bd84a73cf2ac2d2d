//! The tilted cylinder of Ize 2008, section 5 and figure 2: long skinny
//! triangles in no axis's direction, which only planes of any orientation
//! separate.
//!
//! The paper gives the count, 596, and neither the size nor the tilt. 596 is
//! what a closed cylinder of 150 sides has when its two circles are
//! triangulated without a centre: 2 * 150 + 2 * 148. Ours is of radius 0.6 and
//! length 5, so that a side is 0.025 wide and 200 times as long, and leans by
//! 0.7 rad about x after 0.6 rad about z.

use accel_core::glam::{Affine3A, Quat, Vec3};

use super::shapes::{MeshBuilder, full_turn};
use crate::scene::{Mesh, camera::Camera};

const RADIUS: f32 = 0.6;
const LENGTH: f32 = 5.0;
const TILT_X: f32 = 0.7;
const TILT_Z: f32 = 0.6;

/// Of `4 n - 4` triangles, the nearest such count with `n` of 3 or more; nothing
/// in it is left to the seed.
pub fn cylinder(triangles: usize, _seed: u64) -> Mesh {
    let sides = ((triangles + 6) / 4).max(3);
    let mut builder = MeshBuilder::default();
    let base = Vec3::Y * (-LENGTH / 2.0);
    builder.revolution(base, [sides, 1], |v| (RADIUS, v * LENGTH));
    circle(&mut builder, sides, -LENGTH / 2.0);
    circle(&mut builder, sides, LENGTH / 2.0);
    let tilt = Quat::from_rotation_x(TILT_X) * Quat::from_rotation_z(TILT_Z);
    builder.transform(&Affine3A::from_quat(tilt));
    builder.finish()
}

/// From the front.
pub fn cameras() -> Vec<Camera> {
    vec![Camera::upright([0.0, 0.0, 7.0], [0.0, 0.0, 0.0], 40.0)]
}

/// A polygon cut into `sides - 2` slices from rim to rim, zigzagging across.
fn circle(builder: &mut MeshBuilder, sides: usize, height: f32) {
    let rim = |i: usize| {
        let (sin, cos) = full_turn(i as f32 / sides as f32);
        Vec3::new(RADIUS * cos, height, -RADIUS * sin)
    };
    let (mut low, mut high) = (0, sides - 1);
    while high - low >= 2 {
        let cut_off = low + (sides - 1 - high);
        let from_low = cut_off.is_multiple_of(2);
        let middle = if from_low { low + 1 } else { high - 1 };
        let [a, b, c] = [rim(low), rim(middle), rim(high)];
        builder.triangle(if height > 0.0 { [a, b, c] } else { [a, c, b] });
        if from_low {
            low += 1;
        } else {
            high -= 1;
        }
    }
}
