//! Sweeps of two settings of the build: C_i, the cost of testing a triangle (section
//! 5.1), of which larger ones split more, for fewer tests and more nodes; and the
//! epsilon of section 3.2, which must cost quality and speed alone, never a hit.

use accel_bsp::{BspBuilder, BspCosts};
use accel_core::{BuildError, DynStructure, TraversalCounters, Triangle};

use super::Settings;
use super::methods::{Built, TreeFacts, of_bsp, timed};
use super::work::{PER_RAY_HEADINGS, per_ray};
use crate::measure;
use crate::rays::RaySet;
use crate::report::document::{DocumentTable, Figure, LineChart, Series, TableRow};
use crate::report::model::Spread;
use crate::verification::Expected;

/// A setting of BSP-tri that is varied.
pub(super) struct Sweep {
    pub name: &'static str,
    /// Scenes of more triangles are not swept: every value is a build.
    pub most_triangles: usize,
    caption: &'static str,
    values: &'static [f64],
    /// The position of the default, with which the others are compared.
    default: usize,
    builder: fn(f64) -> BspBuilder,
    label: fn(f64) -> String,
    chart_title: &'static str,
    lines: [Line; 2],
}

/// A line of the chart: its name, and what it shows of a tree.
type Line = (&'static str, fn(&Swept<'_>) -> f64);

/// In costs of an axis-aligned node.
const COSTS: Sweep = Sweep {
    name: "C_i",
    most_triangles: 100_000,
    caption: "C_i, the cost of testing a triangle (section 5.1): BSP-tri, ray cast",
    values: &[0.5, 1.0, 2.0, 4.0, 16.0],
    default: 3,
    builder: |intersection| {
        let bsp_tri = BspBuilder::with_planar_leaves();
        BspBuilder {
            costs: BspCosts {
                intersection,
                ..bsp_tri.costs
            },
            ..bsp_tri
        }
    },
    label: |cost| format!("{cost}"),
    chart_title: "Triangle tests and nodes per ray against C_i (section 5.1)",
    lines: [
        ("triangle tests", |tree| {
            tree.counters.mean(&tree.counters.primitive_tests)
        }),
        ("nodes", |tree| tree.counters.mean(&tree.counters.nodes)),
    ],
};

/// In extents of a node.
const EPSILON: Sweep = Sweep {
    name: "epsilon",
    most_triangles: 10_000,
    caption: "Epsilon, by which planes and triangles may miss each other (section 3.2): \
              BSP-tri, ray cast",
    values: &[
        1.0 / (1 << 24) as f64,
        1.0 / (1 << 22) as f64,
        1.0 / (1 << 20) as f64,
        1.0 / (1 << 18) as f64,
        1.0 / (1 << 16) as f64,
        1.0 / (1 << 14) as f64,
    ],
    default: 2,
    builder: |epsilon| BspBuilder {
        epsilon,
        ..BspBuilder::with_planar_leaves()
    },
    label: |epsilon| format!("2^{}", epsilon.log2()),
    chart_title: "Surface area cost and speed against epsilon (section 3.2)",
    lines: [
        ("surface area cost", |tree| tree.facts.surface_area_cost),
        ("speed, % of the default's", |tree| {
            100.0 * tree.speed.median
        }),
    ],
};

/// All sweeps.
pub(super) const SWEEPS: [Sweep; 2] = [COSTS, EPSILON];

/// A tree and what rays do in it.
struct Swept<'a> {
    value: f64,
    facts: &'a TreeFacts,
    counters: TraversalCounters,
    /// Against the tree of the default, round by round.
    speed: Spread,
    /// Rays that brute force answers otherwise.
    disagreements: usize,
}

/// What a sweep has found.
pub(super) struct SweepFindings {
    pub table: DocumentTable,
    pub chart: LineChart,
    /// Rays compared with brute force, over all trees.
    pub verified: usize,
    /// Of these, the ones answered otherwise.
    pub disagreements: usize,
}

impl Sweep {
    /// Builds a tree for every value but the default, which is built, and sends
    /// `rays` through all of them.
    ///
    /// # Errors
    /// As the builder.
    pub(super) fn run(
        &self,
        triangles: &[Triangle],
        rays: &RaySet,
        expected: &Expected,
        settings: &Settings,
        built: &Built,
    ) -> Result<SweepFindings, BuildError> {
        let mut others = Vec::new();
        for &value in self.others() {
            let builder = BspBuilder {
                invalid_primitives: settings.invalid,
                ..(self.builder)(value)
            };
            let (seconds, tree) = timed(|| builder.build(triangles))?;
            others.push((of_bsp("BSP-tri", &tree, seconds), tree));
        }
        let others = others.iter();
        let mut trees: Vec<(&TreeFacts, &dyn DynStructure)> =
            others.map(|(facts, tree)| (facts, tree as _)).collect();
        trees.insert(self.default, built.bsp_tri());
        let swept = self.measured(&trees, rays, expected, settings.rounds);
        Ok(SweepFindings {
            table: self.table(&swept),
            chart: self.chart(&swept),
            verified: swept.len() * expected.len(),
            disagreements: swept.iter().map(|tree| tree.disagreements).sum(),
        })
    }

    fn others(&self) -> impl Iterator<Item = &f64> {
        let values = self.values.iter().enumerate();
        values.filter_map(|(position, value)| (position != self.default).then_some(value))
    }

    /// Timed in the same rounds, counted, and compared with brute force.
    fn measured<'a>(
        &self,
        trees: &[(&'a TreeFacts, &dyn DynStructure)],
        rays: &RaySet,
        expected: &Expected,
        rounds: usize,
    ) -> Vec<Swept<'a>> {
        let structures: Vec<_> = trees.iter().map(|(_, tree)| *tree).collect();
        let sets = std::slice::from_ref(rays);
        let timings = measure::time_rounds(&structures, sets, rounds, |_, _| true, || ());
        let speed = |tree: usize| {
            let of = |tree: usize| timings[tree][0].mrays_per_second.iter();
            let ratios = of(tree).zip(of(self.default)).map(|(own, base)| own / base);
            Spread::with_confidence(&ratios.collect::<Vec<f64>>())
        };
        let trees = self.values.iter().zip(trees).enumerate();
        trees
            .map(|(position, (&value, &(facts, tree)))| Swept {
                value,
                facts,
                counters: measure::count(tree, rays).0,
                speed: speed(position),
                disagreements: expected.disagreements(tree).len(),
            })
            .collect()
    }

    fn table(&self, swept: &[Swept<'_>]) -> DocumentTable {
        let rows = swept.iter().map(|tree| {
            let mut figures = vec![
                Figure::Text((self.label)(tree.value)),
                Figure::number(tree.facts.build_seconds, 2, ""),
                Figure::count(tree.facts.nodes()),
                Figure::number(tree.facts.surface_area_cost, 2, ""),
                Figure::number(tree.facts.single_percentage(), 1, " %"),
            ];
            figures.extend(per_ray(&tree.counters));
            figures.extend([
                Figure::count(tree.disagreements),
                Figure::Percent(tree.speed),
            ]);
            TableRow {
                is_published: false,
                figures,
            }
        });
        DocumentTable {
            caption: self.caption.to_owned(),
            headings: [
                self.name,
                "build\nseconds",
                "nodes",
                "surface\narea cost",
                "leaves\nof one",
            ]
            .into_iter()
            .chain(PER_RAY_HEADINGS)
            .chain(["unlike\nbrute force", "speed, of\nthe default"])
            .collect(),
            rows: rows.collect(),
        }
    }

    fn chart(&self, swept: &[Swept<'_>]) -> LineChart {
        let series = self.lines.iter().map(|(name, value)| Series {
            name: (*name).to_owned(),
            values: swept.iter().map(value).collect(),
        });
        LineChart {
            title: self.chart_title.to_owned(),
            label: self.name.to_owned(),
            labels: swept.iter().map(|tree| (self.label)(tree.value)).collect(),
            series: series.collect(),
        }
    }
}
