//! Checks of a finished tree, and of words from elsewhere.

use accel_core::{AccelerationStructure, BuildBudget, Primitive, ValidationError};

use crate::codec::{Header, Node};
use crate::error::WordsError;
use crate::node_set::NodeSet;
use crate::tree::PlaneTree;

impl<P: Primitive, N: NodeSet> PlaneTree<P, N> {
    /// Checks everything that hits rely on: the words are those of a tree, every
    /// node's region encloses the primitives below it, every primitive that was
    /// not skipped stands in a leaf, and the recorded depth is right.
    ///
    /// # Errors
    /// The first [`ValidationError`] found.
    pub fn validate(&self) -> Result<(), ValidationError> {
        let actual = check_words::<N>(&self.words, |_| true).unwrap_or(u32::MAX);
        if actual != self.depth {
            return Err(ValidationError::DepthMismatch {
                actual,
                recorded: self.depth,
            });
        }
        self.outline().validate_of(self)
    }
}

/// Checks words that may be anything: that they are the nodes of one tree of the
/// kinds in `N`, the root first, whose leaves have numbers that `is_leaf_number` accepts. No words
/// are the empty tree. Takes time and memory in proportion to the words.
///
/// Returns the splitting nodes on the path that has most of them.
///
/// # Errors
/// The first [`WordsError`] found.
pub fn check_words<N: NodeSet>(
    words: &[u32],
    is_leaf_number: impl Fn(u32) -> bool,
) -> Result<u32, WordsError> {
    if words.is_empty() {
        return Ok(0);
    }
    let mut is_taken = vec![false; words.len()];
    let mut deepest = 0;
    let mut pending = vec![(0, 0)];
    while let Some((position, depth)) = pending.pop() {
        let node = Node::decode(words, position)?;
        if !N::admits(node.header) {
            let code = node.header.code();
            return Err(WordsError::ForeignNode { position, code });
        }
        let own = position..position + node.header.words();
        if let Some(shared) = is_taken[own.clone()].iter().position(|&taken| taken) {
            let position = position + shared;
            return Err(WordsError::Shared { position });
        }
        is_taken[own].fill(true);
        if node.header.is_leaf() && !is_leaf_number(node.target as u32) {
            return Err(WordsError::UnknownLeaf {
                position,
                leaf: node.target,
            });
        }
        let depth = depth + u32::from(matches!(node.header, Header::Splitting { .. }));
        let limit = BuildBudget::DEEPEST;
        if depth > limit {
            return Err(WordsError::TooDeep { depth, limit });
        }
        check_first_child(words, &node)?;
        deepest = deepest.max(depth);
        pending.extend(node.children().map(|child| (child, depth)));
    }
    Ok(deepest)
}

/// That the first child of a splitting node is as large as the node says.
fn check_first_child(words: &[u32], node: &Node) -> Result<(), WordsError> {
    let Header::Splitting {
        first_child_words, ..
    } = node.header
    else {
        return Ok(());
    };
    let actual = Node::decode(words, node.target)?.header.words();
    if actual != first_child_words {
        return Err(WordsError::ChildSize {
            position: node.target,
            actual,
            recorded: first_child_words,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use accel_core::testing::{families, rays};
    use accel_core::{AccelerationStructure, TraversalCounters};
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    use super::*;
    use crate::{BvhBuilder, DualSplitConverter, DualSplitNodes, DualSplitTree};

    /// Words that pass the check are those of some tree: traced, they give an
    /// answer after at most one visit of each node.
    #[test]
    fn corrupted_words_are_refused_or_traced_in_bounded_time() {
        let scene = families::find("soup-mixed-sizes").unwrap().scene(3, 60);
        let bvh = BvhBuilder::default().build(&scene).unwrap();
        let mut tree = DualSplitConverter::default().convert(&bvh).unwrap();
        let sound = tree.words.clone();
        let leaves = leaf_numbers(&tree);
        let is_leaf_number = |leaf| leaves.contains(&leaf);
        assert_eq!(
            check_words::<DualSplitNodes>(&sound, is_leaf_number),
            Ok(tree.depth)
        );
        let rays = rays::mixed(&scene, 4, 64);
        let mut random = Pcg64Mcg::seed_from_u64(5);
        let (mut refused, mut traced) = (0, 0);
        for round in 0..100_000 {
            tree.words.clone_from(&sound);
            for _ in 0..1 + round % 3 {
                let word = random.random_range(0..sound.len());
                if random.random_range(0..4) == 0 {
                    tree.words[word] = random.random();
                } else {
                    tree.words[word] ^= 1 << random.random_range(0..32);
                }
            }
            if check_words::<DualSplitNodes>(&tree.words, is_leaf_number).is_err() {
                refused += 1;
                continue;
            }
            traced += 1;
            let mut counters = TraversalCounters::default();
            tree.closest_hit_with(&rays[round % rays.len()], &mut counters);
            assert!(counters.nodes.max as usize <= sound.len());
        }
        assert!(refused > 10_000 && traced > 10_000, "{refused} {traced}");
    }

    fn leaf_numbers<P: Primitive>(tree: &DualSplitTree<P>) -> HashSet<u32> {
        let mut leaves = HashSet::new();
        let mut pending = vec![0];
        while let Some(position) = pending.pop() {
            let node = tree.node(position);
            if node.header.is_leaf() {
                leaves.insert(node.target as u32);
            }
            pending.extend(node.children());
        }
        leaves
    }
}
