//! Lin, Shkurko, Mallett and Yuksel, *Dual-Split Trees*, 2019: Tables 1, 2 and 3
//! and Figure 10.

mod frame;
mod methods;
mod published;
mod tables;

use accel_core::{DynStructure, InvalidPrimitives};

use super::Found;
use crate::measure;
use crate::registry;
use crate::report::document::Section;
use crate::scene::Scene;
use crate::verification::Expected;
use frame::Frame;
use methods::Method;

/// Where the published figures stand.
pub const SOURCE: &str = "Lin, Shkurko, Mallett and Yuksel 2019, Tables 1 to 3";

/// Embedded scenes of the paper's kinds: architecture, plants, hair, pipes.
pub const SCENES: [&str; 5] = ["colonnade", "room", "foliage", "hairball", "pipes"];

/// Rays that are compared with brute force.
const SAMPLE: usize = 2000;

/// How to measure.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Pixels of the frame, across and down.
    pub size: (u32, u32),
    /// Rounds of timing.
    pub rounds: usize,
    /// Seed of everything random.
    pub seed: u64,
    /// What to do with triangles without finite corners.
    pub invalid: InvalidPrimitives,
}

/// Measures one scene: all structures from one BVH.
///
/// # Errors
/// What the builders and converters answer.
pub fn measure(scene: &Scene, settings: &Settings) -> anyhow::Result<Found> {
    let built = methods::build_all(&scene.triangles, settings.invalid)?;
    let structures: Vec<&dyn DynStructure> = built
        .methods
        .iter()
        .map(|method| method.structure.as_ref())
        .collect();
    let frame = Frame::new(scene, structures[0], settings);
    let oracle = registry::oracle(&scene.triangles, settings.invalid)?;
    let set = frame.rays();
    let stride = set.rays.len().div_ceil(SAMPLE).max(1);
    let sample = set.rays.iter().step_by(stride).copied().collect();
    let expected = Expected::new(&oracle, set.kind.question(), sample, &|_| ());
    let disagreements = structures
        .iter()
        .map(|structure| expected.disagreements(*structure).len())
        .sum();
    let counters: Vec<_> = structures
        .iter()
        .map(|structure| measure::count(*structure, set).0)
        .collect();
    let times = frame.times(&structures, settings.rounds);
    let methods: Vec<&Method> = built.methods.iter().collect();
    let section = Section {
        heading: format!("{}, {} triangles", scene.name, scene.triangles.len()),
        tables: vec![
            tables::performance(&scene.name, &methods, &counters, &times),
            tables::node_types(&scene.name, &methods),
            tables::carving_levels(&scene.name, &methods),
            tables::conversion(&built),
        ],
        notes: tables::notes(&frame, settings),
        charts: tables::figure_10(&methods, &times),
        pictures: Vec::new(),
    };
    Ok(Found {
        section,
        verified: expected.len() * structures.len(),
        disagreements,
    })
}
