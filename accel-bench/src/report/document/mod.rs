//! Reports of free form: sections with tables and line charts.

mod html;
mod terminal;

use serde::Serialize;

use super::model::{Environment, Spread};

pub use html::write_html;
pub use terminal::print;

/// The name of this form of JSON.
pub const SCHEMA: &str = "accel-bench-document/1";

/// A report of free form.
#[derive(Clone, Debug, Serialize)]
pub struct Document {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// What it is about.
    pub title: String,
    /// What the published figures are quoted from.
    pub source: String,
    /// What the figures depend on.
    pub environment: Environment,
    /// Its parts.
    pub sections: Vec<Section>,
    /// Rays that structures answered differently from brute force.
    pub disagreements: usize,
    /// Rays compared with brute force.
    pub verified: usize,
}

/// A part of a document.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Section {
    /// Its heading.
    pub heading: String,
    /// What a reader must know of the figures, a paragraph each.
    pub notes: Vec<String>,
    /// Tables.
    pub tables: Vec<DocumentTable>,
    /// Charts.
    pub charts: Vec<LineChart>,
    /// Pictures, side by side; for the page alone.
    #[serde(skip)]
    pub pictures: Vec<Picture>,
}

/// A picture.
#[derive(Clone, Debug)]
pub struct Picture {
    /// What it shows.
    pub caption: String,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Three bytes a pixel, row by row from the top.
    pub rgb: Vec<u8>,
}

/// A table.
#[derive(Clone, Debug, Serialize)]
pub struct DocumentTable {
    /// What it shows.
    pub caption: String,
    /// A heading per column, of one or two lines.
    pub headings: Vec<&'static str>,
    /// The rows.
    pub rows: Vec<TableRow>,
}

/// A row of a table.
#[derive(Clone, Debug, Serialize)]
pub struct TableRow {
    /// Whether its figures are quoted, not measured.
    pub is_published: bool,
    /// A figure per column.
    pub figures: Vec<Figure>,
}

/// What stands in a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Figure {
    /// Words.
    Text(String),
    /// A number, shown with so many decimals and a unit behind it.
    Number {
        /// The number.
        value: f64,
        /// Decimals shown.
        decimals: usize,
        /// What stands behind it.
        unit: &'static str,
    },
    /// Mean and maximum.
    MeanMax {
        /// The mean.
        mean: f64,
        /// The maximum.
        max: u64,
    },
    /// A ratio in percent with the interval that holds it.
    Percent(Spread),
    /// Nothing to tell.
    None,
}

/// Lines over a row of labels, each with a scale of its own.
#[derive(Clone, Debug, Serialize)]
pub struct LineChart {
    /// What it shows.
    pub title: String,
    /// What the labels are.
    pub label: String,
    /// From left to right.
    pub labels: Vec<String>,
    /// The lines; the first is scaled on the left, the second on the right.
    pub series: Vec<Series>,
}

/// A line.
#[derive(Clone, Debug, Serialize)]
pub struct Series {
    /// What it shows, with its unit.
    pub name: String,
    /// A value per label.
    pub values: Vec<f64>,
}

impl Figure {
    /// A whole number.
    pub fn count(value: usize) -> Self {
        Self::number(value as f64, 0, "")
    }

    /// A number with decimals and unit.
    pub fn number(value: f64, decimals: usize, unit: &'static str) -> Self {
        Self::Number {
            value,
            decimals,
            unit,
        }
    }

    /// As printed.
    pub fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number {
                value,
                decimals,
                unit,
            } => format!("{value:.decimals$}{unit}"),
            Self::MeanMax { mean, max } => format!("{mean:.1} / {max}"),
            Self::Percent(spread) => format!(
                "{:.0} % [{:.0}, {:.0}]",
                100.0 * spread.median,
                100.0 * spread.min,
                100.0 * spread.max
            ),
            Self::None => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_printed_with_their_decimals_and_units() {
        assert_eq!(Figure::number(1.25, 1, " %").text(), "1.2 %");
        assert_eq!(Figure::count(12).text(), "12");
        assert_eq!(Figure::MeanMax { mean: 3.04, max: 9 }.text(), "3.0 / 9");
        let spread = Spread {
            median: 1.5,
            min: 1.25,
            max: 2.0,
        };
        assert_eq!(Figure::Percent(spread).text(), "150 % [125, 200]");
    }
}
