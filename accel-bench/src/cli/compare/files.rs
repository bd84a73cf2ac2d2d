//! What a comparison leaves behind: tables on the terminal, files in a folder.

use std::fs::File;
use std::io::{BufWriter, IsTerminal, Write};
use std::path::Path;

use anyhow::Context;

use crate::cli::PAGE;
use crate::cli::arguments::CompareOptions;
use crate::report::model::{Pictures, Report};
use crate::report::{csv, html, json, table};

/// Prints the tables and writes the files.
pub(super) fn present(
    report: &Report,
    pictures: &Pictures,
    options: &CompareOptions,
) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    let style = table::TableStyle::for_output(std::io::stdout().is_terminal());
    table::print(report, &mut out, style)?;
    let folder = &options.report;
    let page = folder.join(PAGE);
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
