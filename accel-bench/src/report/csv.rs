//! Reports as CSV: a line per scene, structure and kind of rays.

use std::io::Write;

use super::model::{Cell, RayRow, Report};

const HEADER: [&str; 30] = [
    "scene",
    "triangles",
    "structure",
    "settings",
    "threads",
    "build_seconds",
    "node_bytes",
    "reference_bytes",
    "primitive_bytes",
    "total_bytes",
    "nodes",
    "leaves",
    "references",
    "depth",
    "sah_cost",
    "overlap",
    "epo",
    "rays",
    "ray_count",
    "mrays_per_second_median",
    "mrays_per_second_min",
    "mrays_per_second_max",
    "nodes_per_ray_mean",
    "box_tests_per_ray_mean",
    "plane_tests_per_ray_mean",
    "primitive_tests_per_ray_mean",
    "primitive_tests_per_ray_max",
    "hits",
    "verified_rays",
    "disagreements",
];

/// Writes `report`, with a header.
///
/// # Errors
/// What `out` answers.
pub fn write(report: &Report, out: &mut impl Write) -> csv::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(HEADER)?;
    for cell in &report.cells {
        for row in &cell.rays {
            writer.write_record(record(report, cell, row))?;
        }
    }
    writer.flush()?;
    Ok(())
}

fn record(report: &Report, cell: &Cell, row: &RayRow) -> [String; 30] {
    let (bytes, tree) = (&cell.bytes, &cell.statistics);
    // No speed is printed where hits disagree.
    let rate = |pick: fn(&super::model::Spread) -> f64| {
        row.mrays_per_second
            .as_ref()
            .map_or_else(String::new, |spread| pick(spread).to_string())
    };
    [
        cell.scene.clone(),
        cell.triangles.to_string(),
        cell.structure.clone(),
        cell.settings.clone(),
        report.environment.threads.to_string(),
        cell.build_seconds.to_string(),
        bytes.nodes.to_string(),
        bytes.references.to_string(),
        bytes.primitives.to_string(),
        bytes.total.to_string(),
        tree.nodes.to_string(),
        tree.leaves.to_string(),
        tree.references.to_string(),
        tree.depth.to_string(),
        tree.sah_cost.to_string(),
        tree.overlap.to_string(),
        tree.epo.map_or_else(String::new, |epo| epo.to_string()),
        row.kind.clone(),
        row.count.to_string(),
        rate(|spread| spread.median),
        rate(|spread| spread.min),
        rate(|spread| spread.max),
        row.nodes_per_ray.mean.to_string(),
        row.box_tests_per_ray.mean.to_string(),
        row.plane_tests_per_ray.mean.to_string(),
        row.primitive_tests_per_ray.mean.to_string(),
        row.primitive_tests_per_ray.max.to_string(),
        row.hits.to_string(),
        row.verified.rays.to_string(),
        row.verified.disagreements.to_string(),
    ]
}
