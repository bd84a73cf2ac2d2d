//! Reports as tables for a terminal.

use std::io::{self, Write};

use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{Attribute, Cell as TableCell, CellAlignment, Color, ContentArrangement, Table};

use super::model::{Cell, RayRow, Report};

/// How tables look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TableStyle {
    /// Whether to use colours and bold type.
    pub is_coloured: bool,
}

impl TableStyle {
    /// Colours where a person watches.
    pub fn for_output(is_terminal: bool) -> Self {
        Self {
            is_coloured: is_terminal,
        }
    }
}

/// A column of figures: a heading of at most two lines, and what it shows.
struct Column {
    heading: &'static str,
    text: fn(&Cell) -> String,
    /// The figure to compare, and whether small is good; none for columns
    /// without a best.
    value: Option<fn(&Cell) -> f64>,
}

const BUILD_COLUMNS: &[Column] = &[
    Column {
        heading: "build\nms",
        text: |cell| format!("{:.1}", cell.build_seconds * 1e3),
        value: Some(|cell| cell.build_seconds),
    },
    Column {
        heading: "nodes\nMB",
        text: |cell| megabytes(cell.bytes.nodes),
        value: Some(|cell| cell.bytes.nodes as f64),
    },
    Column {
        heading: "references\nMB",
        text: |cell| megabytes(cell.bytes.references),
        value: None,
    },
    Column {
        heading: "triangles\nMB",
        text: |cell| megabytes(cell.bytes.primitives),
        value: None,
    },
    Column {
        heading: "nodes",
        text: |cell| cell.statistics.nodes.to_string(),
        value: None,
    },
    Column {
        heading: "tris/\nleaf",
        text: |cell| format!("{:.2}", cell.statistics.mean_leaf_size),
        value: None,
    },
    Column {
        heading: "depth",
        text: |cell| cell.statistics.depth.to_string(),
        value: None,
    },
    Column {
        heading: "SAH\ncost",
        text: |cell| format!("{:.2}", cell.statistics.sah_cost),
        value: Some(|cell| cell.statistics.sah_cost),
    },
    Column {
        heading: "overlap",
        text: |cell| format!("{:.2}", cell.statistics.overlap),
        value: None,
    },
    Column {
        heading: "EPO",
        text: |cell| {
            cell.statistics
                .epo
                .map_or_else(|| "-".to_owned(), |epo| format!("{epo:.2}"))
        },
        value: None,
    },
];

/// Prints all scenes: a table of trees and a table of rays each.
///
/// # Errors
/// What `out` answers.
pub fn print(report: &Report, out: &mut impl Write, style: TableStyle) -> io::Result<()> {
    let environment = &report.environment;
    writeln!(
        out,
        "{}, {} thread{}, seed {}; rates are medians of rounds, lowest to highest in brackets",
        environment.cpu.as_deref().unwrap_or("unknown processor"),
        environment.threads,
        if environment.threads == 1 { "" } else { "s" },
        environment.seed
    )?;
    for scene in report.scenes() {
        let cells: Vec<&Cell> = report.cells_of(scene).collect();
        writeln!(out, "\n{scene}: {} triangles", cells[0].triangles)?;
        writeln!(out, "{}", build_table(&cells, style))?;
        let rays = ray_table(&cells, style);
        if rays.row_iter().next().is_some() {
            writeln!(out, "{rays}")?;
        }
        for row in &cells[0].rays {
            if let Some(note) = &row.note {
                writeln!(out, "{}: {note}", row.kind)?;
            }
        }
    }
    writeln!(out)?;
    match report.disagreements() {
        0 => writeln!(
            out,
            "All rows equal brute force, bit for bit, on the rays compared."
        ),
        count => writeln!(
            out,
            "{count} rays DISAGREE with brute force; see the tables."
        ),
    }
}

fn new_table(headings: Vec<TableCell>) -> Table {
    let mut table = Table::new();
    table.load_preset(UTF8_FULL_CONDENSED);
    table.set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(headings);
    table
}

fn build_table(cells: &[&Cell], style: TableStyle) -> Table {
    let headings = BUILD_COLUMNS.iter().map(|column| right(column.heading));
    let mut table = new_table(
        std::iter::once(TableCell::new("structure"))
            .chain(headings)
            .collect(),
    );
    for cell in cells {
        let figures = BUILD_COLUMNS.iter().map(|column| {
            let is_best = column.value.is_some_and(|value| {
                cells.iter().all(|other| value(cell) <= value(other)) && cells.len() > 1
            });
            emphasised(right((column.text)(cell)), is_best, style)
        });
        table.add_row(std::iter::once(TableCell::new(&cell.structure)).chain(figures));
    }
    table
}

fn ray_table(cells: &[&Cell], style: TableStyle) -> Table {
    let headings = [
        "Mrays/s",
        "nodes\nmean (max)",
        "boxes\nmean",
        "planes\nmean",
        "triangles\nmean (max)",
        "hits",
        "verified",
    ];
    let names = ["rays", "structure"].map(TableCell::new);
    let mut table = new_table(names.into_iter().chain(headings.map(right)).collect());
    for kind in 0..cells.first().map_or(0, |cell| cell.rays.len()) {
        let fastest = cells
            .iter()
            .filter_map(|cell| cell.rays[kind].mrays_per_second)
            .map(|spread| spread.median)
            .fold(0.0, f64::max);
        let mut name = cells
            .first()
            .map_or("", |cell| cell.rays[kind].kind.as_str());
        for cell in cells {
            let row = &cell.rays[kind];
            let is_untimed = row.mrays_per_second.is_none() && row.count > 0;
            if is_untimed && row.verified.disagreements == 0 {
                continue;
            }
            let name = std::mem::take(&mut name);
            table.add_row([
                TableCell::new(name),
                TableCell::new(&cell.structure),
                rate(row, fastest, cells.len(), style),
                right(format!(
                    "{:.1} ({})",
                    row.nodes_per_ray.mean, row.nodes_per_ray.max
                )),
                right(format!("{:.1}", row.box_tests_per_ray.mean)),
                right(format!("{:.1}", row.plane_tests_per_ray.mean)),
                right(format!(
                    "{:.2} ({})",
                    row.primitive_tests_per_ray.mean, row.primitive_tests_per_ray.max
                )),
                right(percent(row.hits, row.count)),
                verified(row, style),
            ]);
        }
    }
    table
}

fn rate(row: &RayRow, fastest: f64, rows: usize, style: TableStyle) -> TableCell {
    match &row.mrays_per_second {
        None => right("-"),
        Some(spread) => {
            let text = format!(
                "{:.2} [{:.2}, {:.2}]",
                spread.median, spread.min, spread.max
            );
            emphasised(right(text), rows > 1 && spread.median >= fastest, style)
        }
    }
}

fn verified(row: &RayRow, style: TableStyle) -> TableCell {
    let (rays, disagreements) = (row.verified.rays, row.verified.disagreements);
    if disagreements == 0 {
        return right(format!("{rays} equal"));
    }
    let cell = right(format!("{disagreements} of {rays} DIFFER"));
    if style.is_coloured {
        cell.fg(Color::Red).add_attribute(Attribute::Bold)
    } else {
        cell
    }
}

fn right(text: impl Into<String>) -> TableCell {
    TableCell::new(text.into()).set_alignment(CellAlignment::Right)
}

fn emphasised(cell: TableCell, is_best: bool, style: TableStyle) -> TableCell {
    if is_best && style.is_coloured {
        cell.add_attribute(Attribute::Bold)
    } else {
        cell
    }
}

fn megabytes(bytes: usize) -> String {
    format!("{:.2}", bytes as f64 * 1e-6)
}

fn percent(part: usize, whole: usize) -> String {
    if whole == 0 {
        "-".to_owned()
    } else {
        format!("{:.0} %", part as f64 / whole as f64 * 100.0)
    }
}
