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
    /// The tree of one leaf, of the primitives with these ids.
    pub fn of_leaf(ids: Vec<u32>) -> Self {
        Self {
            root: Subtree::Run(Run::of_leaf(ids)),
        }
    }

    /// The tree of an inner node and its children. Nests by a level of the call
    /// stack when it is read or dropped, so deep trees should be made by
    /// [`build_top_down`](super::build_top_down).
    pub fn of_children(node: I, left: Self, right: Self) -> Self {
        Self {
            root: Subtree::Fork {
                node,
                children: Box::new([left.root, right.root]),
            },
        }
    }

    /// Replaces every id: for builders that number their references while they
    /// build.
    pub fn map_ids(&mut self, primitive_of: impl Fn(u32) -> u32) {
        self.root.map_ids(&primitive_of);
    }

    /// Removes repeated ids from every leaf; those that stay are sorted.
    pub fn remove_duplicates_in_leaves(&mut self) {
        self.root.remove_duplicates_in_leaves();
    }

    /// The root.
    pub fn root(&self) -> Cursor<'_, I> {
        Cursor {
            subtree: &self.root,
            position: 0,
        }
    }

    /// Bytes that a node takes.
    pub const BYTES_PER_NODE: usize = size_of::<RunNode<I>>();

    /// Bytes that the tree holds, forks aside.
    pub fn bytes(&self) -> usize {
        let (inner, leaves) = self.count();
        (inner + leaves) * Self::BYTES_PER_NODE + self.references() * size_of::<u32>()
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
    fn map_ids(&mut self, primitive_of: &impl Fn(u32) -> u32) {
        match self {
            Self::Run(run) => {
                for id in &mut run.ids {
                    *id = primitive_of(*id);
                }
            }
            Self::Fork { children, .. } => {
                for child in children.iter_mut() {
                    child.map_ids(primitive_of);
                }
            }
        }
    }

    fn remove_duplicates_in_leaves(&mut self) {
        match self {
            Self::Run(run) => run.remove_duplicates_in_leaves(),
            Self::Fork { children, .. } => {
                for child in children.iter_mut() {
                    child.remove_duplicates_in_leaves();
                }
            }
        }
    }

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

impl<I> Run<I> {
    fn remove_duplicates_in_leaves(&mut self) {
        let mut unique = Vec::with_capacity(self.ids.len());
        for node in &mut self.nodes {
            let RunNode::Leaf { first, count } = node else {
                continue;
            };
            let leaf = &mut self.ids[*first as usize..(*first + *count) as usize];
            leaf.sort_unstable();
            let start = unique.len();
            unique.extend(leaf.chunk_by(u32::eq).map(|equal| equal[0]));
            (*first, *count) = (start as u32, (unique.len() - start) as u32);
        }
        self.ids = unique;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_ids_leave_leaves_and_nothing_else_does() {
        let leaf = |ids: &[u32]| BuildTree::of_leaf(ids.to_vec());
        let mut tree = BuildTree::of_children((), leaf(&[13, 11, 13, 13]), leaf(&[11, 12]));
        tree.map_ids(|id| id - 10);
        assert_eq!((tree.references(), tree.count()), (6, (1, 2)));
        tree.remove_duplicates_in_leaves();
        assert_eq!((tree.references(), tree.count()), (4, (1, 2)));
        let BuildNode::Inner { children, .. } = tree.root().node() else {
            panic!("the root has children");
        };
        let ids = children.map(|child| match child.node() {
            BuildNode::Leaf(ids) => ids.to_vec(),
            BuildNode::Inner { .. } => panic!("the children are leaves"),
        });
        assert_eq!(ids, [vec![1, 3], vec![1, 2]]);
    }
}
