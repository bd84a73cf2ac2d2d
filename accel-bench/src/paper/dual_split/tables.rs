//! Tables 1, 2 and 3 and Figure 10, published figures below ours.

use accel_core::TraversalCounters;
use accel_dualsplit::NodeStatistics;

use super::frame::Frame;
use super::methods::{Built, Method};
use super::published::{self, PublishedScene, STRUCTURES};
use super::{SOURCE, Settings};
use crate::report::document::{DocumentTable, Figure, LineChart, Series, TableRow};
use crate::report::model::Spread;

const PERFORMANCE_HEADINGS: [&str; 11] = [
    "structure",
    "storage\nMB",
    "of\nBVH",
    "frame time\nof BVH",
    "triangle\ntests / ray",
    "of\nBVH",
    "plane\ntests / ray",
    "of\nBVH",
    "without\nthe root",
    "nodes\n/ ray",
    "of\nBVH",
];

fn percent(own: f64, base: f64) -> Figure {
    if base > 0.0 {
        Figure::number(100.0 * own / base, 1, " %")
    } else {
        Figure::None
    }
}

fn measured(figures: Vec<Figure>) -> TableRow {
    TableRow {
        is_published: false,
        figures,
    }
}

fn quoted(figures: Vec<Figure>) -> TableRow {
    TableRow {
        is_published: true,
        figures,
    }
}

fn caption(table: &str, scene: &str) -> String {
    match published::find(scene) {
        Some(published) => format!("{table}; in italics {} of {SOURCE}", published.name),
        None => format!("{table}; in italics the ranges of {SOURCE}"),
    }
}

/// Table 1.
pub(super) fn performance(
    scene: &str,
    methods: &[&Method],
    counters: &[TraversalCounters],
    times: &[Spread],
) -> DocumentTable {
    let megabytes = |method: &Method| method.structure.bytes_by_part().nodes as f64 / 1e6;
    let mut rows = Vec::new();
    for (position, method) in methods.iter().enumerate() {
        let (own, base) = (&counters[position], &counters[0]);
        let mut figures = vec![
            Figure::Text(method.name.to_owned()),
            Figure::number(megabytes(method), 2, ""),
            percent(megabytes(method), megabytes(methods[0])),
            Figure::Percent(times[position]),
        ];
        let pair = |count: fn(&TraversalCounters) -> f64| {
            let share = percent(count(own), count(base));
            [Figure::number(count(own), 2, ""), share]
        };
        figures.extend(pair(|counters| counters.mean(&counters.primitive_tests)));
        figures.extend(pair(plane_tests));
        let [of_own, of_base] = [own, base].map(|of| plane_tests(of) - PLANES_OF_THE_ROOT);
        figures.push(percent(of_own, of_base));
        figures.extend(pair(|counters| counters.mean(&counters.nodes)));
        rows.push(measured(figures));
    }
    let names = methods.iter().map(|method| method.name);
    rows.extend(names.enumerate().map(|(structure, name)| {
        quoted(match published::find(scene) {
            Some(published) => published_row(name, structure, published),
            None => range_row(name, structure),
        })
    }));
    DocumentTable {
        caption: caption("Table 1", scene),
        headings: PERFORMANCE_HEADINGS.to_vec(),
        rows,
    }
}

/// The box of the root, which every structure tests first.
const PLANES_OF_THE_ROOT: f64 = 6.0;

fn plane_tests(counters: &TraversalCounters) -> f64 {
    counters.mean(&counters.plane_tests)
}

fn published_row(name: &str, structure: usize, scene: &PublishedScene) -> Vec<Figure> {
    let share = |figures: [f64; STRUCTURES]| percent(figures[structure], figures[0]);
    let number = |figures: [f64; STRUCTURES]| Figure::number(figures[structure], 2, "");
    vec![
        Figure::Text(format!("{name}, published")),
        number(scene.storage),
        share(scene.storage),
        share(scene.frame),
        number(scene.triangle_tests),
        share(scene.triangle_tests),
        number(scene.plane_tests),
        share(scene.plane_tests),
        Figure::None,
        number(scene.nodes),
        share(scene.nodes),
    ]
}

fn range_row(name: &str, structure: usize) -> Vec<Figure> {
    let range = |figures: fn(&PublishedScene) -> [f64; STRUCTURES]| {
        let (low, high) = published::range(structure, figures);
        Figure::Text(format!("{low:.0} to {high:.0} %"))
    };
    vec![
        Figure::Text(format!("{name}, published")),
        Figure::None,
        range(|scene| scene.storage),
        range(|scene| scene.frame),
        Figure::None,
        range(|scene| scene.triangle_tests),
        Figure::None,
        range(|scene| scene.plane_tests),
        Figure::None,
        Figure::None,
        range(|scene| scene.nodes),
    ]
}

/// Table 2, with BIH and H-tree besides.
pub(super) fn node_types(scene: &str, methods: &[&Method]) -> DocumentTable {
    let base = methods[0].nodes as f64;
    let mut rows: Vec<TableRow> = methods
        .iter()
        .map(|method| {
            let share = |count: fn(&NodeStatistics) -> usize| {
                method.statistics.map_or(Figure::None, |statistics| {
                    percent(count(&statistics) as f64, method.nodes as f64)
                })
            };
            measured(vec![
                Figure::Text(method.name.to_owned()),
                Figure::count(method.nodes),
                percent(method.nodes as f64, base),
                share(|statistics| statistics.splitting),
                share(NodeStatistics::carving),
                share(|statistics| statistics.plain_leaves),
            ])
        })
        .collect();
    if let Some(published) = published::find(scene) {
        let [of_bvh, counts @ ..] = published.node_counts;
        let trees = published.dual_split.iter().zip(counts);
        for ((tree, count), method) in trees.zip(&methods[1..]) {
            let mut figures = vec![
                Figure::Text(format!("{}, published", method.name)),
                Figure::count(count),
                percent(count as f64, of_bvh as f64),
            ];
            figures.extend(tree.types.map(|share| Figure::number(share, 1, " %")));
            rows.push(quoted(figures));
        }
    }
    DocumentTable {
        caption: caption("Table 2: nodes by type", scene),
        headings: vec![
            "structure",
            "nodes",
            "of\nBVH",
            "splitting",
            "carving",
            "leaves",
        ],
        rows,
    }
}

/// Table 3, with BIH and H-tree besides.
pub(super) fn carving_levels(scene: &str, methods: &[&Method]) -> DocumentTable {
    let of_planes = methods
        .iter()
        .filter_map(|method| Some((method.name, method.statistics?)));
    let mut rows: Vec<TableRow> = of_planes
        .map(|(name, statistics)| {
            let levels = statistics.carving_levels;
            let children: usize = levels.iter().sum();
            let mut figures = vec![Figure::Text(name.to_owned())];
            figures.extend(levels.map(|level| percent(level as f64, children as f64)));
            let carving = statistics.carving() as f64;
            for count in [
                statistics.single_axis_carving,
                statistics.dual_axis_carving,
                statistics.bounding,
            ] {
                figures.push(percent(count as f64, carving));
            }
            measured(figures)
        })
        .collect();
    if let Some(published) = published::find(scene) {
        for (tree, method) in published.dual_split.iter().zip(&methods[1..]) {
            let mut figures = vec![Figure::Text(format!("{}, published", method.name))];
            figures.extend(tree.levels.map(|share| Figure::number(share, 1, " %")));
            figures.extend(tree.axes.map(|share| Figure::number(share, 1, " %")));
            figures.push(Figure::None);
            rows.push(quoted(figures));
        }
    }
    DocumentTable {
        caption: caption("Table 3: carving nodes behind a splitting node", scene),
        headings: vec![
            "structure",
            "none",
            "1",
            "2",
            "3",
            "single-\naxis",
            "dual-\naxis",
            "on several\naxes, H-tree",
        ],
        rows,
    }
}

/// What converting takes, against building the source.
pub(super) fn conversion(built: &Built) -> DocumentTable {
    let rows = built.methods.iter().skip(1).map(|method| {
        let seconds = method.conversion_seconds;
        measured(vec![
            Figure::Text(method.name.to_owned()),
            Figure::number(1e3 * seconds, 1, ""),
            percent(seconds, built.sweep_seconds),
            percent(seconds, built.binned_seconds),
        ])
    });
    DocumentTable {
        caption: format!(
            "Conversion: the BVH takes {:.1} ms to sweep, {:.1} ms to bin",
            1e3 * built.sweep_seconds,
            1e3 * built.binned_seconds
        ),
        headings: vec!["structure", "ms", "of the\nsweep", "of the\nbinned build"],
        rows: rows.collect(),
    }
}

/// Figure 10: storage and frame times side by side.
pub(super) fn figure_10(methods: &[&Method], times: &[Spread]) -> Vec<LineChart> {
    let labels: Vec<String> = methods
        .iter()
        .map(|method| method.name.to_owned())
        .collect();
    let bytes = |method: &Method| method.structure.bytes_by_part().nodes as f64;
    let base = bytes(methods[0]).max(1.0);
    vec![LineChart {
        title: "Storage and frame time against the BVH (Figure 10)".to_owned(),
        label: "structure".to_owned(),
        labels,
        series: vec![
            Series {
                name: "storage in percent".to_owned(),
                values: methods
                    .iter()
                    .map(|method| 100.0 * bytes(method) / base)
                    .collect(),
            },
            Series {
                name: "frame time in percent".to_owned(),
                values: times.iter().map(|time| 100.0 * time.median).collect(),
            },
        ],
    }]
}

/// What a reader must know of the tables.
pub(super) fn notes(frame: &Frame, settings: &Settings) -> Vec<String> {
    let rays = frame.rays().rays.len();
    vec![
        format!(
            "A frame is {} primary rays ({}x{} pixels) and {} diffuse bounces of them, at most \
             five a path, without Russian roulette; single rays, closest hits. Its rays are \
             recorded and traced again, so that times hold traversal alone; the paper's hold \
             shading too.",
            frame.primary,
            settings.size.0,
            settings.size.1,
            rays - frame.primary
        ),
        format!(
            "Frame times are relative to the BVH in the same round, structures in turns of a few \
             thousand rays: medians of {} rounds, in brackets {}. Storage is that of the nodes, \
             without references to triangles. A box test counts six planes, an inner node of the \
             BVH twelve. Plane tests hold the six of the root's box, as the paper's do, which \
             weigh where rays meet few nodes; without the root they are those of nodes alone.",
            settings.rounds,
            Spread::interval_of(settings.rounds)
        ),
    ]
}
