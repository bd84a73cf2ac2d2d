//! The growth of a tree, in rounds, under a limit on references.
//!
//! ```text
//! round:  in parallel, for every new node: choose what it becomes; all but
//!             those that want a spatial split become it at once
//!         among the nodes that wait for a spatial split, pick those whose time
//!             has come; in parallel, divide them
//! ```
//! A round's nodes are taken and numbered in order, so the tree does not depend
//! on the number of threads.

use accel_bvh::{BvhBuilder, ChildBounds};
use accel_core::build::{BuildTree, map_each};
use accel_core::{BuildError, BuildObserver, Clip};

use crate::node::Node;
use crate::partitioning::{Choice, Partitioning};
use crate::spatial_split::Division;
use crate::statistics::SplitStatistics;
use crate::waiting::{Verdict, Waiting, WaitingList};

/// What a tree grows by.
pub(crate) struct Growth<'a, P> {
    pub partitioning: Partitioning<'a, P>,
    /// Builds subtrees without spatial splits.
    pub objects: BvhBuilder,
    pub observer: &'a dyn BuildObserver,
}

/// A tree that is not finished.
struct Sapling {
    slots: Vec<Slot>,
    waiting: WaitingList,
    statistics: SplitStatistics,
}

/// A place in the tree.
enum Slot {
    /// Its node is still to be divided.
    Open,
    Inner {
        bounds: ChildBounds,
        /// The left child's slot; the right child's is the next.
        first_child: usize,
    },
    Done(BuildTree<ChildBounds>),
}

/// What became of a node, and what it adds to the statistics.
struct Outcome {
    slot: usize,
    became: Became,
    /// References that the division added.
    added: usize,
    statistics: SplitStatistics,
}

enum Became {
    Done(BuildTree<ChildBounds>),
    Divided([Node; 2]),
    Waiting(Box<Waiting>),
}

/// Tells a subtree's builder to stop, but does not tell how much of it is done.
struct CancelOnly<'a>(&'a dyn BuildObserver);

impl BuildObserver for CancelOnly<'_> {
    fn is_cancelled(&self) -> bool {
        self.0.is_cancelled()
    }
}

impl<P: Clip> Growth<'_, P> {
    /// Grows the tree of `root`.
    pub(crate) fn grow(
        &self,
        root: Node,
        waiting: WaitingList,
    ) -> Result<(BuildTree<ChildBounds>, SplitStatistics), BuildError> {
        let total = root.count();
        let mut sapling = Sapling::new(waiting, total);
        let mut new = vec![(0, root)];
        while !new.is_empty() || !sapling.waiting.is_empty() {
            if self.observer.is_cancelled() {
                return Err(BuildError::Cancelled);
            }
            let spare = sapling.waiting.remaining();
            let outcomes = map_each(new, |(slot, node)| self.process(slot, node, spare));
            new = sapling.record(outcomes)?;
            let picked = sapling.waiting.pick();
            let outcomes = map_each(picked, |(waiting, verdict)| self.resolve(waiting, verdict));
            new.extend(sapling.record(outcomes)?);
            let done = sapling.statistics.references;
            self.observer.progress(done, total.max(done));
        }
        Ok((sapling.assemble(0), sapling.statistics))
    }

    fn process(&self, slot: usize, node: Node, spare: usize) -> Result<Outcome, BuildError> {
        let chosen = self
            .partitioning
            .choose(&node, node.allowance.unwrap_or(spare));
        let mut outcome = self.carry_out(slot, node, chosen.choice)?;
        outcome.statistics.spatial_split_attempts += usize::from(chosen.is_attempt);
        Ok(outcome)
    }

    fn carry_out(&self, slot: usize, node: Node, choice: Choice) -> Result<Outcome, BuildError> {
        let became = match choice {
            Choice::Leaf => Became::Done(leaf_of(node)),
            Choice::ObjectSplitsOnly => Became::Done(self.without_spatial_splits(node)?),
            Choice::Object(candidate) => Became::Divided(candidate.carry_out(node)),
            Choice::Spatial(spatial, object) => {
                let waiting = Waiting {
                    slot,
                    node,
                    spatial,
                    object,
                };
                match waiting.node.allowance {
                    None => Became::Waiting(Box::new(waiting)),
                    Some(share) => {
                        let verdict = Verdict::within(waiting.demand(), share);
                        return self.resolve(waiting, verdict);
                    }
                }
            }
        };
        Ok(Outcome::new(slot, became))
    }

    fn resolve(&self, waiting: Waiting, verdict: Verdict) -> Result<Outcome, BuildError> {
        let Waiting {
            slot,
            node,
            spatial,
            object,
        } = waiting;
        let instead = self
            .partitioning
            .without_spatial_split(node.count(), object);
        if verdict == Verdict::Refused {
            let mut outcome = self.carry_out(slot, node, instead)?;
            outcome.statistics.refused_splits += 1;
            return Ok(outcome);
        }
        match self.partitioning.divisor.divide(node, &spatial) {
            Ok(division) => Ok(Outcome::of_division(slot, division)),
            Err(node) => self.carry_out(slot, node, instead),
        }
    }

    fn without_spatial_splits(&self, node: Node) -> Result<BuildTree<ChildBounds>, BuildError> {
        let (bounds, depth) = (node.bounds, node.depth);
        let references = node.fragments.into_references();
        let observer = CancelOnly(self.observer);
        let rules = &self.partitioning.rules;
        self.objects
            .build_subtree(rules, references, bounds, depth, &observer)
    }
}

fn leaf_of(node: Node) -> BuildTree<ChildBounds> {
    let references = node.fragments.into_references();
    BuildTree::of_leaf(references.iter().map(|reference| reference.id).collect())
}

impl Outcome {
    fn new(slot: usize, became: Became) -> Self {
        let mut statistics = SplitStatistics::default();
        if let Became::Done(tree) = &became {
            statistics.references = tree.references();
        }
        Self {
            slot,
            became,
            added: 0,
            statistics,
        }
    }

    fn of_division(slot: usize, division: Division) -> Self {
        let mut outcome = Self::new(slot, Became::Divided(division.children));
        outcome.added = division.duplicated;
        outcome.statistics.spatial_splits = 1;
        outcome.statistics.unsplits = division.unsplits;
        outcome
    }
}

impl Sapling {
    fn new(waiting: WaitingList, primitives: usize) -> Self {
        Self {
            slots: vec![Slot::Open],
            waiting,
            statistics: SplitStatistics {
                primitives,
                ..SplitStatistics::default()
            },
        }
    }

    /// Puts outcomes into their places; returns the new nodes.
    fn record(
        &mut self,
        outcomes: Vec<Result<Outcome, BuildError>>,
    ) -> Result<Vec<(usize, Node)>, BuildError> {
        let mut new = Vec::new();
        for outcome in outcomes {
            let outcome = outcome?;
            self.statistics += outcome.statistics;
            self.waiting.spend(outcome.added);
            match outcome.became {
                Became::Done(tree) => self.slots[outcome.slot] = Slot::Done(tree),
                Became::Waiting(waiting) => self.waiting.push(*waiting),
                Became::Divided(children) => {
                    let first_child = self.slots.len();
                    let bounds = ChildBounds(children.each_ref().map(|child| child.bounds));
                    self.slots[outcome.slot] = Slot::Inner {
                        bounds,
                        first_child,
                    };
                    self.slots.extend([Slot::Open, Slot::Open]);
                    new.extend((first_child..).zip(children));
                }
            }
        }
        Ok(new)
    }

    /// The tree of a slot. Recursion is as deep as the tree, which is bounded.
    fn assemble(&mut self, slot: usize) -> BuildTree<ChildBounds> {
        match std::mem::replace(&mut self.slots[slot], Slot::Open) {
            Slot::Done(tree) => tree,
            Slot::Inner {
                bounds,
                first_child,
            } => {
                let left = self.assemble(first_child);
                let right = self.assemble(first_child + 1);
                BuildTree::of_children(bounds, left, right)
            }
            Slot::Open => unreachable!("growth ends when no slot is open"),
        }
    }
}
