//! Documents on a terminal.

use std::io::{self, Write};

use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{Attribute, Cell, CellAlignment, ContentArrangement, Table};

use super::{Document, DocumentTable, Figure, TableRow};
use crate::report::table::TableStyle;

/// Prints a document; charts are left to its files.
///
/// # Errors
/// What `out` answers.
pub fn print(document: &Document, out: &mut impl Write, style: TableStyle) -> io::Result<()> {
    let environment = &document.environment;
    writeln!(out, "{}", document.title)?;
    writeln!(
        out,
        "{}, {} thread{}, seed {}",
        environment.cpu.as_deref().unwrap_or("unknown processor"),
        environment.threads,
        if environment.threads == 1 { "" } else { "s" },
        environment.seed
    )?;
    for section in &document.sections {
        writeln!(out, "\n{}", section.heading)?;
        for table in &section.tables {
            writeln!(out, "{}", table.caption)?;
            writeln!(out, "{}", drawn(table, style))?;
        }
        for note in &section.notes {
            writeln!(out, "{note}")?;
        }
    }
    match document.disagreements {
        0 => writeln!(
            out,
            "\nAll structures equal brute force, bit for bit, on the {} rays compared.",
            document.verified
        ),
        count => writeln!(out, "\n{count} rays DISAGREE with brute force."),
    }
}

fn drawn(table: &DocumentTable, style: TableStyle) -> Table {
    let mut drawn = Table::new();
    drawn.load_preset(UTF8_FULL_CONDENSED);
    drawn.set_content_arrangement(ContentArrangement::Disabled);
    drawn.set_header(table.headings.iter().map(Cell::new));
    for row in &table.rows {
        drawn.add_row(row.figures.iter().map(|figure| cell(figure, row, style)));
    }
    drawn
}

fn cell(figure: &Figure, row: &TableRow, style: TableStyle) -> Cell {
    let cell = Cell::new(figure.text());
    let cell = match figure {
        Figure::Text(_) => cell,
        _ => cell.set_alignment(CellAlignment::Right),
    };
    if row.is_published && style.is_coloured {
        cell.add_attribute(Attribute::Italic)
    } else {
        cell
    }
}
