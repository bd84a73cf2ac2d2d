//! Scene families, rays and the agreement check that hold every structure to
//! the answers of brute force.

pub mod agreement;
pub mod closed;
pub mod families;
pub mod family_check;
pub mod rays;
#[cfg(feature = "proptest")]
pub mod strategy;

use glam::Vec3;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

/// A point with coordinates in -1 .. 1.
fn cube_point(random: &mut Pcg64Mcg) -> Vec3 {
    Vec3::from([(); 3].map(|()| random.random_range(-1.0_f32..1.0)))
}

/// A uniform direction.
fn direction(random: &mut Pcg64Mcg) -> Vec3 {
    loop {
        let point = cube_point(random);
        if (1e-3..1.0).contains(&point.length_squared()) {
            return point.normalize();
        }
    }
}
