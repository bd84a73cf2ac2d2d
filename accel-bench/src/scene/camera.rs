//! Pinhole cameras.

mod framing;
mod parse;

use accel_core::Aabb;
use accel_core::RaySegment;
use accel_core::glam::{DQuat, DVec3, Vec3};

use super::Mesh;

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it stands, in scene units.
    pub eye: Vec3,
    /// The point in the middle of the picture.
    pub look_at: Vec3,
    /// What is up in the picture; need not be orthogonal to the view. Where it is
    /// parallel to it, another direction takes its place.
    pub up: Vec3,
    /// The angle from the lower to the upper border, above 0 and below 180.
    pub vertical_fov_degrees: f32,
}

/// What is wrong with a camera.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CameraError {
    /// Too few or too many parts.
    #[error(
        "`{text}` has {found} parts between semicolons, not the 3 or 4 of \
         \"eye;look-at;vertical-fov[;up]\", such as \"0,1,5;0,0,0;45\""
    )]
    Parts {
        /// What was given.
        text: String,
        /// How many parts it has.
        found: usize,
    },
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
    #[error("eye and look-at are both {0}, so there is no direction to look in")]
    NoDirection(Vec3),
    /// There is no up.
    #[error("up is 0,0,0, which is no direction")]
    NoUp,
}

impl Camera {
    /// A camera with y up.
    pub fn upright(
        eye: impl Into<Vec3>,
        look_at: impl Into<Vec3>,
        vertical_fov_degrees: f32,
    ) -> Self {
        Self {
            eye: eye.into(),
            look_at: look_at.into(),
            up: Vec3::Y,
            vertical_fov_degrees,
        }
    }

    /// The camera itself if it has a picture.
    ///
    /// # Errors
    /// A vector that is not finite, a field of view out of range, an eye at the
    /// point looked at, or an up without direction.
    pub fn validated(self) -> Result<Self, CameraError> {
        let vectors = [
            ("eye", self.eye),
            ("look-at", self.look_at),
            ("up", self.up),
        ];
        if let Some((part, v)) = vectors.into_iter().find(|(_, v)| !v.is_finite()) {
            let value = format!("{},{},{}", v.x, v.y, v.z);
            return Err(CameraError::Vector { part, value });
        }
        let degrees = self.vertical_fov_degrees;
        if !(degrees > 0.0 && degrees < 180.0) {
            return Err(CameraError::FieldOfView(degrees.to_string()));
        }
        if self.eye == self.look_at {
            return Err(CameraError::NoDirection(self.eye));
        }
        if self.up == Vec3::ZERO {
            return Err(CameraError::NoUp);
        }
        Ok(self)
    }

    /// A ray of unit direction through the middle of every pixel, row by row
    /// from the top.
    pub fn rays(&self, width: u32, height: u32) -> Vec<RaySegment> {
        let frame = Frame::new(self, width, height);
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        pixels.map(|(x, y)| frame.ray(x, y, [0.5; 2])).collect()
    }

    /// The ray of unit direction through pixel `x` from the left and `y` from the
    /// top of a picture of `width` by `height`. `jitter` says where in the pixel:
    /// 0,0 is its upper left corner and 1,1 its lower right one.
    pub fn ray(&self, x: u32, y: u32, width: u32, height: u32, jitter: [f32; 2]) -> RaySegment {
        Frame::new(self, width, height).ray(x, y, jitter)
    }

    /// This camera and others, `count` in all, at equal angles about its up: from
    /// inside `bounds` looking around, from outside looking in from all sides.
    pub fn viewpoints(&self, bounds: &Aabb, count: usize) -> Vec<Self> {
        let is_inside = bounds.contains(&Aabb::new(self.eye, self.eye));
        let axis = self.up.as_dvec3().normalize_or(DVec3::Y);
        let view = self.look_at.as_dvec3() - self.eye.as_dvec3();
        let turned = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / count as f64;
            let view = DQuat::from_axis_angle(axis, angle) * view;
            let mut camera = *self;
            if is_inside {
                camera.look_at = (self.eye.as_dvec3() + view).as_vec3();
            } else {
                camera.eye = (self.look_at.as_dvec3() - view).as_vec3();
            }
            camera
        };
        (0..count).map(turned).collect()
    }

    /// A camera that sees `mesh`: from outside, unless few but large triangles
    /// hide most of the others from there, as walls do; then from inside.
    ///
    /// Chosen from where most triangles are. Those without finite corners are
    /// left out; a mesh without any others gets a view of the origin.
    pub fn seeing(mesh: &Mesh) -> Self {
        framing::camera_seeing(mesh)
    }
}

/// The picture of a camera. In f64, so that neither the smallest scenes nor
/// f32::MAX between eye and scene are a special case.
struct Frame {
    eye: Vec3,
    forward: DVec3,
    /// Half the picture's width, at distance 1.
    right: DVec3,
    /// Half the picture's height, at distance 1.
    up: DVec3,
    size: [f64; 2],
}

impl Frame {
    fn new(camera: &Camera, width: u32, height: u32) -> Self {
        let eye = camera.eye.as_dvec3();
        let forward = (camera.look_at.as_dvec3() - eye).normalize_or(DVec3::NEG_Z);
        let right = forward.cross(camera.up.as_dvec3().normalize_or_zero());
        let right = if right.length() > 1e-6 {
            right.normalize()
        } else {
            // Looking straight up or down: the picture's up is what was ahead.
            let ahead = if forward.z.abs() < 0.9 {
                DVec3::NEG_Z
            } else {
                DVec3::Y
            };
            forward.cross(ahead).normalize()
        };
        let up = right.cross(forward);
        let size = [width, height].map(f64::from);
        let half_height = (f64::from(camera.vertical_fov_degrees).to_radians() / 2.0).tan();
        Self {
            eye: camera.eye,
            forward,
            right: right * (half_height * size[0] / size[1]),
            up: up * half_height,
            size,
        }
    }

    fn ray(&self, x: u32, y: u32, jitter: [f32; 2]) -> RaySegment {
        let across = (f64::from(x) + f64::from(jitter[0])) / self.size[0] * 2.0 - 1.0;
        let down = (f64::from(y) + f64::from(jitter[1])) / self.size[1] * 2.0 - 1.0;
        let direction = self.forward + self.right * across - self.up * down;
        RaySegment::new(self.eye, direction.normalize().as_vec3())
    }

    /// Where a point is in the picture: -1 to 1 from left to right and from
    /// bottom to top; `None` behind the eye.
    fn project(&self, point: Vec3) -> Option<[f64; 2]> {
        let from_eye = point.as_dvec3() - self.eye.as_dvec3();
        let depth = from_eye.dot(self.forward);
        let place = |half: DVec3| from_eye.dot(half) / (half.length_squared() * depth);
        (depth > 0.0).then(|| [place(self.right), place(self.up)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_run_from_the_upper_left_to_the_lower_right() {
        let camera = Camera::upright([0.0; 3], [0.0, 0.0, -1.0], 90.0);
        let rays = camera.rays(3, 3);
        assert_eq!(rays.len(), 9);
        assert!(rays[0].direction.x < 0.0 && rays[0].direction.y > 0.0);
        assert!(rays[8].direction.x > 0.0 && rays[8].direction.y < 0.0);
        assert!(rays[4].direction.distance(Vec3::NEG_Z) < 1e-6);
        assert!(
            rays.iter()
                .all(|ray| (ray.direction.length() - 1.0).abs() < 1e-6)
        );
    }

    #[test]
    fn the_field_of_view_ends_at_the_borders_of_the_outer_pixels() {
        let camera = Camera::upright([0.0; 3], [0.0, 0.0, -1.0], 90.0);
        let corner = camera.ray(0, 0, 8, 4, [0.0, 0.0]).direction;
        let expected = Vec3::new(-2.0, 1.0, -1.0).normalize();
        assert!(corner.distance(expected) < 1e-6, "{corner}");
        assert_eq!(
            camera.ray(5, 2, 8, 4, [0.5; 2]),
            camera.rays(8, 4)[2 * 8 + 5]
        );
    }

    #[test]
    fn points_project_to_where_their_rays_are() {
        let camera: Camera = "1,2,3;-4,0,1;50;0.1,1,0.3".parse().unwrap();
        let frame = Frame::new(&camera, 16, 9);
        for (x, y) in [(0, 0), (15, 8), (3, 7)] {
            let ray = camera.ray(x, y, 16, 9, [0.25, 0.75]);
            let [across, above] = frame.project(ray.origin + ray.direction * 7.0).unwrap();
            assert!(((across + 1.0) * 8.0 - f64::from(x) - 0.25).abs() < 1e-4);
            assert!(((1.0 - above) * 4.5 - f64::from(y) - 0.75).abs() < 1e-4);
        }
        assert_eq!(frame.project(Vec3::new(6.0, 4.0, 5.0)), None);
    }

    #[test]
    fn views_along_up_and_across_huge_or_tiny_distances_have_unit_rays() {
        for (eye, look_at) in [
            ([0.0, 5.0, 0.0], [0.0; 3]),
            ([0.0, -5.0, 0.0], [0.0; 3]),
            ([-3e38; 3], [3e38; 3]),
            ([0.0; 3], [1e-42, 0.0, 0.0]),
        ] {
            let camera = Camera::upright(eye, look_at, 40.0);
            for ray in camera.rays(4, 3) {
                let length = ray.direction.length();
                assert!((length - 1.0).abs() < 1e-6, "{camera:?}: {length}");
            }
        }
    }

    #[test]
    fn a_picture_without_pixels_has_no_rays() {
        let camera = Camera::upright([0.0; 3], [0.0, 0.0, -1.0], 90.0);
        assert!(camera.rays(0, 5).is_empty() && camera.rays(5, 0).is_empty());
    }
}
