//! Reports as JSON.

use std::io::{self, Write};

use super::model::Report;

/// Writes `report` as indented JSON.
///
/// # Errors
/// What `out` answers.
pub fn write(report: &Report, out: &mut impl Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, report)?;
    writeln!(out)
}
