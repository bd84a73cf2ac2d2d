//! Random directions and the surfaces that rays leave.

use accel_core::glam::Vec3;
use accel_core::primitive::{Face, SurfacePoint};
use accel_core::{Hit, PreparedRay, Primitive, RaySegment, Triangle};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// A generator of its own for item `index`, so that items can be made in any
/// order.
pub(super) fn generator(seed: u64, index: usize) -> Pcg64Mcg {
    let stream = (index as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    Pcg64Mcg::seed_from_u64(seed ^ stream)
}

/// A uniform direction: a point in the unit cube's inscribed ball, normalised.
pub(super) fn direction(generator: &mut Pcg64Mcg) -> Vec3 {
    loop {
        let [x, y, z] = [(); 3].map(|()| generator.random_range(-1.0_f32..1.0));
        let point = Vec3::new(x, y, z);
        let length_squared = point.length_squared();
        if (1e-4..1.0).contains(&length_squared) {
            return point / length_squared.sqrt();
        }
    }
}

/// The surface that `ray` hit, its normal turned towards where the ray came
/// from; `None` where the triangle has no normal.
pub(super) fn surface_towards(
    ray: &RaySegment,
    hit: &Hit,
    triangles: &[Triangle],
) -> Option<SurfacePoint> {
    let prepared = PreparedRay::new(ray)?;
    let triangle = triangles.get(hit.id as usize)?;
    let (point, error) = triangle.hit_point(&prepared, hit);
    let normal = triangle.geometric_normal(hit, point);
    if normal == Vec3::ZERO {
        return None;
    }
    let face = Face::towards(&prepared, normal);
    let normal = if face == Face::Front { normal } else { -normal };
    Some(SurfacePoint {
        point,
        error,
        normal,
        face,
    })
}

/// A cosine-weighted direction about the surface's normal.
pub(super) fn cosine_direction(surface: &SurfacePoint, generator: &mut Pcg64Mcg) -> Vec3 {
    // The normal plus a uniform direction is cosine-weighted.
    let sum = surface.normal + direction(generator);
    if sum.length_squared() > 1e-8 {
        sum.normalize()
    } else {
        surface.normal
    }
}
