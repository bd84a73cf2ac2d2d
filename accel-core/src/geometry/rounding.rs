//! Rounding bounds and directed rounding.
//!
//! Notation: `u` is the unit roundoff of `f32`, 2^-24, and
//! `gamma(n) = n u / (1 - n u)` bounds the relative error of `n` operations
//! (Higham, *Accuracy and Stability of Numerical Algorithms*, section 3.1).

use glam::{DVec3, Vec3};

/// The unit roundoff of `f32`.
pub const UNIT_ROUNDOFF: f32 = 1.0 / (1 << 24) as f32;

/// The relative error that `n` roundings in `f32` can add up to.
pub const fn gamma(n: u32) -> f32 {
    let nu = n as f32 * UNIT_ROUNDOFF;
    nu / (1.0 - nu)
}

/// The largest finite `f32` at most `x`; the smallest finite one if there is
/// none.
#[inline]
pub fn down(x: f64) -> f32 {
    let nearest = x as f32;
    let below = if f64::from(nearest) > x {
        nearest.next_down()
    } else {
        nearest
    };
    below.clamp(-f32::MAX, f32::MAX)
}

/// The smallest finite `f32` at least `x`; the largest finite one if there is
/// none.
#[inline]
pub fn up(x: f64) -> f32 {
    -down(-x)
}

/// [`down`] on each component.
#[inline]
pub fn vec3_down(v: DVec3) -> Vec3 {
    Vec3::new(down(v.x), down(v.y), down(v.z))
}

/// [`up`] on each component.
#[inline]
pub fn vec3_up(v: DVec3) -> Vec3 {
    Vec3::new(up(v.x), up(v.y), up(v.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directed_rounding_encloses_and_is_exact_on_floats() {
        for x in [
            0.1_f64,
            -0.1,
            1.0,
            -1.0,
            1e-50,
            -1e-50,
            1e300,
            -1e300,
            16_777_217.0,
        ] {
            let (below, above) = (down(x), up(x));
            assert!(below.is_finite() && above.is_finite());
            assert!(f64::from(below) <= x || x < -f64::from(f32::MAX));
            assert!(f64::from(above) >= x || x > f64::from(f32::MAX));
            if f64::from(x as f32) == x {
                assert_eq!((below, above), (x as f32, x as f32));
            }
        }
    }

    #[test]
    fn gamma_grows_a_little_faster_than_n() {
        assert!(gamma(3) > 3.0 * UNIT_ROUNDOFF);
        assert!(gamma(3) < 3.001 * UNIT_ROUNDOFF);
    }
}
