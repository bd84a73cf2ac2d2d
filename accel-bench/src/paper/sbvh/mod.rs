//! Stich, Friedrich and Dietrich, *Spatial Splits in Bounding Volume
//! Hierarchies*, 2009: Table 1, Figure 5, and the memory limit of section 6.1.

mod methods;
mod pixels;
mod published;
mod sweeps;
mod table;

use accel_core::{Aabb, DynStructure, InvalidPrimitives, Primitive};

use super::Found;
use crate::registry;
use crate::report::document::Section;
use crate::scene::Scene;
use crate::verification::Expected;
use methods::Method;
use pixels::{PixelRays, Work};

/// Where the published figures stand.
pub const SOURCE: &str = "Stich, Friedrich and Dietrich 2009, Table 1";

/// The embedded scenes that stand for the paper's: the rotated hall for its
/// rotated Sponza, the stadium with and without its surroundings for its Bubs.
pub const SCENES: [&str; 4] = ["colonnade", "colonnade-45", "stadium", "figure"];

/// How long ambient occlusion rays are unless another length is asked for, in
/// diagonals of the scene. The paper does not tell. At this length the counts of
/// the BVH and the SBVH over the rotated Sponza are to each other as published;
/// of longer rays most are stopped by something near, whatever the tree.
pub const AMBIENT_LENGTH: f32 = 0.02;

/// Rays of each kind that are compared with brute force.
const SAMPLE: usize = 2000;

/// How to measure.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Pixels of each viewpoint, across and down.
    pub size: (u32, u32),
    /// How many viewpoints.
    pub viewpoints: usize,
    /// How long ambient occlusion rays are, in diagonals of the scene.
    pub ambient_length: f32,
    /// Rounds of timing.
    pub rounds: usize,
    /// Seed of everything random.
    pub seed: u64,
    /// What to do with triangles without finite corners.
    pub invalid: InvalidPrimitives,
}

/// Measures one scene: the four methods of Table 1, the sweep over alpha of
/// Figure 5, and trees under a limit.
///
/// # Errors
/// What the builders answer.
pub fn measure(scene: &Scene, settings: &Settings) -> anyhow::Result<Found> {
    let methods = methods::build_all(&scene.triangles, settings.invalid)?;
    let rays = PixelRays::new(scene, methods.plain().structure.as_ref(), settings);
    let structures: Vec<&dyn DynStructure> = methods
        .in_order()
        .map(|method| method.structure.as_ref())
        .collect();
    let (verified, disagreements) = verify(scene, &structures, &rays, settings)?;
    let work: Vec<Work> = structures.iter().map(|tree| rays.count(*tree)).collect();
    let speeds = rays.speeds(&structures, settings.rounds);
    let all: Vec<&Method> = methods.in_order().collect();
    let mut section = Section {
        heading: format!("{}, {} triangles", scene.name, scene.triangles.len()),
        tables: vec![table::of_methods(&scene.name, &all, &work, &speeds)],
        notes: table::notes(&all, &rays, settings),
        charts: Vec::new(),
        pictures: Vec::new(),
    };
    let (alpha_table, alpha_chart) = sweeps::alpha(&scene.triangles, settings.invalid)?;
    section.tables.push(alpha_table);
    section.charts.push(alpha_chart);
    section
        .tables
        .push(sweeps::limits(&scene.triangles, settings.invalid)?);
    Ok(Found {
        section,
        verified,
        disagreements,
    })
}

/// Compares a sample of the rays with brute force: how many were compared, and
/// how many were answered differently.
fn verify(
    scene: &Scene,
    structures: &[&dyn DynStructure],
    rays: &PixelRays,
    settings: &Settings,
) -> anyhow::Result<(usize, usize)> {
    let oracle = registry::oracle(&scene.triangles, settings.invalid)?;
    let (mut verified, mut disagreements) = (0, 0);
    for set in rays.sets() {
        let stride = set.rays.len().div_ceil(SAMPLE).max(1);
        let sample = set.rays.iter().step_by(stride).copied().collect();
        let expected = Expected::new(&oracle, set.kind.question(), sample, &|_| ());
        for structure in structures {
            verified += expected.len();
            disagreements += expected.disagreements(*structure).len();
        }
    }
    Ok((verified, disagreements))
}

/// The box around all triangles with finite corners; empty if there are none.
fn bounds(scene: &Scene) -> Aabb {
    let boxes = scene.triangles.iter().map(Primitive::bounds);
    boxes
        .filter(Aabb::is_valid)
        .fold(Aabb::EMPTY, |all, bounds| all.union(&bounds))
}
