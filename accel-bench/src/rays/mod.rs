//! The rays that structures are compared with.

mod ambient_occlusion;
mod path;
mod primary;
mod random;
mod sampling;
mod shadow;
mod tiles;

use std::fmt;
use std::str::FromStr;

use accel_core::{Aabb, DynStructure, RaySegment};

use crate::scene::camera::Camera;
pub use ambient_occlusion::RAYS_PER_HIT;

/// The kinds of rays, named as on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RayKind {
    /// From the camera through every pixel; closest hit.
    Primary,
    /// From every primary hit to a point light; any hit.
    Shadow,
    /// Four short rays from every primary hit; any hit.
    AmbientOcclusion,
    /// Five diffuse bounces from every primary hit; closest hit.
    Path,
    /// Between random points on a sphere around the scene; closest hit.
    Random,
    /// The primary rays again; all hits along them.
    Transparent,
}

/// What is asked of each ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Question {
    /// The closest hit.
    Closest,
    /// Whether there is any hit.
    Any,
    /// All hits.
    All,
}

/// Rays of one kind, ready to trace.
#[derive(Clone, Debug)]
pub struct RaySet {
    /// Their kind.
    pub kind: RayKind,
    /// The rays.
    pub rays: Vec<RaySegment>,
    /// What a reader must know of their length, if it is bounded.
    pub note: Option<String>,
}

impl RayKind {
    /// All kinds, in the order of tables.
    pub const ALL: [Self; 6] = [
        Self::Primary,
        Self::Shadow,
        Self::AmbientOcclusion,
        Self::Path,
        Self::Random,
        Self::Transparent,
    ];

    /// The kinds compared unless others are asked for.
    pub const DEFAULT: [Self; 5] = [
        Self::Primary,
        Self::Shadow,
        Self::AmbientOcclusion,
        Self::Path,
        Self::Random,
    ];

    /// Whether neighbours in the set go nearly the same way, as packets want.
    pub fn is_coherent(self) -> bool {
        matches!(self, Self::Primary | Self::Shadow | Self::Transparent)
    }

    /// The name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Primary => "primary",
            Self::Shadow => "shadow",
            Self::AmbientOcclusion => "ao",
            Self::Path => "path",
            Self::Random => "random",
            Self::Transparent => "transparent",
        }
    }

    /// What is asked of rays of this kind.
    pub fn question(self) -> Question {
        match self {
            Self::Primary | Self::Path | Self::Random => Question::Closest,
            Self::Shadow | Self::AmbientOcclusion => Question::Any,
            Self::Transparent => Question::All,
        }
    }
}

impl fmt::Display for RayKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for RayKind {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Self::ALL
            .into_iter()
            .find(|kind| kind.name() == name)
            .ok_or_else(|| {
                let names = Self::ALL.map(Self::name).join(", ");
                format!("there are no rays named `{name}`; there are {names}")
            })
    }
}

impl RaySet {
    /// The same rays in tiles of pixels, if there is one for every pixel of a
    /// picture `width` pixels across. Each structure is asked the same.
    #[must_use]
    pub fn in_tiles(mut self, width: u32) -> Self {
        if matches!(self.kind, RayKind::Primary | RayKind::Transparent) {
            self.rays = tiles::in_tiles(&self.rays, width);
        }
        self
    }
}

/// What rays are made from: a scene seen by a camera. Hits are the same in every
/// structure, so the rays do not depend on which one finds them.
pub struct RaySource<'a> {
    /// Finds the points from which secondary rays start.
    pub structure: &'a dyn DynStructure,
    /// By id, the triangle's surface data for secondary rays.
    pub triangles: &'a [accel_core::Triangle],
    /// The camera.
    pub camera: Camera,
    /// Pixels, across and down.
    pub size: (u32, u32),
    /// The box around the scene.
    pub bounds: Aabb,
    /// How long ambient occlusion rays are, in diagonals of the scene.
    pub ambient_length: f32,
    /// Seed of everything random.
    pub seed: u64,
}

impl RaySource<'_> {
    /// How long ambient occlusion rays are unless another length is asked for,
    /// in diagonals of the scene.
    pub const AMBIENT_LENGTH: f32 = 0.15;

    /// For each pixel, row by row from the top, the ambient occlusion rays from
    /// what it shows; `None` where that is nothing.
    pub fn ambient_occlusion_by_pixel(&self) -> Vec<Option<[RaySegment; RAYS_PER_HIT]>> {
        ambient_occlusion::by_pixel(self)
    }

    /// The rays of one kind.
    pub fn rays(&self, kind: RayKind) -> RaySet {
        let (rays, note) = match kind {
            RayKind::Primary | RayKind::Transparent => (primary::rays(self), None),
            RayKind::Shadow => shadow::rays(self),
            RayKind::AmbientOcclusion => ambient_occlusion::rays(self),
            RayKind::Path => (path::rays(self), None),
            RayKind::Random => (random::rays(self), None),
        };
        RaySet { kind, rays, note }
    }

    /// The length of the scene's diagonal.
    fn diagonal(&self) -> f32 {
        self.bounds.extent().length() as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back() {
        for kind in RayKind::ALL {
            assert_eq!(kind.name().parse(), Ok(kind));
        }
        assert!("rays".parse::<RayKind>().unwrap_err().contains("ao"));
    }
}
