//! Pinhole cameras.

use std::fmt;
use std::str::FromStr;

use accel_core::RaySegment;
use accel_core::glam::Vec3;

use super::Mesh;

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands, in scene units.
    pub eye: Vec3,
    /// The point in the middle of the picture.
    pub look_at: Vec3,
    /// What is up in the picture; need not be orthogonal to the view.
    pub up: Vec3,
    /// The angle from the lower to the upper border, above 0 and below 180.
    pub vertical_fov_degrees: f32,
}

/// What is wrong with a camera on the command line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CameraError {
    /// Too few or too many parts.
    #[error("`{0}` is not \"eye;look-at;vertical-fov\" or \"eye;look-at;vertical-fov;up\"")]
    Parts(String),
    /// A vector is not three finite numbers.
    #[error("{part} is `{value}`, not three finite numbers x,y,z")]
    Vector {
        /// Which vector.
        part: &'static str,
        /// What was given.
        value: String,
    },
    /// The field of view is out of range.
    #[error("the vertical field of view is `{0}`, not a number of degrees above 0 and below 180")]
    FieldOfView(String),
    /// There is no direction to look in.
    #[error("eye and look-at are both {0}")]
    NoDirection(Vec3),
}

impl FromStr for Camera {
    type Err = CameraError;

    fn from_str(text: &str) -> Result<Self, CameraError> {
        let parts: Vec<&str> = text.split(';').map(str::trim).collect();
        let (eye, look_at, fov, up) = match parts[..] {
            [eye, look_at, fov] => (eye, look_at, fov, "0,1,0"),
            [eye, look_at, fov, up] => (eye, look_at, fov, up),
            _ => return Err(CameraError::Parts(text.to_owned())),
        };
        let camera = Self {
            eye: vector("eye", eye)?,
            look_at: vector("look-at", look_at)?,
            up: vector("up", up)?,
            vertical_fov_degrees: field_of_view(fov)?,
        };
        if camera.eye == camera.look_at {
            return Err(CameraError::NoDirection(camera.eye));
        }
        Ok(camera)
    }
}

fn vector(part: &'static str, text: &str) -> Result<Vec3, CameraError> {
    let inner = text.trim_start_matches('(').trim_end_matches(')');
    let numbers: Result<Vec<f32>, _> = inner
        .split(',')
        .map(|number| number.trim().parse())
        .collect();
    let error = CameraError::Vector {
        part,
        value: text.to_owned(),
    };
    match numbers.as_deref() {
        Ok(&[x, y, z]) if Vec3::new(x, y, z).is_finite() => Ok(Vec3::new(x, y, z)),
        _ => Err(error),
    }
}

fn field_of_view(text: &str) -> Result<f32, CameraError> {
    match text.parse() {
        Ok(degrees) if degrees > 0.0 && degrees < 180.0 => Ok(degrees),
        _ => Err(CameraError::FieldOfView(text.to_owned())),
    }
}

impl fmt::Display for Camera {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let show = |v: Vec3| format!("{},{},{}", v.x, v.y, v.z);
        let (eye, look_at, up) = (show(self.eye), show(self.look_at), show(self.up));
        write!(f, "{eye};{look_at};{};{up}", self.vertical_fov_degrees)
    }
}

impl Camera {
    /// A ray of unit direction through the middle of every pixel, row by row
    /// from the top.
    pub fn rays(&self, width: u32, height: u32) -> Vec<RaySegment> {
        let frame = Frame::new(self, width, height);
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        pixels.map(|(x, y)| frame.ray(x, y)).collect()
    }

    /// A camera that sees `mesh`, chosen from where its triangles are: a
    /// three-quarter view from outside of the box that holds all but the
    /// outermost hundredth of them on each side.
    pub fn seeing(mesh: &Mesh) -> Self {
        let (low, high) = robust_bounds(mesh);
        let center = low * 0.5 + high * 0.5;
        let radius = ((high - low).length() * 0.5).max(f32::MIN_POSITIVE);
        let vertical_fov_degrees: f32 = 45.0;
        // Far enough for a ball of that radius to fit, with some room.
        let distance = 1.1 * radius / (vertical_fov_degrees.to_radians() / 2.0).sin();
        let direction = Vec3::new(0.55, 0.42, 1.0).normalize();
        Self {
            eye: center + direction * distance,
            look_at: center,
            up: Vec3::Y,
            vertical_fov_degrees,
        }
    }
}

/// The ray of each pixel.
struct Frame {
    eye: Vec3,
    forward: Vec3,
    /// Half the picture's width and height at distance 1.
    right: Vec3,
    up: Vec3,
    width: u32,
    height: u32,
}

impl Frame {
    fn new(camera: &Camera, width: u32, height: u32) -> Self {
        let forward = (camera.look_at - camera.eye).normalize_or(Vec3::NEG_Z);
        let right = forward.cross(camera.up);
        // Looking straight up or down, any other direction may be right.
        let right = right.normalize_or(forward.any_orthonormal_vector());
        let up = right.cross(forward);
        let half_height = (camera.vertical_fov_degrees.to_radians() / 2.0).tan();
        let half_width = half_height * width as f32 / height as f32;
        Self {
            eye: camera.eye,
            forward,
            right: right * half_width,
            up: up * half_height,
            width,
            height,
        }
    }

    fn ray(&self, x: u32, y: u32) -> RaySegment {
        let across = (x as f32 + 0.5) / self.width as f32 * 2.0 - 1.0;
        let down = (y as f32 + 0.5) / self.height as f32 * 2.0 - 1.0;
        let direction = self.forward + self.right * across - self.up * down;
        RaySegment::new(self.eye, direction.normalize())
    }
}

/// The box of the middle 98 % of triangle centres on each axis; triangles that
/// are not finite are left out.
fn robust_bounds(mesh: &Mesh) -> (Vec3, Vec3) {
    let mut low = Vec3::splat(-1.0);
    let mut high = Vec3::splat(1.0);
    let centers = mesh.triangles.iter().map(|triangle| {
        triangle
            .iter()
            .map(|&index| mesh.positions[index as usize] / 3.0)
            .sum::<Vec3>()
    });
    let centers: Vec<Vec3> = centers.filter(|center| center.is_finite()).collect();
    if centers.is_empty() {
        return (low, high);
    }
    for axis in 0..3 {
        let mut along: Vec<f32> = centers.iter().map(|center| center[axis]).collect();
        along.sort_unstable_by(f32::total_cmp);
        let outermost = along.len() / 100;
        (low[axis], high[axis]) = (along[outermost], along[along.len() - 1 - outermost]);
    }
    // A single triangle has one centre, but an extent.
    if low == high {
        let size = mesh.triangles[0].map(|index| (mesh.positions[index as usize] - low).length());
        let reach = size
            .into_iter()
            .filter(|size| size.is_finite())
            .fold(0.0, f32::max);
        (low, high) = (low - Vec3::splat(reach), high + Vec3::splat(reach));
    }
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cameras_are_read_from_the_command_line_and_printed_for_it() {
        let camera: Camera = "(-13, 5, -1); (0, 5, 0.5); 65".parse().unwrap();
        assert_eq!(
            (camera.eye, camera.up),
            (Vec3::new(-13.0, 5.0, -1.0), Vec3::Y)
        );
        assert_eq!(camera.to_string().parse(), Ok(camera));
        let upright: Camera = "0,0,0;0,0,1;40;1,0,0".parse().unwrap();
        assert_eq!(upright.up, Vec3::X);
    }

    #[test]
    fn what_is_wrong_with_a_camera_is_named() {
        for (text, word) in [
            ("0,0,0;1,1,1", "vertical-fov"),
            ("0,0;1,1,1;40", "eye"),
            ("0,0,0;1,1,nan;40", "look-at"),
            ("0,0,0;1,1,1;180", "field of view"),
            ("0,0,0;1,1,1;forty", "field of view"),
            ("0,0,0;1,1,1;40;up", "up"),
            ("1,1,1;1,1,1;40", "both"),
        ] {
            let message = text.parse::<Camera>().unwrap_err().to_string();
            assert!(message.contains(word), "{text}: {message}");
        }
    }

    #[test]
    fn rays_run_from_the_upper_left_to_the_lower_right() {
        let camera: Camera = "0,0,0;0,0,-1;90".parse().unwrap();
        let rays = camera.rays(3, 3);
        assert_eq!(rays.len(), 9);
        assert!(rays[0].direction.x < 0.0 && rays[0].direction.y > 0.0);
        assert!(rays[8].direction.x > 0.0 && rays[8].direction.y < 0.0);
        assert!(rays[4].direction.distance(Vec3::NEG_Z) < 1e-6);
    }

    #[test]
    fn a_view_straight_down_still_has_rays() {
        let camera: Camera = "0,5,0;0,0,0;40".parse().unwrap();
        assert!(
            camera
                .rays(4, 3)
                .iter()
                .all(|ray| ray.direction.is_finite())
        );
    }

    #[test]
    fn the_chosen_camera_frames_the_scene_despite_outliers_and_nan() {
        let mut mesh = super::super::embedded::find("figure")
            .unwrap()
            .mesh_of(3000);
        let spoil = mesh.positions.len() as u32;
        mesh.positions
            .extend([Vec3::NAN, Vec3::splat(1e9), Vec3::splat(2e9)]);
        mesh.triangles.push([spoil, spoil + 1, spoil + 2]);
        mesh.triangles.push([spoil + 1, spoil + 1, spoil + 2]);
        let camera = Camera::seeing(&mesh);
        let forward = (camera.look_at - camera.eye).normalize();
        let half = (camera.vertical_fov_degrees.to_radians() / 2.0).cos();
        let is_seen = |p: &&Vec3| (**p - camera.eye).normalize().dot(forward) > half;
        let seen = mesh.positions.iter().filter(is_seen).count();
        assert!(
            seen * 100 > mesh.positions.len() * 95,
            "{seen} of {}",
            mesh.positions.len()
        );
        let single = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]],
        };
        assert!(Camera::seeing(&single).eye.is_finite());
        assert!(Camera::seeing(&Mesh::default()).eye.is_finite());
    }
}
