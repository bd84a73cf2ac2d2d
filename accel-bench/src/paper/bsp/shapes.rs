//! Table 3: what the trees are like.

use super::methods::TreeFacts;
use super::published::{self, PublishedTree};
use crate::report::document::{DocumentTable, Figure, TableRow};

/// A row for every tree, the published ones below.
pub(super) fn table(scene: &str, trees: &[TreeFacts]) -> DocumentTable {
    let mut rows: Vec<TableRow> = trees.iter().map(measured).collect();
    let mut caption = "Table 3: trees".to_owned();
    if let Some(published) = published::find(scene) {
        caption = format!(
            "{caption}; in italics {} of {}",
            published.name,
            super::SOURCE
        );
        let trees = ["BSP", "kd-tree"].into_iter().zip(&published.trees);
        rows.extend(trees.map(|(name, tree)| quoted(name, tree)));
    }
    DocumentTable {
        caption,
        headings: vec![
            "tree",
            "build\nseconds",
            "max\ndepth",
            "nodes",
            "% kd-tree\nnodes",
            "leaf\n(0)",
            "leaf\n(1)",
            "leaf\n(2)",
            "leaf\n(3)",
            "leaf\n(4)",
            "leaf\n(> 4)",
            "max in\na leaf",
            "of one, of\nthe filled",
            "traversal-\nbased",
            "nodes\nMB",
            "surface\narea cost",
        ],
        rows,
    }
}

fn measured(tree: &TreeFacts) -> TableRow {
    let inner = tree.axis_aligned + tree.general;
    let mut figures = vec![
        Figure::Text(tree.name.to_owned()),
        Figure::number(tree.build_seconds, 2, ""),
        Figure::count(tree.depth as usize),
        Figure::count(tree.nodes()),
        Figure::number(
            100.0 * tree.axis_aligned as f64 / inner.max(1) as f64,
            0,
            " %",
        ),
    ];
    figures.extend((0..5).map(|size| Figure::count(tree.leaves_of(size))));
    figures.extend([
        Figure::count(tree.leaves_above(4)),
        Figure::count(tree.leaves_by_size.len().saturating_sub(1)),
        Figure::number(tree.single_percentage(), 1, " %"),
        Figure::count(tree.bounded_leaves),
        Figure::number(tree.node_bytes as f64 / 1e6, 2, ""),
        Figure::number(tree.surface_area_cost, 2, ""),
    ]);
    TableRow {
        is_published: false,
        figures,
    }
}

fn quoted(name: &str, tree: &PublishedTree) -> TableRow {
    let filled: f64 = tree.leaves.iter().skip(1).sum();
    let mut figures = vec![
        Figure::Text(format!("{name}, published")),
        Figure::number(tree.build_seconds, 2, ""),
        Figure::count(tree.depth as usize),
        Figure::number(tree.nodes, 0, "K"),
        Figure::number(tree.axis_aligned, 0, " %"),
    ];
    figures.extend(tree.leaves.map(|count| Figure::number(count, 0, "")));
    figures.extend([
        Figure::count(tree.largest_leaf),
        Figure::number(100.0 * tree.leaves[1] / filled, 1, " %"),
        Figure::None,
        Figure::None,
        Figure::None,
    ]);
    TableRow {
        is_published: true,
        figures,
    }
}
