//! The sweep of C_i, the cost of testing a triangle (section 5.1): larger ones split
//! more, for fewer tests and more nodes.

use accel_bsp::{BspBuilder, BspCosts};
use accel_core::{BuildError, DynStructure, TraversalCounters, Triangle};

use super::Settings;
use super::methods::{Built, TreeFacts, of_bsp, timed};
use super::work::per_ray;
use crate::measure;
use crate::rays::RaySet;
use crate::report::document::{DocumentTable, Figure, LineChart, Series, TableRow};
use crate::report::model::Spread;

/// In costs of an axis-aligned node; the default among them.
const COSTS: [f64; 4] = [1.0, 2.0, 4.0, 16.0];

/// The one that the others are compared with.
const DEFAULT: usize = 2;

/// Scenes of more triangles are not swept: every cost is a build.
pub(super) const MOST_TRIANGLES: usize = 100_000;

/// A tree and what rays do in it.
struct Swept<'a> {
    facts: &'a TreeFacts,
    counters: TraversalCounters,
    /// Against the tree of the default cost, round by round.
    speed: Spread,
}

/// A table and a chart of BSP-tri by C_i, on the rays of the camera; that of the
/// default is built.
///
/// # Errors
/// As the builder.
pub(super) fn of_costs(
    triangles: &[Triangle],
    rays: &RaySet,
    settings: &Settings,
    built: &Built,
) -> Result<(DocumentTable, LineChart), BuildError> {
    let mut costs = COSTS.to_vec();
    costs.remove(DEFAULT);
    let others = costs.into_iter().map(|intersection| {
        let builder = BspBuilder {
            costs: BspCosts {
                intersection,
                ..BspCosts::default()
            },
            invalid_primitives: settings.invalid,
            ..BspBuilder::with_planar_leaves()
        };
        let (seconds, tree) = timed(|| builder.build(triangles))?;
        Ok((of_bsp("BSP-tri", &tree, seconds), tree))
    });
    let others = others.collect::<Result<Vec<_>, BuildError>>()?;
    let others = others.iter();
    let mut trees: Vec<(&TreeFacts, &dyn DynStructure)> =
        others.map(|(facts, tree)| (facts, tree as _)).collect();
    trees.insert(DEFAULT, built.bsp_tri());
    let swept = measured(&trees, rays, settings.rounds);
    Ok((table(&swept), chart(&swept)))
}

/// Timed in the same rounds, and counted.
fn measured<'a>(
    trees: &[(&'a TreeFacts, &dyn DynStructure)],
    rays: &RaySet,
    rounds: usize,
) -> Vec<Swept<'a>> {
    let structures: Vec<_> = trees.iter().map(|(_, tree)| *tree).collect();
    let sets = std::slice::from_ref(rays);
    let timings = measure::time_rounds(&structures, sets, rounds, |_, _| true, || ());
    let speed = |tree: usize| {
        let of = |tree: usize| timings[tree][0].mrays_per_second.iter();
        let ratios = of(tree).zip(of(DEFAULT)).map(|(own, base)| own / base);
        Spread::with_confidence(&ratios.collect::<Vec<f64>>())
    };
    let trees = trees.iter().enumerate();
    trees
        .map(|(position, (facts, tree))| Swept {
            facts,
            counters: measure::count(*tree, rays).0,
            speed: speed(position),
        })
        .collect()
}

fn table(swept: &[Swept<'_>]) -> DocumentTable {
    let rows = COSTS.iter().zip(swept).map(|(cost, tree)| {
        let mut figures = vec![
            Figure::number(*cost, 0, ""),
            Figure::number(tree.facts.build_seconds, 2, ""),
            Figure::count(tree.facts.nodes()),
            Figure::number(tree.facts.single_percentage(), 1, " %"),
        ];
        figures.extend(per_ray(&tree.counters));
        figures.push(Figure::Percent(tree.speed));
        TableRow {
            is_published: false,
            figures,
        }
    });
    DocumentTable {
        caption: "C_i, the cost of testing a triangle (section 5.1): BSP-tri, ray cast".to_owned(),
        headings: vec![
            "C_i",
            "build\nseconds",
            "nodes",
            "leaves\nof one",
            "standard\ntests",
            "traversal-\nbased tests",
            "BSP\nnodes",
            "kd-tree\nnodes",
            "both",
            "leaves",
            "speed,\nof C_i = 4",
        ],
        rows: rows.collect(),
    }
}

fn chart(swept: &[Swept<'_>]) -> LineChart {
    let series = |name: &str, value: fn(&TraversalCounters) -> f64| Series {
        name: name.to_owned(),
        values: swept.iter().map(|tree| value(&tree.counters)).collect(),
    };
    let tests = |counters: &TraversalCounters| counters.mean(&counters.primitive_tests);
    let nodes = |counters: &TraversalCounters| counters.mean(&counters.nodes);
    LineChart {
        title: "Triangle tests and nodes per ray against C_i (section 5.1)".to_owned(),
        label: "C_i".to_owned(),
        labels: COSTS.map(|cost| format!("{cost}")).to_vec(),
        series: vec![series("triangle tests", tests), series("nodes", nodes)],
    }
}
