//! From measurements to the cells of a report.

use accel_core::statistics::{Count, end_point_overlap};
use accel_core::{DynStructure, SurfaceAreaHeuristic, TreeStatistics};

use crate::measure::{self, Timings};
use crate::rays::RaySet;
use crate::registry::{Row, Structure};
use crate::report::model::{Bytes, Cell, MeanMax, RayRow, Spread, Statistics, Verified};
use crate::scene::Scene;

/// The figures of one kind of rays; counts the traversals for them.
pub(super) fn ray_row(
    structure: &dyn DynStructure,
    set: &RaySet,
    timings: &Timings,
    verified: Verified,
) -> RayRow {
    let (counters, hits) = measure::count(structure, set);
    let mean_max = |count: &Count| MeanMax {
        mean: counters.mean(count),
        max: count.max,
    };
    RayRow {
        kind: set.kind.name().to_owned(),
        count: set.rays.len(),
        note: set.note.clone(),
        // A structure that gives other answers has no speed, nor one that was not
        // timed.
        mrays_per_second: (verified.disagreements == 0
            && !set.rays.is_empty()
            && !timings.mrays_per_second.is_empty())
        .then(|| Spread::of(&timings.mrays_per_second)),
        nodes_per_ray: mean_max(&counters.nodes),
        box_tests_per_ray: mean_max(&counters.box_tests),
        plane_tests_per_ray: mean_max(&counters.plane_tests),
        primitive_tests_per_ray: mean_max(&counters.primitive_tests),
        hits,
        verified,
    }
}

/// The figures of a structure over a scene.
pub(super) fn cell(
    scene: &Scene,
    row: &Row,
    structure: &Structure,
    build_seconds: f64,
    rays: Vec<RayRow>,
) -> Cell {
    let heuristic = (row.heuristic)();
    let bytes = structure.bytes_by_part();
    Cell {
        scene: scene.name.clone(),
        triangles: scene.triangles.len(),
        structure: row.name.to_owned(),
        settings: row.settings.to_owned(),
        build_seconds,
        bytes: Bytes {
            nodes: bytes.nodes,
            references: bytes.references,
            primitives: bytes.primitives,
            total: bytes.total(),
        },
        statistics: statistics(scene, structure, &heuristic),
        rays,
    }
}

fn statistics(
    scene: &Scene,
    structure: &Structure,
    heuristic: &SurfaceAreaHeuristic,
) -> Statistics {
    let outline = structure.tree_outline();
    let tree = TreeStatistics::of(&outline, heuristic);
    Statistics {
        nodes: tree.nodes(),
        leaves: tree.leaves,
        references: tree.references,
        mean_leaf_size: tree.mean_leaf_size(),
        depth: tree.depth,
        sah_cost: tree.sah_cost,
        overlap: tree.overlap,
        epo: Some(end_point_overlap(&outline, &scene.triangles, heuristic)),
    }
}
