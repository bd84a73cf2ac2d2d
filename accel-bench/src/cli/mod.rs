//! The command line.

mod arguments;
mod compare;
pub mod interrupt;
mod paper;
mod render;
mod scenes;
mod verify;

use std::fs::{self, File};
use std::path::Path;
use std::process::ExitCode;

use accel_core::InvalidPrimitives;
use anyhow::Context;
use clap::Parser;

use crate::rays::{RayKind, RaySource};
use crate::registry::{self, Row, Structure};
use crate::scene::Scene;
use arguments::{Arguments, Command, SceneOptions};

/// Ends a run in which everything agreed.
const SUCCESS: u8 = 0;
/// Ends a run in which a structure disagreed with brute force.
const DISAGREEMENT: u8 = 1;
/// Ends a run that could not be done as asked.
const FAILURE: u8 = 2;

/// A report's page, in its folder.
const PAGE: &str = "index.html";

/// Runs the command of this process' arguments.
#[expect(clippy::print_stderr, reason = "this is where errors reach the user")]
pub fn run() -> ExitCode {
    interrupt::listen();
    let arguments = Arguments::parse();
    let command = arguments
        .command
        .unwrap_or(Command::Compare(arguments.compare));
    let outcome = match command {
        Command::Compare(options) => compare::run(&options),
        Command::Verify(options) => verify::run(&options),
        Command::Render(options) => render::run(&options),
        Command::Paper(options) => paper::run(&options),
        Command::Scenes(options) => scenes::run(&options),
    };
    match outcome {
        Ok(true) => ExitCode::from(SUCCESS),
        Ok(false) => ExitCode::from(DISAGREEMENT),
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(FAILURE)
        }
    }
}

/// Runs `work` with as many threads as asked for; 0 stands for all.
fn with_threads<T: Send>(
    threads: usize,
    work: impl FnOnce() -> anyhow::Result<T> + Send,
) -> anyhow::Result<T> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .with_context(|| format!("starting {threads} threads"))?;
    pool.install(work)
}

/// Loads a scene, tells what was odd about it, and puts the camera in place.
#[expect(
    clippy::print_stderr,
    reason = "notes on the input go beside the results"
)]
fn load(name: &str, options: &SceneOptions) -> anyhow::Result<Scene> {
    let mut scene = Scene::load(name)?;
    if !scene.faults.is_empty() {
        eprintln!("{}: {}", scene.name, scene.faults.trim_end());
    }
    if let Some(camera) = options.camera {
        scene.camera = camera;
    }
    if let Some(rotation) = options.rotate {
        scene.rotate(rotation);
    }
    // Only now: turning may take corners out of the range of f32.
    let skipped = scene.count_skipped(options.invalid())?;
    if skipped > 0 {
        eprintln!(
            "{}: left out {skipped} triangles with corners that are not finite",
            scene.name
        );
    }
    Ok(scene)
}

/// Makes the folder of a report and tries to write into it: before anything is
/// measured, which may take hours.
fn prepare_folder(folder: &Path) -> anyhow::Result<()> {
    fs::create_dir_all(folder)
        .with_context(|| format!("making the folder {}", folder.display()))?;
    let page = folder.join(PAGE);
    // Appending keeps the page of an earlier run until there is a new one.
    let mut options = File::options();
    options.append(true).create(true);
    options
        .open(&page)
        .with_context(|| format!("writing {}", page.display()))?;
    Ok(())
}

/// Builds one row over a scene, showing progress.
fn build(row: &Row, scene: &Scene, invalid: InvalidPrimitives) -> anyhow::Result<Structure> {
    let progress = crate::progress::BuildProgress::new(row.name);
    row.build(&scene.triangles, invalid, &progress)
        .with_context(|| format!("building {} over {}", row.name, scene.name))
}

/// The structure that finds the points from which secondary rays start.
fn ray_finder(scene: &Scene, invalid: InvalidPrimitives) -> anyhow::Result<Structure> {
    let rows = registry::select(&["bvh-binned".to_owned()]).map_err(anyhow::Error::msg)?;
    build(rows[0], scene, invalid)
}

/// What the rays of a scene are made from; `None` for a scene without anything
/// to hit.
fn ray_source<'a>(
    scene: &'a Scene,
    finder: &'a Structure,
    size: (u32, u32),
    seed: u64,
) -> Option<RaySource<'a>> {
    Some(RaySource {
        structure: finder.as_ref(),
        triangles: &scene.triangles,
        camera: scene.camera,
        size,
        bounds: finder.scene_bounds()?,
        ambient_length: RaySource::AMBIENT_LENGTH,
        seed,
    })
}

/// The ray kinds of a list, or the default ones.
fn ray_kinds(kinds: &[RayKind]) -> Vec<RayKind> {
    if kinds.is_empty() {
        RayKind::DEFAULT.to_vec()
    } else {
        kinds.to_vec()
    }
}
