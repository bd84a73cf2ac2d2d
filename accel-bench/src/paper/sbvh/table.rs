//! Table 1.

use super::methods::{self, Method};
use super::pixels::{PixelRays, Speeds, Work};
use super::published::{self, Published};
use super::{SOURCE, Settings};
use crate::report::document::{DocumentTable, Figure, TableRow};
use crate::report::model::{MeanMax, Spread};
use crate::scene::Scene;

const HEADINGS: [&str; 14] = [
    "method",
    "refer-\nences",
    "nodes",
    "SAH\ncost",
    "of\nBVH",
    "intersections\navg / max",
    "of\nBVH",
    "traversals\navg / max",
    "of\nBVH",
    "overlap",
    "spatial\nsplits",
    "speed\nprimary",
    "speed\nambient",
    "build\nms",
];

/// Our figures, and the published ones below them if there are any.
pub(super) fn of_methods(
    scene: &Scene,
    methods: &[&Method],
    work: &[Work],
    speeds: &[Speeds],
) -> DocumentTable {
    let plain = methods.len() - 1;
    let measured = methods.iter().zip(work).zip(speeds);
    let mut rows: Vec<TableRow> = measured
        .map(|((method, work_of), speed)| TableRow {
            is_published: false,
            figures: measured_row(method, work_of, speed, methods[plain], &work[plain]),
        })
        .collect();
    let mut caption = format!(
        "Table 1, the SBVH with at most {} % references",
        100.0 * methods::LIMIT
    );
    if let Some((published, relation)) = published::find(scene) {
        caption += &format!("; in italics {} of {SOURCE}, {relation}", published.name);
        let base = &published.rows[3];
        rows.extend(published.rows.iter().map(|row| TableRow {
            is_published: true,
            figures: published_row(row, base),
        }));
    }
    DocumentTable {
        caption,
        headings: HEADINGS.to_vec(),
        rows,
    }
}

fn measured_row(
    method: &Method,
    work: &Work,
    speeds: &Speeds,
    plain: &Method,
    plain_work: &Work,
) -> Vec<Figure> {
    let (tree, plain_tree) = (&method.statistics, &plain.statistics);
    let triangles = plain.references.max(1) as f64;
    let percent_of = |own: f64, base: f64| {
        if base > 0.0 {
            Figure::number(100.0 * own / base, 0, " %")
        } else {
            Figure::None
        }
    };
    let mean_max = |figure: MeanMax| Figure::MeanMax {
        mean: figure.mean,
        max: figure.max,
    };
    vec![
        Figure::Text(method.name.to_owned()),
        Figure::number(100.0 * tree.references as f64 / triangles, 1, " %"),
        Figure::count(tree.nodes()),
        Figure::number(tree.sah_cost, 2, ""),
        percent_of(tree.sah_cost, plain_tree.sah_cost),
        mean_max(work.intersections),
        percent_of(work.intersections.mean, plain_work.intersections.mean),
        mean_max(work.traversals),
        percent_of(work.traversals.mean, plain_work.traversals.mean),
        percent_of(tree.overlap, plain_tree.overlap),
        method
            .splits
            .map_or(Figure::None, |splits| Figure::count(splits.spatial_splits)),
        Figure::Percent(speeds.primary),
        Figure::Percent(speeds.ambient),
        Figure::number(1e3 * method.build_seconds, 1, ""),
    ]
}

fn published_row(row: &Published, base: &Published) -> Vec<Figure> {
    let optional = |value: Option<f64>, decimals, unit| {
        value.map_or(Figure::None, |value| Figure::number(value, decimals, unit))
    };
    let ratio = |own: Option<f64>, base: Option<f64>| {
        optional(own.zip(base).map(|(own, base)| 100.0 * own / base), 0, " %")
    };
    let mean_max = |figure: Option<(f64, u64)>| {
        figure.map_or(Figure::None, |(mean, max)| Figure::MeanMax { mean, max })
    };
    let mean = |figure: Option<(f64, u64)>| figure.map(|(mean, _)| mean);
    vec![
        Figure::Text(format!("{}, published", row.method)),
        Figure::number(row.references, 0, " %"),
        row.nodes.map_or(Figure::None, Figure::count),
        optional(row.sah_cost, 1, ""),
        ratio(row.sah_cost, base.sah_cost),
        mean_max(row.intersections),
        ratio(mean(row.intersections), mean(base.intersections)),
        mean_max(row.traversals),
        ratio(mean(row.traversals), mean(base.traversals)),
        optional(row.overlap, 0, " %"),
        row.spatial_splits.map_or(Figure::None, Figure::count),
        optional(row.speed.map(|speed| speed[0]), 0, " %"),
        optional(row.speed.map(|speed| speed[1]), 0, " %"),
        Figure::None,
    ]
}

/// What a reader must know of the table.
pub(super) fn notes(methods: &[&Method], rays: &PixelRays, settings: &Settings) -> Vec<String> {
    let mut notes = vec![
        format!(
            "Intersections and traversals (inner nodes, each with two box tests) are per pixel: a \
             primary ray and four cosine-distributed ambient occlusion rays of at most {} scene \
             diagonals, over {} viewpoints of {}x{} pixels, of which {:.0} % show something. The \
             paper does not state the length of its rays.",
            settings.ambient_length,
            settings.viewpoints,
            settings.size.0,
            settings.size.1,
            rays.coverage()
        ),
        format!(
            "Speeds are relative to the BVH in the same round: medians of {} rounds, in brackets \
             {}. Both trees have the 52/4-byte layout; the paper's speeds are a GPU's. SAH costs are \
             for C_t = C_i = 1, which the paper does not state: compare ratios.",
            settings.rounds,
            Spread::interval_of(settings.rounds)
        ),
    ];
    notes.extend(methods.iter().filter_map(|method| note_of(method)));
    notes
}

fn note_of(method: &Method) -> Option<String> {
    let name = method.name;
    if let Some(splits) = method.splits {
        return Some(format!(
            "{name}: {} nodes attempted a spatial split, {} were split, {} references were unsplit. \
             The limit of {} % references, which the paper does not have, refused {} splits.",
            splits.spatial_split_attempts,
            splits.spatial_splits,
            splits.unsplits,
            100.0 * methods::LIMIT,
            splits.refused_splits
        ));
    }
    let (parts, in_leaves) = (method.references, method.statistics.references);
    (parts != in_leaves).then(|| {
        format!(
            "{name}: the threshold, matched to the SBVH's references, makes {parts}, over which the \
             tree is built; {in_leaves} are left in leaves without duplicates, and in the table."
        )
    })
}
