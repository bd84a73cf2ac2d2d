//! Figure 5, and the hard memory limit of section 6.1.

use accel_core::{
    AccelerationStructure, BuildError, InvalidPrimitives, SurfaceAreaHeuristic, Triangle,
};
use accel_sbvh::{ReferenceLimit, SbvhBuilder, Spending, SplitStatistics};

use super::methods;
use crate::report::document::{DocumentTable, Figure, LineChart, Series, TableRow};

/// The values of alpha in Figure 5, and 0.
const ALPHAS: [f64; 10] = [1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 0.0];

/// References per triangle in the sweep over alpha: small values should show what
/// they make.
const ALPHA_LIMIT: f64 = 4.0;

/// References per triangle.
const LIMITS: [f64; 6] = [1.0, 1.05, 1.1, 1.25, 1.5, 2.0];

const SPENDINGS: [(Spending, &str); 3] = [
    (Spending::ByBenefit, "by benefit"),
    (Spending::BreadthFirst, "breadth-first"),
    (Spending::Shares, "in shares"),
];

fn built(
    builder: &SbvhBuilder,
    triangles: &[Triangle],
) -> Result<(f64, SplitStatistics), BuildError> {
    let (tree, splits) = builder.build_with(triangles, &())?;
    let statistics = tree.tree_statistics(&SurfaceAreaHeuristic::default());
    Ok((statistics.sah_cost, splits))
}

/// SAH cost and duplication against alpha.
pub(super) struct Figure5 {
    pub table: DocumentTable,
    pub chart: LineChart,
    /// Where the limit decided instead.
    pub note: String,
}

/// Builds a tree for every alpha.
pub(super) fn alpha(
    triangles: &[Triangle],
    invalid: InvalidPrimitives,
) -> Result<Figure5, BuildError> {
    let results = ALPHAS.map(|alpha| {
        let builder = SbvhBuilder {
            alpha,
            limit: ReferenceLimit::Factor(ALPHA_LIMIT),
            ..methods::sbvh(invalid)
        };
        Ok((alpha, built(&builder, triangles)?))
    });
    let results: Vec<(f64, (f64, SplitStatistics))> =
        results.into_iter().collect::<Result<_, _>>()?;
    let rows = results.iter().map(|(alpha, (cost, splits))| TableRow {
        is_published: false,
        figures: vec![
            Figure::Text(label(*alpha)),
            Figure::number(*cost, 2, ""),
            Figure::number(splits.reference_percentage(), 1, " %"),
            Figure::count(splits.spatial_split_attempts),
            Figure::count(splits.spatial_splits),
            Figure::count(splits.refused_splits),
        ],
    });
    let percent = 100.0 * ALPHA_LIMIT;
    let table = DocumentTable {
        caption: format!("Figure 5: the influence of alpha, with at most {percent} % references"),
        headings: vec![
            "alpha",
            "SAH\ncost",
            "references",
            "attempts",
            "spatial\nsplits",
            "refused by\nthe limit",
        ],
        rows: rows.collect(),
    };
    let series = |name: &str, value: fn(&(f64, SplitStatistics)) -> f64| Series {
        name: name.to_owned(),
        values: results.iter().map(|(_, result)| value(result)).collect(),
    };
    let chart = LineChart {
        title: format!(
            "SAH cost and references against alpha (Figure 5), with at most {percent} % references"
        ),
        label: "alpha".to_owned(),
        labels: ALPHAS.map(label).to_vec(),
        series: vec![
            series("SAH cost", |result| result.0),
            series("references in percent", |result| {
                result.1.reference_percentage()
            }),
        ],
    };
    let limited: Vec<String> = results
        .iter()
        .filter(|(_, (_, splits))| splits.refused_splits > 0)
        .map(|(alpha, _)| label(*alpha))
        .collect();
    let note = format!(
        "Figure 5 allows {percent} % references, Table 1 {} %. {}",
        100.0 * methods::LIMIT,
        if limited.is_empty() {
            "Its limit refused no split.".to_owned()
        } else {
            let alphas = limited.join(", ");
            format!("Its limit, not alpha, decides where it refused splits: at {alphas}.")
        }
    );
    Ok(Figure5 { table, chart, note })
}

fn label(alpha: f64) -> String {
    if alpha == 0.0 || alpha == 1.0 {
        format!("{alpha}")
    } else {
        format!("{alpha:e}")
    }
}

/// SAH cost and references under hard limits, for each way to spend them.
pub(super) fn limits(
    triangles: &[Triangle],
    invalid: InvalidPrimitives,
) -> Result<DocumentTable, BuildError> {
    let mut rows = Vec::new();
    for factor in LIMITS {
        let mut figures = vec![Figure::number(100.0 * factor, 0, " %")];
        for (spending, _) in SPENDINGS {
            let builder = SbvhBuilder {
                limit: ReferenceLimit::Factor(factor),
                spending,
                ..methods::sbvh(invalid)
            };
            let (cost, splits) = built(&builder, triangles)?;
            figures.push(Figure::number(cost, 2, ""));
            figures.push(Figure::number(splits.reference_percentage(), 2, " %"));
        }
        rows.push(TableRow {
            is_published: false,
            figures,
        });
    }
    let ways = SPENDINGS.map(|(_, name)| name).join(", ");
    Ok(DocumentTable {
        caption: format!(
            "Hard limits on references (section 6.1), spent {ways}; alpha as in Table 1"
        ),
        headings: vec![
            "limit",
            "by benefit\nSAH cost",
            "references",
            "breadth-first\nSAH cost",
            "references",
            "in shares\nSAH cost",
            "references",
        ],
        rows,
    })
}
