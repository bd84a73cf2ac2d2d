//! `paper`: a paper's tables, measured again.

use std::fs::{self, File};
use std::io::{BufWriter, IsTerminal, Write};

use anyhow::Context;

use super::arguments::{Paper, PaperOptions};
use super::{interrupt, load, with_threads};
use crate::paper::{Found, bsp, dual_split, sbvh};
use crate::report::document::{self, Document};
use crate::report::table::TableStyle;
use crate::scene::Scene;
use crate::{environment, progress};

/// Measures, prints, writes; false if a structure disagreed with brute force.
pub(super) fn run(options: &PaperOptions) -> anyhow::Result<bool> {
    anyhow::ensure!(options.rounds > 0, "--rounds must be at least 1");
    anyhow::ensure!(options.viewpoints > 0, "--viewpoints must be at least 1");
    anyhow::ensure!(
        options.ambient_length > 0.0,
        "--ambient-length must be above 0"
    );
    let document = with_threads(options.scene.threads, || match options.paper {
        Paper::Sbvh => of_sbvh(options),
        Paper::DualSplit => of_dual_split(options),
        Paper::Bsp => of_bsp(options),
    })?;
    present(&document, options)?;
    Ok(document.disagreements == 0)
}

fn of_sbvh(options: &PaperOptions) -> anyhow::Result<Document> {
    let settings = sbvh::Settings {
        size: options.size,
        viewpoints: options.viewpoints,
        ambient_length: options.ambient_length,
        rounds: options.rounds,
        seed: options.scene.seed,
        invalid: options.scene.invalid(),
    };
    let title = "Spatial splits in bounding volume hierarchies";
    document(title, sbvh::SOURCE, &sbvh::SCENES, options, |scene| {
        sbvh::measure(scene, &settings)
    })
}

fn of_dual_split(options: &PaperOptions) -> anyhow::Result<Document> {
    let settings = dual_split::Settings {
        size: options.size,
        rounds: options.rounds,
        seed: options.scene.seed,
        invalid: options.scene.invalid(),
    };
    let (source, scenes) = (dual_split::SOURCE, &dual_split::SCENES);
    document("Dual-split trees", source, scenes, options, |scene| {
        dual_split::measure(scene, &settings)
    })
}

fn of_bsp(options: &PaperOptions) -> anyhow::Result<Document> {
    let settings = bsp::Settings {
        size: options.size,
        rounds: options.rounds,
        seed: options.scene.seed,
        invalid: options.scene.invalid(),
    };
    let (source, scenes) = (bsp::SOURCE, &bsp::SCENES);
    document("The BSP tree", source, scenes, options, |scene| {
        bsp::measure(scene, &settings)
    })
}

/// A section for every scene asked for, or for those of the paper.
fn document(
    title: &str,
    source: &str,
    default_scenes: &[&str],
    options: &PaperOptions,
    measure: impl Fn(&Scene) -> anyhow::Result<Found>,
) -> anyhow::Result<Document> {
    let threads = rayon::current_num_threads();
    let mut document = Document {
        schema: document::SCHEMA,
        title: title.to_owned(),
        source: source.to_owned(),
        environment: environment::describe(threads, options.scene.seed),
        sections: Vec::new(),
        disagreements: 0,
        verified: 0,
    };
    let names: Vec<String> = if options.scenes.is_empty() {
        default_scenes.iter().copied().map(str::to_owned).collect()
    } else {
        options.scenes.clone()
    };
    // All of them first: a name that is wrong should not cost the others' work.
    let scenes = names.iter().map(|name| load(name, &options.scene));
    for scene in scenes.collect::<anyhow::Result<Vec<_>>>()? {
        if interrupt::is_requested() {
            break;
        }
        let bar = progress::bar(&format!("{}: measuring", scene.name), 1);
        let found = measure(&scene).with_context(|| format!("measuring {}", scene.name))?;
        bar.finish_and_clear();
        document.sections.push(found.section);
        document.verified += found.verified;
        document.disagreements += found.disagreements;
    }
    Ok(document)
}

fn present(document: &Document, options: &PaperOptions) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    let style = TableStyle::for_output(std::io::stdout().is_terminal());
    document::print(document, &mut out, style)?;
    let folder = &options.report;
    fs::create_dir_all(folder)
        .with_context(|| format!("making the folder {}", folder.display()))?;
    let page = folder.join("index.html");
    let context = || format!("writing {}", page.display());
    let mut file = BufWriter::new(File::create(&page).with_context(context)?);
    document::write_html(document, &mut file).with_context(context)?;
    file.flush().with_context(context)?;
    let json = folder.join("report.json");
    let context = || format!("writing {}", json.display());
    let file = File::create(&json).with_context(context)?;
    serde_json::to_writer_pretty(BufWriter::new(file), document).with_context(context)?;
    writeln!(out, "Report: {}", page.display())?;
    Ok(())
}
