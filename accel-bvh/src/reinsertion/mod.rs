//! A finished tree made better: nodes are taken out and put back where they
//! cost least (Meister and Bittner 2018, *Parallel Reinsertion for Bounding
//! Volume Hierarchy Optimization*).
//!
//! ```text
//! round:  of the nodes with the largest boxes, each finds, in parallel, the
//!             place where the boxes of all inner nodes together shrink most
//!         the moves, best first, are made unless they meet an earlier one
//! end:    subtrees that cost more than a leaf become leaves
//! ```
//! A builder that divides from the top decides at the root without knowing what
//! follows; moving a node afterwards knows the whole tree.

mod collapse;
mod links;
mod search;

use accel_core::build::{BuildTree, map_each};
use accel_core::{Aabb, BuildError, BuildObserver};

use self::links::Links;
use self::search::Move;
use crate::{ChildBounds, NodeRules};

/// How long a finished tree is improved by moving its nodes.
///
/// ```
/// use accel_bvh::{BvhBuilder, Reinsertion, Sphere};
/// # fn main() -> Result<(), accel_bvh::BuildError> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let builder = BvhBuilder {
///     reinsertion: Some(Reinsertion::default()),
///     ..BvhBuilder::default()
/// };
/// let bvh = builder.build(&spheres)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reinsertion {
    /// The most rounds, 1 to 1000. They end with the first that betters nothing
    /// or makes the tree too deep, and that one is taken back.
    pub rounds: u32,
    /// The share of all nodes, those with the largest boxes, that look for a
    /// better place in a round: above 0, at most 1.
    pub share: f64,
}

impl Default for Reinsertion {
    fn default() -> Self {
        Self {
            rounds: 8,
            share: 0.1,
        }
    }
}

impl Reinsertion {
    /// At most two nodes a reference: the tree in links twice, and of each node a
    /// move and a place in an order; at the end once, with the tree that it becomes.
    pub(crate) const BYTES_PER_REFERENCE: usize = 2 * (2 * Links::BYTES_PER_NODE + 48);

    /// Checks the settings.
    ///
    /// # Errors
    /// [`BuildError::InvalidSetting`] names the first that is out of its range.
    pub fn validate(&self) -> Result<(), BuildError> {
        let reject = |setting, value, allowed| {
            Err(BuildError::InvalidSetting {
                setting,
                value,
                allowed,
            })
        };
        if !(1..=1000).contains(&self.rounds) {
            return reject("rounds", self.rounds.to_string(), "1 to 1000");
        }
        // The negated range rejects NaN as well.
        if !(self.share > 0.0 && self.share <= 1.0) {
            return reject("share", self.share.to_string(), "above 0 and at most 1");
        }
        Ok(())
    }

    /// Improves a tree within `bounds`, whatever built it. Leaves keep their
    /// references together, unless `rules` prefer a leaf to what lies below a
    /// node. No deeper than `max_depth`, or than the tree was.
    ///
    /// # Errors
    /// [`BuildError::Cancelled`] if `observer` asked for it.
    pub fn improve(
        &self,
        tree: BuildTree<ChildBounds>,
        bounds: Aabb,
        rules: &NodeRules,
        observer: &dyn BuildObserver,
    ) -> Result<BuildTree<ChildBounds>, BuildError> {
        let mut links = Links::new(&tree, bounds);
        drop(tree);
        let deepest = links.depth().max(rules.max_depth());
        for _ in 0..self.rounds {
            if observer.is_cancelled() {
                return Err(BuildError::Cancelled);
            }
            let before = links.clone();
            self.round(&mut links);
            // Moves are weighed one by one, and may spoil each other.
            if links.inner_area() >= before.inner_area() || links.depth() > deepest {
                links = before;
                break;
            }
        }
        collapse::to_build_tree(&links, rules, observer)
    }

    fn round(&self, links: &mut Links) {
        let found = map_each(self.candidates(links), |node| {
            search::best_move(links, node)
        });
        let mut moves: Vec<Move> = found.into_iter().flatten().collect();
        moves.sort_unstable_by(|a, b| b.gain.total_cmp(&a.gain).then(a.node.cmp(&b.node)));
        let mut touched = vec![false; links.len()];
        for step in moves {
            links.reinsert(step.node, step.beside, &mut touched);
        }
    }

    /// The nodes with the largest boxes.
    fn candidates(&self, links: &Links) -> Vec<u32> {
        let mut nodes: Vec<(f64, u32)> = links.movable().collect();
        let count = (nodes.len() as f64 * self.share).ceil() as usize;
        if count < nodes.len() {
            nodes.select_nth_unstable_by(count, |a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            nodes.truncate(count);
        }
        nodes.into_iter().map(|(_, node)| node).collect()
    }
}
