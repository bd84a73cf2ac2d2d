//! The report as one HTML file that needs nothing else.

mod charts;
mod pictures;

use std::io::Write;

use minijinja::{AutoEscape, Environment, context};
use serde::Serialize;

use super::model::{Cell, Pictures, Report};
use charts::Chart;
use pictures::SceneMaps;

pub(super) use pictures::data_uri;

/// How pages look, in light and in dark.
pub(super) const STYLE: &str = include_str!("style.css");

/// Why there is no HTML.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HtmlError {
    /// The template could not be filled in.
    #[error("filling in the report: {0}")]
    Template(#[from] minijinja::Error),
    /// A picture could not be encoded.
    #[error("encoding a picture: {0}")]
    Picture(#[from] ::png::EncodingError),
    /// The file could not be written.
    #[error(transparent)]
    Io(#[from] std::io::Error),
}

/// What the template shows of a scene.
#[derive(Serialize)]
struct SceneView<'a> {
    name: &'a str,
    triangles: usize,
    cells: Vec<&'a Cell>,
    notes: Vec<(&'a str, &'a str)>,
    charts: Vec<Chart>,
    maps: Option<SceneMaps>,
}

/// Writes `report` with its pictures.
///
/// # Errors
/// [`HtmlError`].
pub fn write_html(
    report: &Report,
    pictures: &Pictures,
    out: &mut impl Write,
) -> Result<(), HtmlError> {
    let mut environment = Environment::new();
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    environment.add_filter("thousands", thousands);
    environment.add_filter("fixed", fixed);
    environment.add_template("report", include_str!("report.html.jinja"))?;
    let scenes = report
        .scenes()
        .into_iter()
        .map(|scene| view(report, scene, pictures))
        .collect::<Result<Vec<_>, _>>()?;
    let structures: Vec<&str> = scenes
        .first()
        .map(|scene| {
            scene
                .cells
                .iter()
                .map(|cell| cell.structure.as_str())
                .collect()
        })
        .unwrap_or_default();
    let verified: usize = report
        .cells
        .iter()
        .flat_map(|cell| &cell.rays)
        .map(|row| row.verified.rays)
        .sum();
    let page = environment.get_template("report")?.render(context! {
        style => STYLE,
        environment => report.environment,
        scenes => scenes,
        structures => structures,
        verified => verified,
        disagreements => report.disagreements(),
    })?;
    out.write_all(page.as_bytes())?;
    Ok(())
}

fn view<'a>(
    report: &'a Report,
    scene: &'a str,
    pictures: &Pictures,
) -> Result<SceneView<'a>, HtmlError> {
    let cells: Vec<&Cell> = report.cells_of(scene).collect();
    let rows = cells
        .first()
        .map(|cell| cell.rays.as_slice())
        .unwrap_or_default();
    let notes = rows
        .iter()
        .filter_map(|row| Some((row.kind.as_str(), row.note.as_deref()?)));
    Ok(SceneView {
        name: scene,
        triangles: cells.first().map_or(0, |cell| cell.triangles),
        notes: notes.collect(),
        charts: charts::of_scene(&cells),
        maps: pictures::of_scene(scene, pictures)?,
        cells,
    })
}

/// A whole number in groups of three digits.
fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut grouped = String::new();
    for (position, digit) in digits.chars().enumerate() {
        if position > 0 && (digits.len() - position).is_multiple_of(3) {
            grouped.push('\u{202f}');
        }
        grouped.push(digit);
    }
    grouped
}

/// A number with this many decimals.
fn fixed(number: f64, decimals: usize) -> String {
    format!("{number:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_numbers_are_grouped() {
        assert_eq!(thousands(999), "999");
        assert_eq!(thousands(1_234_567), "1\u{202f}234\u{202f}567");
    }
}
