//! Figures that describe a finished tree.

use super::{NodeKind, TreeOutline};
use crate::split::SurfaceAreaHeuristic;

/// Bytes that a structure occupies, by part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BytesByPart {
    /// Nodes.
    pub nodes: usize,
    /// References from leaves to primitives.
    pub references: usize,
    /// Primitives, and what finds them by id.
    pub primitives: usize,
}

impl BytesByPart {
    /// All parts together.
    pub fn total(&self) -> usize {
        self.nodes + self.references + self.primitives
    }
}

/// What a tree is like, computed from its outline after the build.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TreeStatistics {
    /// Nodes that have children, of every kind.
    pub inner_nodes: usize,
    /// Of these, splitting nodes.
    pub splitting_nodes: usize,
    /// Of these, carving nodes.
    pub carving_nodes: usize,
    /// Leaves.
    pub leaves: usize,
    /// References in leaves.
    pub references: usize,
    /// Different primitives referenced.
    pub primitives: usize,
    /// The longest path from the root, in edges.
    pub depth: u32,
    /// `leaf_histogram[n]` leaves hold `n` references.
    pub leaf_histogram: Vec<usize>,
    /// The expected cost of a random line through the root's box by the
    /// surface area heuristic.
    pub sah_cost: f64,
    /// The half area of the common parts of sibling boxes, summed over all
    /// siblings and divided by the root's half area.
    pub overlap: f64,
}

impl TreeStatistics {
    /// Walks `outline`, with the costs of `heuristic`.
    pub fn of(outline: &TreeOutline, heuristic: &SurfaceAreaHeuristic) -> Self {
        let mut statistics = Self {
            depth: outline.depths().into_iter().max().unwrap_or(0),
            references: outline.ids.len(),
            primitives: count_distinct(&outline.ids),
            sah_cost: sah_cost(outline, heuristic),
            overlap: sibling_overlap(outline),
            ..Self::default()
        };
        for node in &outline.nodes {
            statistics.count(node.kind, node.references.len());
        }
        statistics
    }

    /// Nodes of all kinds.
    pub fn nodes(&self) -> usize {
        self.inner_nodes + self.leaves
    }

    /// References per referenced primitive: 1 where nothing is duplicated.
    pub fn duplication(&self) -> f64 {
        self.references as f64 / self.primitives.max(1) as f64
    }

    /// References per leaf.
    pub fn mean_leaf_size(&self) -> f64 {
        self.references as f64 / self.leaves.max(1) as f64
    }

    fn count(&mut self, kind: NodeKind, references: usize) {
        match kind {
            NodeKind::Leaf => {
                self.leaves += 1;
                if self.leaf_histogram.len() <= references {
                    self.leaf_histogram.resize(references + 1, 0);
                }
                self.leaf_histogram[references] += 1;
            }
            NodeKind::Inner | NodeKind::General => self.inner_nodes += 1,
            NodeKind::Splitting => {
                self.inner_nodes += 1;
                self.splitting_nodes += 1;
            }
            NodeKind::Carving => {
                self.inner_nodes += 1;
                self.carving_nodes += 1;
            }
        }
    }
}

fn count_distinct(ids: &[u32]) -> usize {
    let mut ids = ids.to_vec();
    ids.sort_unstable();
    ids.dedup();
    ids.len()
}

/// The sum over all nodes of the probability that a line through the root's
/// box visits the node times what the visit costs.
fn sah_cost(outline: &TreeOutline, heuristic: &SurfaceAreaHeuristic) -> f64 {
    let Some(root) = outline.nodes.first() else {
        return 0.0;
    };
    let root_area = root.half_area;
    let costs = outline.nodes.iter().map(|node| {
        let visit = match node.kind {
            NodeKind::Leaf => heuristic.leaf_cost(node.references.len()),
            _ => heuristic.traversal_cost,
        };
        visit * SurfaceAreaHeuristic::probability(node.half_area, root_area)
    });
    costs.sum()
}

fn sibling_overlap(outline: &TreeOutline) -> f64 {
    let Some(root) = outline.nodes.first() else {
        return 0.0;
    };
    if outline.divides_space {
        return 0.0;
    }
    let mut overlap = 0.0;
    for siblings in outline.children() {
        for (position, &left) in siblings.iter().enumerate() {
            for &right in &siblings[position + 1..] {
                let [left, right] = [left, right].map(|node| &outline.nodes[node as usize].bounds);
                let common = left.intersection(right);
                // Boxes that merely touch, or are apart, have no common area.
                if common.extent().min_element() > 0.0 {
                    overlap += common.half_area();
                }
            }
        }
    }
    let root_area = root.bounds.half_area();
    if root_area > 0.0 {
        overlap / root_area
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;

    /// A unit cube with two overlapping halves.
    fn two_leaves() -> TreeOutline {
        let mut outline = TreeOutline::default();
        let root = outline.push_inner(NodeKind::Inner, Aabb::new([0.0; 3], [1.0; 3]), None);
        outline.push_leaf(
            Aabb::new([0.0; 3], [0.75, 1.0, 1.0]),
            Some(root),
            [0, 1].into_iter(),
        );
        outline.push_leaf(
            Aabb::new([0.5, 0.0, 0.0], [1.0; 3]),
            Some(root),
            [1, 2, 4].into_iter(),
        );
        outline
    }

    #[test]
    fn figures_of_a_small_tree_are_those_worked_out_by_hand() {
        let heuristic = SurfaceAreaHeuristic {
            traversal_cost: 1.0,
            intersection_cost: 2.0,
        };
        let statistics = TreeStatistics::of(&two_leaves(), &heuristic);
        assert_eq!(
            (statistics.inner_nodes, statistics.leaves, statistics.depth),
            (1, 2, 1)
        );
        assert_eq!((statistics.references, statistics.primitives), (5, 4));
        assert_eq!(statistics.leaf_histogram, [0, 0, 1, 1]);
        assert_eq!(statistics.duplication(), 1.25);
        // Half areas: root 3, leaves 0.75 + 1 + 0.75 = 2.5 and 0.5 + 1 + 0.5 = 2.
        let expected = 1.0 + 2.5 / 3.0 * 4.0 + 2.0 / 3.0 * 6.0;
        approx::assert_relative_eq!(statistics.sah_cost, expected);
        // The common part is 0.25 wide: 0.25 + 1 + 0.25.
        approx::assert_relative_eq!(statistics.overlap, 0.5);
    }

    #[test]
    fn cells_count_by_their_own_area_and_do_not_overlap() {
        let heuristic = SurfaceAreaHeuristic {
            traversal_cost: 1.0,
            intersection_cost: 2.0,
        };
        let mut outline = two_leaves();
        outline.divides_space = true;
        outline.nodes[1].half_area = 1.5;
        let statistics = TreeStatistics::of(&outline, &heuristic);
        let expected = 1.0 + 1.5 / 3.0 * 4.0 + 2.0 / 3.0 * 6.0;
        approx::assert_relative_eq!(statistics.sah_cost, expected);
        assert_eq!(statistics.overlap, 0.0);
    }

    #[test]
    fn an_empty_tree_has_zeroes() {
        let statistics =
            TreeStatistics::of(&TreeOutline::default(), &SurfaceAreaHeuristic::default());
        assert_eq!(statistics, TreeStatistics::default());
    }
}
