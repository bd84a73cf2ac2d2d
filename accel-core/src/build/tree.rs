//! The tree that a builder makes, before a layout packs it.

/// A finished build tree. Read it from [`root`](Self::root) by cursors.
#[derive(Clone, Debug)]
pub struct BuildTree<I> {
    pub(super) root: Subtree<I>,
}

/// Part of a build tree: built by one thread in one run, or forked.
#[derive(Clone, Debug)]
pub(super) enum Subtree<I> {
    Run(Run<I>),
    Fork {
        node: I,
        children: Box<[Subtree<I>; 2]>,
    },
}

/// Nodes in depth-first order: a left child follows its parent.
#[derive(Clone, Debug)]
pub(super) struct Run<I> {
    pub nodes: Vec<RunNode<I>>,
    pub ids: Vec<u32>,
}

#[derive(Clone, Debug)]
pub(super) enum RunNode<I> {
    Inner { node: I, right: u32 },
    Leaf { first: u32, count: u32 },
}

/// A place in a build tree.
#[derive(Debug)]
pub struct Cursor<'a, I> {
    subtree: &'a Subtree<I>,
    position: u32,
}

/// A node of a build tree.
#[derive(Debug)]
pub enum BuildNode<'a, I> {
    /// A node with two children.
    Inner {
        /// What the builder recorded about it.
        node: &'a I,
        /// The left child and the right one.
        children: [Cursor<'a, I>; 2],
    },
    /// A leaf of the primitives with these ids.
    Leaf(&'a [u32]),
}

impl<I> Clone for Cursor<'_, I> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<I> Copy for Cursor<'_, I> {}

impl<I> BuildTree<I> {
    /// The root.
    pub fn root(&self) -> Cursor<'_, I> {
        Cursor {
            subtree: &self.root,
            position: 0,
        }
    }

    /// Bytes that the tree holds, forks aside.
    pub fn bytes(&self) -> usize {
        let (inner, leaves) = self.count();
        (inner + leaves) * size_of::<RunNode<I>>() + self.references() * size_of::<u32>()
    }

    /// How many references all leaves hold together.
    pub fn references(&self) -> usize {
        self.root.references()
    }

    /// How many inner nodes and leaves there are.
    pub fn count(&self) -> (usize, usize) {
        self.root.count()
    }
}

impl<I> Subtree<I> {
    fn references(&self) -> usize {
        match self {
            Self::Run(run) => run.ids.len(),
            Self::Fork { children, .. } => children.iter().map(Self::references).sum(),
        }
    }

    fn count(&self) -> (usize, usize) {
        match self {
            Self::Run(run) => {
                // Every inner node has two children.
                let inner = run.nodes.len() / 2;
                (inner, run.nodes.len() - inner)
            }
            Self::Fork { children, .. } => {
                let [left, right] = [children[0].count(), children[1].count()];
                (left.0 + right.0 + 1, left.1 + right.1)
            }
        }
    }
}

impl<'a, I> Cursor<'a, I> {
    /// The node here.
    pub fn node(self) -> BuildNode<'a, I> {
        match self.subtree {
            Subtree::Fork { node, children } => BuildNode::Inner {
                node,
                children: [&children[0], &children[1]].map(|subtree| Cursor {
                    subtree,
                    position: 0,
                }),
            },
            Subtree::Run(run) => match &run.nodes[self.position as usize] {
                RunNode::Inner { node, right } => BuildNode::Inner {
                    node,
                    children: [self.position + 1, *right].map(|position| Cursor {
                        subtree: self.subtree,
                        position,
                    }),
                },
                &RunNode::Leaf { first, count } => {
                    BuildNode::Leaf(&run.ids[first as usize..(first + count) as usize])
                }
            },
        }
    }
}
