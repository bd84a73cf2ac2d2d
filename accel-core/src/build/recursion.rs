//! The recursion of every top-down builder, written once.
//!
//! ```text
//! large task:  divide; build both halves, in parallel     -> Fork
//! small task:  loop over a stack of tasks on one thread:
//!                  divide; push right; go on with left    -> Run
//! ```
//!
//! Whether a task is large depends on its size alone, so the tree is the same
//! for any number of threads. Forks nest only logarithmically deep, and runs use
//! a stack on the heap, so a small thread stack suffices.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::tree::{BuildTree, Run, RunNode, Subtree};
use super::{BuildObserver, join};
use crate::error::BuildError;

/// Tasks of fewer references than this are built by one thread.
const FORK_SIZE: usize = 4096;

/// Forks further below the root than this would nest too deep; a task there runs
/// on one thread.
const FORK_DEPTH: u32 = 24;

/// A strategy: how to divide one node. The recursion does the rest.
pub trait TopDown: Sync {
    /// The references of a node and whatever else describes it.
    type Task: Send;
    /// What the layout will want to know of an inner node.
    type Node: Send;

    /// How many references a task holds.
    fn size(&self, task: &Self::Task) -> usize;

    /// Divides a task, or ends it: then its ids are appended to `leaf`.
    fn divide(&self, task: Self::Task, depth: u32, leaf: &mut Vec<u32>) -> Division<Self>;
}

/// What became of a task.
#[derive(Debug)]
pub enum Division<S: TopDown + ?Sized> {
    /// It is a leaf; its ids have been appended.
    Leaf,
    /// It is an inner node with two children.
    Inner {
        /// What to record about it.
        node: S::Node,
        /// The tasks of the left child and the right one.
        children: [S::Task; 2],
    },
}

/// Builds the tree of `task`, whose root lies at `depth`: 0, unless the tree
/// becomes part of another.
///
/// # Errors
/// [`BuildError::Cancelled`] if `observer` asked for it.
pub fn build_top_down<S: TopDown>(
    strategy: &S,
    task: S::Task,
    depth: u32,
    observer: &dyn BuildObserver,
) -> Result<BuildTree<S::Node>, BuildError> {
    let recursion = Recursion {
        strategy,
        observer,
        last_fork: depth + FORK_DEPTH,
        total: strategy.size(&task),
        done: AtomicUsize::new(0),
    };
    let root = recursion.build(task, depth)?;
    Ok(BuildTree { root })
}

struct Recursion<'a, S> {
    strategy: &'a S,
    observer: &'a dyn BuildObserver,
    /// The depth from which on nothing forks.
    last_fork: u32,
    total: usize,
    done: AtomicUsize,
}

impl<S: TopDown> Recursion<'_, S> {
    fn build(&self, task: S::Task, depth: u32) -> Result<Subtree<S::Node>, BuildError> {
        if self.strategy.size(&task) < FORK_SIZE || depth >= self.last_fork {
            return self.run(task, depth).map(Subtree::Run);
        }
        self.check_cancelled()?;
        let mut ids = Vec::new();
        match self.strategy.divide(task, depth, &mut ids) {
            Division::Leaf => Ok(Subtree::Run(Run::of_leaf(ids))),
            Division::Inner { node, children } => {
                let [left, right] = children;
                let (left, right) = join(
                    || self.build(left, depth + 1),
                    || self.build(right, depth + 1),
                );
                let children = Box::new([left?, right?]);
                Ok(Subtree::Fork { node, children })
            }
        }
    }

    /// Builds a subtree on this thread.
    fn run(&self, task: S::Task, depth: u32) -> Result<Run<S::Node>, BuildError> {
        let mut run = Run {
            nodes: Vec::new(),
            ids: Vec::with_capacity(self.strategy.size(&task)),
        };
        // A task, its depth, and the parent whose right child it is.
        let mut pending = vec![(task, depth, None)];
        let mut reported = 0;
        while let Some((task, depth, parent)) = pending.pop() {
            let position = run.nodes.len() as u32;
            if let Some(parent) = parent {
                run.set_right_child(parent, position);
            }
            let first = run.ids.len();
            match self.strategy.divide(task, depth, &mut run.ids) {
                Division::Leaf => run.push_leaf(first),
                Division::Inner { node, children } => {
                    run.nodes.push(RunNode::Inner { node, right: 0 });
                    let [left, right] = children;
                    pending.push((right, depth + 1, Some(position)));
                    pending.push((left, depth + 1, None));
                }
            }
            if run.ids.len() - reported >= FORK_SIZE || pending.is_empty() {
                self.check_cancelled()?;
                self.report(run.ids.len() - reported);
                reported = run.ids.len();
            }
        }
        Ok(run)
    }

    fn check_cancelled(&self) -> Result<(), BuildError> {
        if self.observer.is_cancelled() {
            return Err(BuildError::Cancelled);
        }
        Ok(())
    }

    fn report(&self, references: usize) {
        let done = self.done.fetch_add(references, Ordering::Relaxed) + references;
        self.observer.progress(done, self.total.max(done));
    }
}

impl<I> Run<I> {
    pub(super) fn of_leaf(ids: Vec<u32>) -> Self {
        let mut run = Self {
            nodes: Vec::new(),
            ids,
        };
        run.push_leaf(0);
        run
    }

    /// Makes the ids from `first` on a leaf.
    fn push_leaf(&mut self, first: usize) {
        self.nodes.push(RunNode::Leaf {
            first: first as u32,
            count: (self.ids.len() - first) as u32,
        });
    }

    fn set_right_child(&mut self, parent: u32, position: u32) {
        if let RunNode::Inner { right, .. } = &mut self.nodes[parent as usize] {
            *right = position;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{BuildNode, Cursor};
    use super::*;
    use std::ops::Range;

    /// Halves ranges of numbers down to single ones; records where it cut.
    struct Halving;

    impl TopDown for Halving {
        type Task = Range<u32>;
        type Node = u32;

        fn size(&self, task: &Range<u32>) -> usize {
            task.len()
        }

        fn divide(&self, task: Range<u32>, _: u32, leaf: &mut Vec<u32>) -> Division<Self> {
            if task.len() < 2 {
                leaf.extend(task);
                return Division::Leaf;
            }
            let middle = task.start + task.len() as u32 / 2;
            Division::Inner {
                node: middle,
                children: [task.start..middle, middle..task.end],
            }
        }
    }

    fn collect(cursor: Cursor<'_, u32>, ids: &mut Vec<u32>) {
        match cursor.node() {
            BuildNode::Leaf(leaf) => ids.extend_from_slice(leaf),
            BuildNode::Inner { children, .. } => {
                for child in children {
                    collect(child, ids);
                }
            }
        }
    }

    #[test]
    fn forks_and_runs_together_make_the_whole_tree_in_order() {
        for count in [1, 2, 100, 20_000] {
            let tree = build_top_down(&Halving, 0..count, 0, &()).unwrap();
            let mut ids = Vec::new();
            collect(tree.root(), &mut ids);
            assert_eq!(ids, (0..count).collect::<Vec<_>>());
            assert_eq!(tree.count(), (count as usize - 1, count as usize));
        }
    }

    #[test]
    fn progress_reaches_the_total_and_cancelling_ends_the_build() {
        struct Watch(AtomicUsize, bool);
        impl BuildObserver for Watch {
            fn progress(&self, done: usize, total: usize) {
                assert!(done <= total);
                self.0.fetch_max(done, Ordering::Relaxed);
            }
            fn is_cancelled(&self) -> bool {
                self.1
            }
        }
        let watch = Watch(AtomicUsize::new(0), false);
        build_top_down(&Halving, 0..20_000, 0, &watch).unwrap();
        assert_eq!(watch.0.into_inner(), 20_000);
        let cancel = Watch(AtomicUsize::new(0), true);
        let result = build_top_down(&Halving, 0..20_000, 0, &cancel);
        assert_eq!(result.unwrap_err(), BuildError::Cancelled);
    }
}
