//! Back to a build tree, with leaves where they cost less than what lies below.

use accel_core::build::{BuildTree, Division, TopDown, build_top_down};
use accel_core::{BuildError, BuildObserver};

use super::links::{Content, Links};
use crate::{ChildBounds, NodeRules};

pub(super) fn to_build_tree(
    links: &Links,
    rules: &NodeRules,
    observer: &dyn BuildObserver,
) -> Result<BuildTree<ChildBounds>, BuildError> {
    build_top_down(&Collapse::new(links, rules), 0, 0, observer)
}

/// What is known of each node from the leaves up.
struct Collapse<'a> {
    links: &'a Links,
    subtrees: Vec<Subtree>,
}

#[derive(Clone, Copy, Default)]
struct Subtree {
    references: usize,
    /// By the surface area heuristic, without division by the root's area.
    cost: f64,
    is_leaf: bool,
}

impl<'a> Collapse<'a> {
    fn new(links: &'a Links, rules: &NodeRules) -> Self {
        let mut subtrees = vec![Subtree::default(); links.len()];
        for number in links.depth_first().into_iter().rev() {
            let node = links.node(number);
            let area = node.bounds.half_area();
            let leaf = |references| Subtree {
                references,
                cost: area * rules.heuristic.leaf_cost(references),
                is_leaf: true,
            };
            subtrees[number as usize] = match node.content {
                Content::Leaf { count, .. } => leaf(count as usize),
                Content::Inner(children) => {
                    let [left, right] = children.map(|child| subtrees[child as usize]);
                    let references = left.references + right.references;
                    let below = left.cost + right.cost;
                    let cost = area * rules.heuristic.traversal_cost + below;
                    // Costs of a split are told by area, as the heuristic does.
                    let split_cost = if area > 0.0 {
                        cost / area
                    } else {
                        f64::INFINITY
                    };
                    if rules.prefers_leaf(references, split_cost) {
                        leaf(references)
                    } else {
                        Subtree {
                            references,
                            cost,
                            is_leaf: false,
                        }
                    }
                }
            };
        }
        Self { links, subtrees }
    }

    fn gather_ids(&self, top: u32, ids: &mut Vec<u32>) {
        let mut pending = vec![top];
        while let Some(number) = pending.pop() {
            match self.links.node(number).content {
                Content::Leaf { first, count } => {
                    ids.extend_from_slice(self.links.ids(first, count));
                }
                Content::Inner([left, right]) => pending.extend([right, left]),
            }
        }
    }
}

impl TopDown for Collapse<'_> {
    type Task = u32;
    type Node = ChildBounds;

    fn size(&self, number: &u32) -> usize {
        self.subtrees[*number as usize].references
    }

    fn divide(&self, number: u32, _: u32, leaf: &mut Vec<u32>) -> Division<Self> {
        match self.links.node(number).content {
            Content::Inner(children) if !self.subtrees[number as usize].is_leaf => {
                Division::Inner {
                    node: ChildBounds(children.map(|child| self.links.node(child).bounds)),
                    children,
                }
            }
            _ => {
                self.gather_ids(number, leaf);
                Division::Leaf
            }
        }
    }
}
