//! `compare`: structures side by side.

use std::fs::{self, File};
use std::io::{BufWriter, IsTerminal, Write};
use std::path::Path;

use accel_core::statistics::end_point_overlap;
use accel_core::{DynStructure, SurfaceAreaHeuristic};
use anyhow::Context;

use super::arguments::CompareOptions;
use super::{build, interrupt, load, ray_finder, ray_kinds, ray_source, with_threads};
use crate::measure::{self, Timings};
use crate::progress;
use crate::rays::RaySet;
use crate::registry::{self, Row, Structure};
use crate::report::model::{
    Bytes, Cell, HeatMap, MeanMax, Pictures, Quantity, RayRow, Report, Shaded, Spread, Statistics,
    Verified,
};
use crate::report::{csv, html, json, table};
use crate::scene::Scene;
use crate::{environment, verification};

/// The scenes compared when none is asked for.
const DEFAULT_SCENES: [&str; 3] = ["colonnade-45", "room", "stadium"];

/// Rays of each kind that are compared with brute force before a row counts.
const SAMPLE: usize = 2000;

/// A structure is built again in every round while that takes less than this
/// many seconds in all.
const BUILD_SECONDS: f64 = 2.0;

/// A picture's width, in pixels, at most: pictures are for looking at.
const PICTURE_WIDTH: u32 = 480;

/// Compares, prints, writes; false if a structure disagreed with brute force.
pub(super) fn run(options: &CompareOptions) -> anyhow::Result<bool> {
    anyhow::ensure!(options.rounds > 0, "--rounds must be at least 1");
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
        for scene in scenes.collect::<anyhow::Result<Vec<Scene>>>()? {
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
    present(&report, &pictures, options)?;
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
            kinds.map(|kind| source.rays(kind)).collect()
        })
        .unwrap_or_default();
    let built = build_rounds(scene, rows, options)?;
    let structures: Vec<&dyn DynStructure> = built
        .iter()
        .map(|(structure, _)| structure.as_ref())
        .collect();
    let verified = verify_samples(scene, &structures, &sets, options)?;
    let timings = time(scene, &structures, &sets, options.rounds);
    for (position, row) in rows.iter().enumerate() {
        let (structure, build_seconds) = &built[position];
        let rays = sets
            .iter()
            .enumerate()
            .map(|(set, rays)| {
                ray_row(
                    structure.as_ref(),
                    rays,
                    &timings[position][set],
                    verified[position][set],
                )
            })
            .collect();
        report
            .cells
            .push(cell(scene, row, structure, *build_seconds, rays));
    }
    draw(scene, rows, &structures, options, pictures);
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
            let start = std::time::Instant::now();
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

fn time(
    scene: &Scene,
    structures: &[&dyn DynStructure],
    sets: &[RaySet],
    rounds: usize,
) -> Vec<Vec<Timings>> {
    let steps = (structures.len() * sets.len() * rounds) as u64;
    let bar = progress::bar(&format!("{}: timing", scene.name), steps);
    let timings = measure::time_rounds(structures, sets, rounds, || bar.inc(1));
    bar.finish_and_clear();
    timings
}

fn ray_row(
    structure: &dyn DynStructure,
    set: &RaySet,
    timings: &Timings,
    verified: Verified,
) -> RayRow {
    let (counters, hits) = measure::count(structure, set);
    let mean_max = |count: &accel_core::statistics::Count| MeanMax {
        mean: counters.mean(count),
        max: count.max,
    };
    RayRow {
        kind: set.kind.name().to_owned(),
        count: set.rays.len(),
        note: set.note.clone(),
        // A structure that gives other answers has no speed.
        mrays_per_second: (verified.disagreements == 0 && !set.rays.is_empty())
            .then(|| Spread::of(&timings.mrays_per_second)),
        nodes_per_ray: mean_max(&counters.nodes),
        box_tests_per_ray: mean_max(&counters.box_tests),
        plane_tests_per_ray: mean_max(&counters.plane_tests),
        primitive_tests_per_ray: mean_max(&counters.primitive_tests),
        hits,
        verified,
    }
}

fn cell(
    scene: &Scene,
    row: &Row,
    structure: &Structure,
    build_seconds: f64,
    rays: Vec<RayRow>,
) -> Cell {
    let heuristic = (row.heuristic)();
    let bytes = structure.bytes_by_part();
    Cell {
        scene: scene.name.clone(),
        triangles: scene.triangles.len(),
        structure: row.name.to_owned(),
        settings: row.settings.to_owned(),
        build_seconds,
        bytes: Bytes {
            nodes: bytes.nodes,
            references: bytes.references,
            primitives: bytes.primitives,
            total: bytes.total(),
        },
        statistics: statistics(scene, structure, &heuristic),
        rays,
    }
}

fn statistics(
    scene: &Scene,
    structure: &Structure,
    heuristic: &SurfaceAreaHeuristic,
) -> Statistics {
    let outline = structure.tree_outline();
    let tree = accel_core::TreeStatistics::of(&outline, heuristic);
    Statistics {
        nodes: tree.nodes(),
        leaves: tree.leaves,
        references: tree.references,
        mean_leaf_size: tree.mean_leaf_size(),
        depth: tree.depth,
        sah_cost: tree.sah_cost,
        overlap: tree.overlap,
        epo: Some(end_point_overlap(&outline, &scene.triangles, heuristic)),
    }
}

/// Heat maps of the primary rays, and the scene itself.
fn draw(
    scene: &Scene,
    rows: &[&Row],
    structures: &[&dyn DynStructure],
    options: &CompareOptions,
    pictures: &mut Pictures,
) {
    let (width, height) = picture_size(options.size);
    let rays = scene.camera.rays(width, height);
    for (row, structure) in rows.iter().zip(structures) {
        let counters = measure::count_pixels(*structure, &rays);
        let quantities = [Quantity::NodeVisits, Quantity::PrimitiveTests];
        for quantity in quantities {
            let value = |counters: &accel_core::TraversalCounters| match quantity {
                Quantity::NodeVisits => counters.nodes.sum as u32,
                Quantity::PrimitiveTests => counters.primitive_tests.sum as u32,
            };
            pictures.heat_maps.push(HeatMap {
                scene: scene.name.clone(),
                structure: row.name.to_owned(),
                quantity,
                width,
                height,
                values: counters.iter().map(value).collect(),
            });
        }
    }
    if let Some(structure) = structures.first() {
        pictures.shaded.push(Shaded {
            scene: scene.name.clone(),
            width,
            height,
            rgb: super::render::shaded(scene, *structure, &rays),
        });
    }
}

fn picture_size((width, height): (u32, u32)) -> (u32, u32) {
    let picture_width = width.clamp(1, PICTURE_WIDTH);
    let picture_height = (u64::from(height) * u64::from(picture_width) / u64::from(width)).max(1);
    (picture_width, picture_height as u32)
}

/// Prints the tables and writes the files.
fn present(report: &Report, pictures: &Pictures, options: &CompareOptions) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    let style = table::TableStyle::for_output(std::io::stdout().is_terminal());
    table::print(report, &mut out, style)?;
    let folder = &options.report;
    fs::create_dir_all(folder)
        .with_context(|| format!("making the folder {}", folder.display()))?;
    let page = folder.join("index.html");
    write(&page, |out| Ok(html::write_html(report, pictures, out)?))?;
    write(&folder.join("report.json"), |out| {
        Ok(json::write(report, out)?)
    })?;
    write(&folder.join("report.csv"), |out| {
        Ok(csv::write(report, out)?)
    })?;
    if let Some(path) = &options.json {
        write(path, |out| Ok(json::write(report, out)?))?;
    }
    if let Some(path) = &options.csv {
        write(path, |out| Ok(csv::write(report, out)?))?;
    }
    writeln!(out, "Report: {}", page.display())?;
    Ok(())
}

fn write(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let file = File::create(path).with_context(|| format!("writing {}", path.display()))?;
    let mut out = BufWriter::new(file);
    content(&mut out)
        .and_then(|()| Ok(out.flush()?))
        .with_context(|| format!("writing {}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_keep_their_shape() {
        assert_eq!(picture_size((256, 192)), (256, 192));
        assert_eq!(picture_size((1920, 1080)), (480, 270));
        assert_eq!(picture_size((16_384, 1)), (480, 1));
    }

    #[test]
    fn default_scenes_are_embedded() {
        for name in DEFAULT_SCENES {
            assert!(crate::scene::embedded::find(name).is_some(), "{name}");
        }
    }
}
