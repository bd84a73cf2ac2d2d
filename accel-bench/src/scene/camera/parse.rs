//! A camera as it is typed: "eye;look-at;vertical-fov[;up]".

use std::fmt;
use std::str::FromStr;

use accel_core::glam::Vec3;

use super::{Camera, CameraError};

/// Vectors are "x,y,z", in parentheses or not, with spaces or not. Without `up`,
/// y is up.
impl FromStr for Camera {
    type Err = CameraError;

    fn from_str(text: &str) -> Result<Self, CameraError> {
        let parts: Vec<&str> = text.split(';').map(str::trim).collect();
        let (eye, look_at, fov, up) = match parts[..] {
            [eye, look_at, fov] => (eye, look_at, fov, None),
            [eye, look_at, fov, up] => (eye, look_at, fov, Some(up)),
            _ => {
                return Err(CameraError::Parts {
                    text: text.to_owned(),
                    found: parts.len(),
                });
            }
        };
        let camera = Self {
            eye: vector("eye", eye)?,
            look_at: vector("look-at", look_at)?,
            up: up.map_or(Ok(Vec3::Y), |up| vector("up", up))?,
            vertical_fov_degrees: fov
                .parse()
                .map_err(|_| CameraError::FieldOfView(fov.to_owned()))?,
        };
        camera.validated()
    }
}

/// Prints what [`FromStr`] reads, to the same bits.
impl fmt::Display for Camera {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let show = |v: Vec3| format!("{},{},{}", v.x, v.y, v.z);
        let (eye, look_at, up) = (show(self.eye), show(self.look_at), show(self.up));
        write!(f, "{eye};{look_at};{};{up}", self.vertical_fov_degrees)
    }
}

fn vector(part: &'static str, text: &str) -> Result<Vec3, CameraError> {
    let error = || CameraError::Vector {
        part,
        value: text.to_owned(),
    };
    let numbers = match text.strip_prefix('(') {
        Some(rest) => rest.strip_suffix(')').ok_or_else(error)?,
        None => text,
    };
    let numbers: Vec<f32> = numbers
        .split(',')
        .map(|number| number.trim().parse())
        .collect::<Result<_, _>>()
        .map_err(|_| error())?;
    match numbers[..] {
        [x, y, z] if Vec3::new(x, y, z).is_finite() => Ok(Vec3::new(x, y, z)),
        _ => Err(error()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cameras_are_read_and_printed_to_the_same_bits() {
        for (text, eye, up) in [
            ("0,1,5;0,0,0;45", [0.0, 1.0, 5.0], [0.0, 1.0, 0.0]),
            (
                "(-13, 5, -1); (0, 5, 0.5); 65",
                [-13.0, 5.0, -1.0],
                [0.0, 1.0, 0.0],
            ),
            (
                " ( 1e3 ,2,.5 );0,0,1;40;1,0,0 ",
                [1e3, 2.0, 0.5],
                [1.0, 0.0, 0.0],
            ),
            (
                "0.1,1e-40,-0;3e38,0,0;179.9;(0,0,-2)",
                [0.1, 1e-40, -0.0],
                [0.0, 0.0, -2.0],
            ),
        ] {
            let camera: Camera = text.parse().unwrap();
            assert_eq!((camera.eye, camera.up), (eye.into(), up.into()), "{text}");
            assert_eq!(camera.to_string().parse(), Ok(camera));
        }
    }

    #[test]
    fn what_is_wrong_with_a_camera_is_named_with_what_was_expected() {
        for (text, found, expected) in [
            ("", "1 parts", "eye;look-at;vertical-fov"),
            ("0,0,0;1,1,1", "2 parts", "eye;look-at;vertical-fov"),
            (
                "0,0,0;1,1,1;40;0,1,0;7",
                "5 parts",
                "eye;look-at;vertical-fov",
            ),
            ("0,0;1,1,1;40", "eye is `0,0`", "three finite numbers"),
            (
                "0,0,0,0;1,1,1;40",
                "eye is `0,0,0,0`",
                "three finite numbers",
            ),
            (
                "0,0,0;1,1,nan;40",
                "look-at is `1,1,nan`",
                "three finite numbers",
            ),
            (
                "0,0,1e39;1,1,1;40",
                "eye is `0,0,1e39`",
                "three finite numbers",
            ),
            ("(0,0,0;1,1,1;40", "eye is `(0,0,0`", "three finite numbers"),
            ("0,0,0;1,1,1;40;up", "up is `up`", "three finite numbers"),
            ("0,0,0;1,1,1;40;", "up is ``", "three finite numbers"),
            ("0,0,0;1,1,1;180", "`180`", "above 0 and below 180"),
            ("0,0,0;1,1,1;0", "`0`", "above 0 and below 180"),
            ("0,0,0;1,1,1;-5", "`-5`", "above 0 and below 180"),
            ("0,0,0;1,1,1;nan", "`NaN`", "above 0 and below 180"),
            ("0,0,0;1,1,1;forty", "`forty`", "above 0 and below 180"),
            ("1,1,1;1,1,1;40", "[1, 1, 1]", "direction"),
            ("0,0,0;1,1,1;40;0,0,0", "up is 0,0,0", "direction"),
        ] {
            let message = text.parse::<Camera>().unwrap_err().to_string();
            assert!(message.contains(found), "{text}: {message}");
            assert!(message.contains(expected), "{text}: {message}");
        }
    }
}
