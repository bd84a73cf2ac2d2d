//! Turning scenes about the axes.

use std::fmt;
use std::str::FromStr;

use accel_core::glam::{DMat3, Vec3};

/// A turn about x, then about y, then about z, through the origin; none by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rotation {
    /// The angles about x, y and z, in degrees.
    pub degrees: [f64; 3],
}

/// Why a text is no rotation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("`{0}` is not three finite numbers of degrees x,y,z, such as 45,45,45")]
pub struct RotationError(String);

impl Rotation {
    /// Where a point goes. Rounded once.
    pub fn apply(&self, point: Vec3) -> Vec3 {
        let [x, y, z] = self.degrees.map(f64::to_radians);
        let matrix =
            DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
        (matrix * point.as_dvec3()).as_vec3()
    }
}

impl FromStr for Rotation {
    type Err = RotationError;

    fn from_str(text: &str) -> Result<Self, RotationError> {
        let angles: Option<Vec<f64>> = text
            .split(',')
            .map(|angle| {
                angle
                    .trim()
                    .parse()
                    .ok()
                    .filter(|angle: &f64| angle.is_finite())
            })
            .collect();
        match angles.as_deref() {
            Some(&[x, y, z]) => Ok(Self { degrees: [x, y, z] }),
            _ => Err(RotationError(text.to_owned())),
        }
    }
}

impl fmt::Display for Rotation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.degrees;
        write!(f, "{x},{y},{z}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_about_each_axis_is_done_in_order() {
        let rotation: Rotation = "90, 90,0".parse().unwrap();
        // About x, y goes to z; about y, z goes to x.
        assert!(rotation.apply(Vec3::Y).abs_diff_eq(Vec3::X, 1e-6));
        assert_eq!(rotation.to_string(), "90,90,0");
    }

    #[test]
    fn what_is_not_three_angles_is_refused() {
        for bad in ["", "45", "45,45", "1,2,3,4", "a,b,c", "0,nan,0", "inf,0,0"] {
            let error = bad.parse::<Rotation>().unwrap_err();
            assert!(error.to_string().contains("45,45,45"), "{error}");
        }
    }
}
