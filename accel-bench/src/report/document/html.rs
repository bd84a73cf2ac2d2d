//! Documents as one HTML file that needs nothing else.

use std::io::Write;

use minijinja::{AutoEscape, Environment, context};
use serde::Serialize;

use super::{Document, LineChart, Section, Series};
use crate::report::html::{HtmlError, STYLE, data_uri};

/// The size of a chart's plot, in its own units.
const PLOT: (f64, f64) = (560.0, 220.0);

/// Lines between the bottom and the top of a plot.
const GRID_LINES: usize = 4;

#[derive(Serialize)]
struct SectionView<'a> {
    heading: &'a str,
    notes: &'a [String],
    tables: Vec<TableView<'a>>,
    charts: Vec<ChartView<'a>>,
    pictures: Vec<PictureView<'a>>,
}

#[derive(Serialize)]
struct PictureView<'a> {
    caption: &'a str,
    width: u32,
    height: u32,
    /// As a data URI.
    image: String,
}

#[derive(Serialize)]
struct TableView<'a> {
    caption: &'a str,
    headings: &'a [&'static str],
    rows: Vec<RowView>,
}

#[derive(Serialize)]
struct RowView {
    is_published: bool,
    figures: Vec<String>,
}

#[derive(Serialize)]
struct ChartView<'a> {
    title: &'a str,
    label: &'a str,
    /// Each with its place from the left.
    labels: Vec<(f64, &'a str)>,
    lines: Vec<LineView<'a>>,
    grid: Vec<f64>,
}

#[derive(Serialize)]
struct LineView<'a> {
    name: &'a str,
    /// As an SVG polyline takes them.
    points: String,
    /// Each with its place from the top.
    scale: Vec<(f64, String)>,
}

/// Writes a document.
///
/// # Errors
/// [`HtmlError`].
pub fn write_html(document: &Document, out: &mut impl Write) -> Result<(), HtmlError> {
    let mut environment = Environment::new();
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    environment.add_template("document", include_str!("document.html.jinja"))?;
    let sections = document.sections.iter().map(section);
    let sections = sections.collect::<Result<Vec<_>, _>>()?;
    let page = environment.get_template("document")?.render(context! {
        style => STYLE,
        document => document,
        sections => sections,
        width => PLOT.0,
        height => PLOT.1,
    })?;
    out.write_all(page.as_bytes())?;
    Ok(())
}

fn section(section: &Section) -> Result<SectionView<'_>, HtmlError> {
    let tables = section.tables.iter().map(|table| TableView {
        caption: &table.caption,
        headings: &table.headings,
        rows: table
            .rows
            .iter()
            .map(|row| RowView {
                is_published: row.is_published,
                figures: row.figures.iter().map(super::Figure::text).collect(),
            })
            .collect(),
    });
    let pictures = section.pictures.iter().map(|picture| {
        Ok(PictureView {
            caption: &picture.caption,
            width: picture.width,
            height: picture.height,
            image: data_uri(picture.width, picture.height, &picture.rgb)?,
        })
    });
    Ok(SectionView {
        heading: &section.heading,
        notes: &section.notes,
        tables: tables.collect(),
        charts: section.charts.iter().map(chart).collect(),
        pictures: pictures.collect::<Result<_, HtmlError>>()?,
    })
}

fn chart(chart: &LineChart) -> ChartView<'_> {
    let places = |count: usize| {
        let steps = count.saturating_sub(1).max(1) as f64;
        (0..count).map(move |i| PLOT.0 * i as f64 / steps)
    };
    let labels = chart.labels.iter().map(String::as_str);
    ChartView {
        title: &chart.title,
        label: &chart.label,
        labels: places(chart.labels.len()).zip(labels).collect(),
        lines: chart
            .series
            .iter()
            .map(|series| line(series, places(series.values.len())))
            .collect(),
        grid: (0..=GRID_LINES)
            .map(|i| PLOT.1 * i as f64 / GRID_LINES as f64)
            .collect(),
    }
}

/// A line scaled so that its values fill the plot from bottom to top.
fn line(series: &Series, places: impl Iterator<Item = f64>) -> LineView<'_> {
    let low = series.values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = series
        .values
        .iter()
        .copied()
        .fold(f64::NEG_INFINITY, f64::max);
    let range = if high > low { high - low } else { 1.0 };
    let points: Vec<String> = places
        .zip(&series.values)
        .map(|(x, value)| format!("{x:.1},{:.1}", PLOT.1 * (1.0 - (value - low) / range)))
        .collect();
    let scale = (0..=GRID_LINES).map(|i| {
        let part = i as f64 / GRID_LINES as f64;
        (PLOT.1 * part, format!("{:.1}", high - range * part))
    });
    LineView {
        name: &series.name,
        points: points.join(" "),
        scale: scale.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_fill_the_plot() {
        let series = Series {
            name: "cost".to_owned(),
            values: vec![3.0, 1.0, 2.0],
        };
        let view = line(&series, [0.0, 280.0, 560.0].into_iter());
        assert_eq!(view.points, "0.0,0.0 280.0,220.0 560.0,110.0");
        assert_eq!(view.scale[0].1, "3.0");
        assert_eq!(view.scale[GRID_LINES].1, "1.0");
        let flat = Series {
            name: "flat".to_owned(),
            values: vec![5.0, 5.0],
        };
        assert!(!line(&flat, [0.0, 1.0].into_iter()).points.contains("NaN"));
    }
}
