//! `compare`: structures side by side.

mod cells;
mod files;
mod pictures;

use std::time::Instant;

use accel_core::DynStructure;
use anyhow::Context;

use super::arguments::CompareOptions;
use super::{
    build, interrupt, load, prepare_folder, ray_finder, ray_kinds, ray_source, with_threads,
};
use crate::measure::{self, Timings};
use crate::rays::RaySet;
use crate::registry::{self, Row, Structure};
use crate::report::model::{Pictures, Report, Spread, Verified};
use crate::scene::Scene;
use crate::{environment, progress, verification};

/// The scenes compared when none is asked for.
const DEFAULT_SCENES: [&str; 3] = ["colonnade-45", "room", "stadium"];

/// Rays of each kind that are compared with brute force before a row counts.
const SAMPLE: usize = 2000;

/// A structure is built again in every round while that takes less than this
/// many seconds in all.
const BUILD_SECONDS: f64 = 2.0;

/// Compares, prints, writes; false if a structure disagreed with brute force.
pub(super) fn run(options: &CompareOptions) -> anyhow::Result<bool> {
    let rows = registry::select(&options.structures).map_err(anyhow::Error::msg)?;
    let names: Vec<String> = if options.scenes.is_empty() {
        DEFAULT_SCENES.map(str::to_owned).to_vec()
    } else {
        options.scenes.clone()
    };
    let (report, pictures) = with_threads(options.scene.threads, || {
        let mut report = Report::new(environment::describe(
            rayon::current_num_threads(),
            options.scene.seed,
        ));
        let mut pictures = Pictures::default();
        // All of them first: a name that is wrong should not cost the others' work.
        let scenes = names.iter().map(|name| load(name, &options.scene));
        let scenes = scenes.collect::<anyhow::Result<Vec<Scene>>>()?;
        prepare_folder(&options.report)?;
        for scene in scenes {
            if interrupt::is_requested() {
                break;
            }
            let outcome = compare_scene(&scene, &rows, options, &mut report, &mut pictures);
            // Ctrl-C cancels a build; what is done by then is reported.
            if !interrupt::is_requested() {
                outcome?;
            }
        }
        Ok((report, pictures))
    })?;
    files::present(&report, &pictures, options)?;
    Ok(report.disagreements() == 0)
}

/// One scene with every row: build, verify, time, count, draw.
fn compare_scene(
    scene: &Scene,
    rows: &[&Row],
    options: &CompareOptions,
    report: &mut Report,
    pictures: &mut Pictures,
) -> anyhow::Result<()> {
    let invalid = options.scene.invalid();
    let finder = ray_finder(scene, invalid)?;
    let sets: Vec<RaySet> = ray_source(scene, &finder, options.size, options.scene.seed)
        .map(|source| {
            let kinds = ray_kinds(&options.rays).into_iter();
            kinds
                .map(|kind| source.rays(kind).in_tiles(options.size.0))
                .collect()
        })
        .unwrap_or_default();
    let built = build_rounds(scene, rows, options)?;
    let structures: Vec<&dyn DynStructure> = built
        .iter()
        .map(|(structure, _)| structure.as_ref())
        .collect();
    let verified = verify_samples(scene, &structures, &sets, options)?;
    let timings = time(scene, rows, &structures, &sets, options.rounds);
    for (position, row) in rows.iter().enumerate() {
        let (structure, build_seconds) = &built[position];
        let rays = sets
            .iter()
            .enumerate()
            .map(|(set, rays)| {
                cells::ray_row(
                    structure.as_ref(),
                    rays,
                    &timings[position][set],
                    verified[position][set],
                )
            })
            .collect();
        report
            .cells
            .push(cells::cell(scene, row, structure, *build_seconds, rays));
    }
    pictures::draw(scene, rows, &structures, options, pictures);
    Ok(())
}

/// Builds every row, in rounds, and tells the median seconds of each.
fn build_rounds(
    scene: &Scene,
    rows: &[&Row],
    options: &CompareOptions,
) -> anyhow::Result<Vec<(Structure, f64)>> {
    let mut built: Vec<(Option<Structure>, Vec<f64>)> =
        rows.iter().map(|_| (None, Vec::new())).collect();
    for _ in 0..options.rounds {
        for (row, (structure, seconds)) in rows.iter().zip(&mut built) {
            if seconds.iter().sum::<f64>() > BUILD_SECONDS {
                continue;
            }
            let start = Instant::now();
            *structure = Some(build(row, scene, options.scene.invalid())?);
            seconds.push(start.elapsed().as_secs_f64());
        }
    }
    let done = built.into_iter().map(|(structure, seconds)| {
        let structure = structure.context("at least one round builds every row")?;
        Ok((structure, Spread::of(&seconds).median))
    });
    done.collect()
}

/// Compares a sample of every ray set with brute force: by structure and set.
fn verify_samples(
    scene: &Scene,
    structures: &[&dyn DynStructure],
    sets: &[RaySet],
    options: &CompareOptions,
) -> anyhow::Result<Vec<Vec<Verified>>> {
    let oracle = registry::oracle(&scene.triangles, options.scene.invalid())?;
    let bar = progress::bar(&format!("{}: verifying", scene.name), sets.len() as u64);
    let mut verified = vec![Vec::new(); structures.len()];
    for set in sets {
        let stride = set.rays.len().div_ceil(SAMPLE).max(1);
        let sample = set.rays.iter().step_by(stride).copied().collect();
        let expected = verification::Expected::new(&oracle, set.kind.question(), sample, &|_| ());
        for (structure, verified) in structures.iter().zip(&mut verified) {
            verified.push(Verified {
                rays: expected.len(),
                disagreements: expected.disagreements(*structure).len(),
            });
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(verified)
}

/// Packets are timed on coherent rays alone.
fn time(
    scene: &Scene,
    rows: &[&Row],
    structures: &[&dyn DynStructure],
    sets: &[RaySet],
    rounds: usize,
) -> Vec<Vec<Timings>> {
    let steps = (structures.len() * sets.len() * rounds) as u64;
    let bar = progress::bar(&format!("{}: timing", scene.name), steps);
    let timings = measure::time_rounds(
        structures,
        sets,
        rounds,
        |structure, set| !rows[structure].is_packet() || sets[set].kind.is_coherent(),
        || bar.inc(1),
    );
    bar.finish_and_clear();
    timings
}

#[cfg(test)]
mod tests {
    #[test]
    fn default_scenes_are_embedded() {
        for name in super::DEFAULT_SCENES {
            assert!(crate::scene::embedded::find(name).is_some(), "{name}");
        }
    }
}
