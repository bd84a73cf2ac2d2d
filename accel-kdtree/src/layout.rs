//! From a build tree to nodes.

use accel_core::build::{BuildNode, BuildTree, Cursor};
use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::{Aabb, BuildBudget, BuildError, Primitive};

use crate::KdTree;
use crate::node::{Leaf, MAX_INDEX, NODE_BYTES, Node};
use crate::part::Slack;
use crate::plane::Plane;

impl<P: Primitive> KdTree<P> {
    /// The tree over nothing that can be hit.
    pub(crate) fn empty(primitives: &[P], skipped: usize) -> Self {
        Self {
            nodes: Vec::new(),
            stored: StoredPrimitives::new(primitives, skipped, 0),
            bounds: None,
            slack: Slack(0.0),
            depth: 0,
        }
    }

    /// Packs a build tree in depth-first order, siblings adjacent.
    pub(crate) fn pack(
        budget: &BuildBudget,
        primitives: &[P],
        tree: &BuildTree<Plane>,
        bounds: Aabb,
        slack: Slack,
        skipped: usize,
    ) -> Result<Self, BuildError> {
        let (inner, leaves) = tree.count();
        let references = tree.references();
        check_indices(inner + leaves, references)?;
        let storage = references * (size_of::<P>() + 2 * size_of::<u32>());
        budget.check_bytes(tree.bytes() + (inner + leaves) * NODE_BYTES + storage)?;
        let mut packed = Self {
            nodes: Vec::with_capacity(inner + leaves),
            stored: StoredPrimitives::new(primitives, skipped, references),
            bounds: Some(bounds),
            slack,
            depth: 0,
        };
        packed.nodes.push(Node::leaf(Leaf::Empty));
        let mut pending: Vec<(Cursor<'_, Plane>, usize, u32)> = vec![(tree.root(), 0, 0)];
        while let Some((cursor, position, depth)) = pending.pop() {
            packed.depth = packed.depth.max(depth);
            packed.nodes[position] = match cursor.node() {
                BuildNode::Leaf([]) => Node::leaf(Leaf::Empty),
                BuildNode::Leaf(ids) => {
                    let leaf = packed.stored.leaves_mut().push_leaf(primitives, ids);
                    Node::leaf(Leaf::Of(leaf))
                }
                BuildNode::Inner { node, children } => {
                    let first = packed.nodes.len();
                    packed.nodes.extend([Node::leaf(Leaf::Empty); 2]);
                    pending.push((children[1], first + 1, depth + 1));
                    pending.push((children[0], first, depth + 1));
                    Node::inner(node.axis, node.position, first as u32)
                }
            };
        }
        Ok(packed)
    }
}

/// Checks that 29 bits tell all nodes and all references apart.
fn check_indices(nodes: usize, references: usize) -> Result<(), BuildError> {
    let needed = nodes.max(references);
    if needed > MAX_INDEX {
        return Err(BuildError::OffsetOverflow {
            needed,
            limit: MAX_INDEX,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_nodes_or_references_than_29_bits_tell_apart_are_an_error_that_names_both() {
        assert_eq!(check_indices(MAX_INDEX, MAX_INDEX), Ok(()));
        let expected = BuildError::OffsetOverflow {
            needed: MAX_INDEX + 1,
            limit: MAX_INDEX,
        };
        assert_eq!(check_indices(MAX_INDEX + 1, 0), Err(expected.clone()));
        assert_eq!(check_indices(0, MAX_INDEX + 1), Err(expected));
    }
}
