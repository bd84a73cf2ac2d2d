//! The rays of the paper's frames (section 5): ray casting, path tracing, a hot spot
//! of the kd-tree (section 5.2), and transparent rays through everything.

use accel_core::{Aabb, DynStructure, Primitive};

use super::Settings;
use super::hot_spot::{self, HotSpot};
use crate::rays::{RayKind, RaySet, RaySource};
use crate::scene::Scene;

/// A frame, by what the paper's tables call it.
pub(super) struct Frame {
    pub name: &'static str,
    pub set: RaySet,
    /// Whether neighbouring rays go nearly the same way from one origin.
    pub is_coherent: bool,
}

/// All frames of a scene.
pub(super) struct Frames {
    pub frames: Vec<Frame>,
    /// Where the kd-tree works hardest; `None` if it has nothing to do.
    pub hot_spot: Option<HotSpot>,
}

/// The rays of the camera, in tiles; none if there is nothing to see.
pub(super) fn ray_cast(scene: &Scene, settings: &Settings) -> RaySet {
    let set = RaySet {
        kind: RayKind::Primary,
        rays: scene.camera.rays(settings.size.0, settings.size.1),
        note: None,
    };
    set.in_tiles(settings.size.0)
}

impl Frames {
    /// Paths and hot spot are found with `kd_tree`.
    pub(super) fn new(scene: &Scene, kd_tree: &dyn DynStructure, settings: &Settings) -> Self {
        let cast = ray_cast(scene, settings);
        let boxes = scene.triangles.iter().map(Primitive::bounds);
        let bounds = boxes
            .filter(Aabb::is_valid)
            .fold(Aabb::EMPTY, |all, bounds| all.union(&bounds));
        if bounds.is_empty() {
            let frames = vec![frame("ray cast", cast, true)];
            return Self {
                frames,
                hot_spot: None,
            };
        }
        let source = RaySource {
            structure: kd_tree,
            triangles: &scene.triangles,
            camera: scene.camera,
            size: settings.size,
            bounds,
            ambient_length: RaySource::AMBIENT_LENGTH,
            seed: settings.seed,
        };
        let mut paths = source.rays(RayKind::Path);
        paths.rays.splice(0..0, cast.rays.iter().copied());
        let transparent = source.rays(RayKind::Transparent);
        let hot_spot = hot_spot::find(kd_tree, scene.camera, settings.size);
        let mut frames = vec![
            frame("ray cast", cast, true),
            frame("path traced", paths, false),
            frame("transparent", transparent.in_tiles(settings.size.0), true),
        ];
        if let Some(spot) = &hot_spot {
            let set = RaySet {
                kind: RayKind::Primary,
                rays: spot.camera.rays(settings.size.0, settings.size.1),
                note: None,
            };
            frames.insert(2, frame("hot spot", set.in_tiles(settings.size.0), true));
        }
        Self { frames, hot_spot }
    }
}

fn frame(name: &'static str, set: RaySet, is_coherent: bool) -> Frame {
    Frame {
        name,
        set,
        is_coherent,
    }
}
