//! Table 2: what rays do.

use accel_core::{DynStructure, TraversalCounters};

use super::frames::Frame;
use super::methods::{Method, Way};
use super::published::{self, PublishedScene, PublishedWork};
use super::unconfirmed::mismatches;
use crate::measure;
use crate::rays::Question;
use crate::report::document::{DocumentTable, Figure, TableRow};

/// A row for every frame and method of single rays, the published ones below each
/// frame.
pub(super) fn table(scene: &str, methods: &[Method], frames: &[Frame]) -> DocumentTable {
    let published = published::find(scene);
    let single = || {
        let ways = [Way::Single, Way::Unconfirmed];
        methods
            .iter()
            .filter(move |method| ways.contains(&method.way))
    };
    let mut rows = Vec::new();
    for frame in frames {
        for method in single() {
            rows.extend(measured(method, methods[0].structure.as_ref(), frame));
        }
        let quoted = published.and_then(|published| work_of(published, frame.name));
        rows.extend(
            quoted
                .into_iter()
                .flat_map(|work| quoted_rows(frame.name, work)),
        );
    }
    let mut caption = "Table 2: per ray".to_owned();
    if let Some(published) = published {
        caption = format!(
            "{caption}; in italics {} of {}",
            published.name,
            super::SOURCE
        );
    }
    DocumentTable {
        caption,
        headings: ["rays", "method"]
            .into_iter()
            .chain(PER_RAY_HEADINGS)
            .chain(["otherwise\nanswered"])
            .collect(),
        rows,
    }
}

/// Over the figures of [`per_ray`].
pub(super) const PER_RAY_HEADINGS: [&str; 6] = [
    "standard\ntests",
    "traversal-\nbased tests",
    "BSP\nnodes",
    "kd-tree\nnodes",
    "both",
    "leaves",
];

/// Nothing for hits that are not confirmed where all hits are asked for.
fn measured(method: &Method, exact: &dyn DynStructure, frame: &Frame) -> Option<TableRow> {
    let is_closest = frame.set.kind.question() == Question::Closest;
    let is_unconfirmed = method.way == Way::Unconfirmed;
    if is_unconfirmed && !is_closest {
        return None;
    }
    let structure = method.structure.as_ref();
    let (counters, _) = measure::count(structure, &frame.set);
    let mut figures = vec![
        Figure::Text(frame.name.to_owned()),
        Figure::Text(method.name.to_owned()),
    ];
    figures.extend(per_ray(&counters));
    figures.push(if is_unconfirmed {
        let count = mismatches(structure, exact, &frame.set.rays);
        Figure::Text(format!("{count} of {}", frame.set.rays.len()))
    } else {
        Figure::None
    });
    Some(TableRow {
        is_published: false,
        figures,
    })
}

/// Standard and traversal-based tests, nodes of both kinds and their sum, leaves.
pub(super) fn per_ray(counters: &TraversalCounters) -> [Figure; 6] {
    let inner = counters.nodes.sum - counters.leaves.sum;
    // A plane test that is neither of an inner node nor of the scene's box is of a
    // leaf's one triangle.
    let of_leaves = counters.plane_tests.sum - inner - 6 * counters.box_tests.sum;
    let mean =
        |sum: u64, decimals| Figure::number(sum as f64 / counters.rays.max(1) as f64, decimals, "");
    [
        mean(counters.primitive_tests.sum, 3),
        mean(of_leaves, 3),
        mean(counters.general_nodes.sum, 2),
        mean(inner - counters.general_nodes.sum, 2),
        mean(inner, 2),
        mean(counters.leaves.sum, 2),
    ]
}

fn work_of(published: &PublishedScene, frame: &str) -> Option<PublishedWork> {
    match frame {
        "ray cast" => Some(published.ray_cast_work),
        "path traced" => published.path_traced_work,
        _ => None,
    }
}

fn quoted_rows(frame: &'static str, work: PublishedWork) -> impl Iterator<Item = TableRow> {
    let names = ["BSP-orig", "BSP", "kd-tree"];
    names.into_iter().zip(work).map(move |(name, figures)| {
        let [standard, traversal_based, general, axis_aligned] = figures;
        TableRow {
            is_published: true,
            figures: vec![
                Figure::Text(frame.to_owned()),
                Figure::Text(format!("{name}, published")),
                Figure::number(standard, 2, ""),
                Figure::number(traversal_based, 2, ""),
                Figure::number(general, 1, ""),
                Figure::number(axis_aligned, 1, ""),
                Figure::number(general + axis_aligned, 1, ""),
                Figure::None,
                Figure::None,
            ],
        }
    })
}
