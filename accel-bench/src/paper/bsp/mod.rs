//! Ize, Wald and Parker, *Ray Tracing with the BSP Tree*, 2008: Tables 1 to 3, Figure
//! 3, the sweep of C_i of section 5.1, one of the epsilon of section 3.2, and the hot
//! spot of section 5.2.

mod figure_3;
mod frames;
mod hot_spot;
mod methods;
mod published;
mod shapes;
mod speeds;
mod sweep;
mod tuning;
mod unconfirmed;
mod work;

use accel_bsp::BspBuilder;
use accel_core::{DynStructure, InvalidPrimitives};

use super::Found;
use crate::registry;
use crate::report::document::Section;
use crate::report::model::Spread;
use crate::scene::Scene;
use crate::verification::Expected;
use frames::{Frame, Frames};
use methods::{Built, Method, Way};
use speeds::Speeds;
use tuning::BspTuning;

/// Where the published figures stand.
pub const SOURCE: &str = "Ize, Wald and Parker 2008, Tables 1 to 3";

/// Embedded scenes that stand for the paper's: its own cylinder, pipes for its power
/// plant, a room for its conference room.
pub const SCENES: [&str; 3] = ["cylinder", "pipes@6000", "room@6000"];

/// Rays of each frame that are compared with brute force.
const SAMPLE: usize = 2000;

/// How to measure.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Pixels of each frame, across and down.
    pub size: (u32, u32),
    /// Rounds of timing.
    pub rounds: usize,
    /// Seed of everything random.
    pub seed: u64,
    /// What to do with triangles without finite corners.
    pub invalid: InvalidPrimitives,
}

/// Measures one scene.
///
/// # Errors
/// What the builders answer.
pub fn measure(scene: &Scene, settings: &Settings) -> anyhow::Result<Found> {
    let cast = frames::ray_cast(scene, settings);
    let built = methods::build_all(&scene.triangles, settings.invalid, &cast.rays)?;
    let methods = &built.methods;
    let kd_tree = methods[0].structure.as_ref();
    let frames = Frames::new(scene, kd_tree, settings);
    let oracle = registry::oracle(&scene.triangles, settings.invalid)?;
    let expected = frames.frames.iter().map(|frame| expected(frame, &oracle));
    let expected: Vec<Expected> = expected.collect();
    let (mut verified, mut disagreements) = verify(methods, &expected);
    let speeds = Speeds::new(methods, &frames.frames, settings);
    let mut section = Section {
        heading: format!("{}, {} triangles", scene.name, scene.triangles.len()),
        tables: vec![
            speeds.table(&scene.name, methods, &frames.frames),
            work::table(&scene.name, methods, &frames.frames),
            shapes::table(&scene.name, &built.facts),
        ],
        notes: notes(&built, &frames, settings),
        ..Section::default()
    };
    for sweep in &sweep::SWEEPS {
        if scene.triangles.len() > sweep.most_triangles {
            section.notes.push(format!(
                "{} was not swept: the scene has more than {} triangles.",
                sweep.name, sweep.most_triangles
            ));
            continue;
        }
        let found = sweep.run(&scene.triangles, &cast, &expected[0], settings, &built)?;
        section.tables.push(found.table);
        section.charts.push(found.chart);
        verified += found.verified;
        disagreements += found.disagreements;
    }
    let (_, bsp_tri) = built.bsp_tri();
    let pictures = figure_3::pictures(kd_tree, bsp_tri, scene.camera, settings.size);
    section.pictures.extend(pictures);
    Ok(Found {
        section,
        verified,
        disagreements,
    })
}

/// Compares a sample of every frame's rays with brute force, for all methods that
/// promise to agree: how many were compared, and how many answered differently.
fn verify(methods: &[Method], frames: &[Expected]) -> (usize, usize) {
    let (mut verified, mut disagreements) = (0, 0);
    for expected in frames {
        let exact = methods
            .iter()
            .filter(|method| method.way != Way::Unconfirmed);
        for method in exact {
            verified += expected.len();
            disagreements += expected.disagreements(method.structure.as_ref()).len();
        }
    }
    (verified, disagreements)
}

/// Brute force's answers to a sample of a frame's rays.
fn expected(frame: &Frame, oracle: &dyn DynStructure) -> Expected {
    // Whole packets, or they would not be packets.
    const PACKET: usize = 16;
    let set = &frame.set;
    let packets = set.rays.chunks(PACKET);
    let stride = packets.len().div_ceil(SAMPLE / PACKET).max(1);
    let sample = packets.step_by(stride).flatten().copied().collect();
    Expected::new(oracle, set.kind.question(), sample, &|_| ())
}

/// What a reader must know of the tables.
fn notes(built: &Built, frames: &Frames, settings: &Settings) -> Vec<String> {
    let rays = |frame: &Frame| format!("{}: {} rays", frame.name, frame.set.rays.len());
    let counts: Vec<String> = frames.frames.iter().map(rays).collect();
    let kd_tree = &built.tuned_kd_tree;
    let (traversal_cost, empty_bonus) = kd_tree.setting;
    let tried = kd_tree.tried.iter();
    let kd_trees: Vec<String> = tried
        .map(|((cost, bonus), speed)| format!("{cost:.0}/{bonus} {speed:.3}"))
        .collect();
    let untuned = BspTuning::of(&BspBuilder::with_planar_leaves());
    let bsp_tri = &built.tuned_bsp_tri;
    let tried = bsp_tri.tried.iter();
    let bsp_trees: Vec<String> = tried
        .map(|(tuning, speed)| format!("{tuning} {speed:.3}"))
        .collect();
    let mut notes = vec![
        format!(
            "Frames of {}x{} pixels ({}). Speeds are relative to single rays through the kd-tree in \
             the same round: medians of {} rounds, in brackets {}. Rays are recorded and traced \
             again, so that times hold traversal alone; the paper's hold shading too.",
            settings.size.0,
            settings.size.1,
            counts.join(", "),
            settings.rounds,
            Spread::interval_of(settings.rounds)
        ),
        format!(
            "The kd-tree is swept, with K_T {traversal_cost:.0} for a K_I of 20 and an empty-space bonus \
             of {empty_bonus}: the fastest on the camera's rays of K_T/bonus (Mrays/s) {}. BSP-tri tuned \
             has C_i/C_BSP/alpha/tangents {} instead of {untuned}: the fastest of {}.",
            kd_trees.join(", "),
            bsp_tri.setting,
            bsp_trees.join(", ")
        ),
        "BSP-tri confirms every hit with the kernel: it counts a traversal-based test where a leaf's \
         triangle is ruled out or let through by its plane, and a standard test where it is let \
         through. BSP-tri unconfirmed is the paper's; its hits that differ are counted. Packets are \
         of 8 rays."
            .to_owned(),
    ];
    if let Some(spot) = &frames.hot_spot {
        let camera = &spot.camera;
        notes.push(format!(
            "Hot spot: the eighth of the picture over which the kd-tree does {:.1} times its mean; \
             camera \"{},{},{};{},{},{};{}\".",
            spot.times_the_mean,
            camera.eye.x,
            camera.eye.y,
            camera.eye.z,
            camera.look_at.x,
            camera.look_at.y,
            camera.look_at.z,
            camera.vertical_fov_degrees
        ));
    }
    notes
}
