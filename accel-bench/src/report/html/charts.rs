//! Bar charts: lengths in percent of the chart's width, from zero.

use serde::Serialize;

use crate::report::model::{Cell, Spread};

/// Bars that share an axis.
#[derive(Debug, PartialEq, Serialize)]
pub(super) struct Chart {
    title: String,
    unit: &'static str,
    groups: Vec<Group>,
}

/// Bars of all structures for one thing.
#[derive(Debug, PartialEq, Serialize)]
struct Group {
    label: String,
    bars: Vec<Bar>,
}

#[derive(Debug, PartialEq, Serialize)]
struct Bar {
    structure: String,
    /// Of the structure, for its colour.
    position: usize,
    /// Percent of the chart's width.
    length: f64,
    /// The whisker's left end and its length, in percent.
    whisker: Option<(f64, f64)>,
    value: String,
}

/// The charts of a scene: speed, and what trees cost.
pub(super) fn of_scene(cells: &[&Cell]) -> Vec<Chart> {
    vec![speed(cells), trees(cells)]
}

fn speed(cells: &[&Cell]) -> Chart {
    let rows = || cells.iter().flat_map(|cell| &cell.rays);
    let spreads = rows().filter_map(|row| row.mrays_per_second);
    let longest = spreads.map(|spread| spread.max).fold(0.0, f64::max);
    let kinds = cells
        .first()
        .map(|cell| cell.rays.as_slice())
        .unwrap_or_default();
    let groups = kinds.iter().enumerate().map(|(position, row)| Group {
        label: row.kind.clone(),
        bars: cells
            .iter()
            .enumerate()
            .map(|(structure, cell)| {
                let spread = cell.rays.get(position).and_then(|row| row.mrays_per_second);
                speed_bar(&cell.structure, structure, spread, longest)
            })
            .collect(),
    });
    Chart {
        title: "Speed".to_owned(),
        unit: "million rays per second; the line runs from the slowest to the fastest round",
        groups: groups.collect(),
    }
}

fn speed_bar(structure: &str, position: usize, spread: Option<Spread>, longest: f64) -> Bar {
    let percent = |value: f64| {
        if longest > 0.0 {
            value / longest * 100.0
        } else {
            0.0
        }
    };
    let length = spread.map_or(0.0, |spread| percent(spread.median));
    Bar {
        structure: structure.to_owned(),
        position,
        length,
        whisker: spread.map(|spread| (percent(spread.min), percent(spread.max - spread.min))),
        value: spread.map_or_else(
            || "withheld".to_owned(),
            |spread| format!("{:.2}", spread.median),
        ),
    }
}

fn trees(cells: &[&Cell]) -> Chart {
    let group = |label: &str, value: fn(&Cell) -> f64, decimals: usize| {
        let longest = cells.iter().map(|cell| value(cell)).fold(0.0, f64::max);
        let bars = cells.iter().enumerate().map(|(position, cell)| Bar {
            structure: cell.structure.clone(),
            position,
            length: if longest > 0.0 {
                value(cell) / longest * 100.0
            } else {
                0.0
            },
            whisker: None,
            value: format!("{:.decimals$}", value(cell)),
        });
        Group {
            label: label.to_owned(),
            bars: bars.collect(),
        }
    };
    Chart {
        title: "Trees".to_owned(),
        unit: "each group on a scale of its own; shorter is better",
        groups: vec![
            group("build, ms", |cell| cell.build_seconds * 1e3, 1),
            group(
                "nodes and references, MB",
                |cell| (cell.bytes.nodes + cell.bytes.references) as f64 * 1e-6,
                2,
            ),
            group("SAH cost", |cell| cell.statistics.sah_cost, 2),
        ],
    }
}
