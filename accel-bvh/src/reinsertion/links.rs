//! A tree whose nodes know their parents, and can be moved.

use accel_core::Aabb;
use accel_core::build::{BuildNode, BuildTree};

use crate::ChildBounds;

/// A tree by node numbers; the root is number 0 and stays there.
#[derive(Clone)]
pub(super) struct Links {
    nodes: Vec<LinkedNode>,
    ids: Vec<u32>,
}

#[derive(Clone)]
pub(super) struct LinkedNode {
    pub bounds: Aabb,
    /// The root's own number for the root.
    pub parent: u32,
    pub content: Content,
}

#[derive(Clone, Copy)]
pub(super) enum Content {
    Inner([u32; 2]),
    Leaf { first: u32, count: u32 },
}

const ROOT: u32 = 0;

impl Links {
    /// Bytes that a node takes.
    pub(super) const BYTES_PER_NODE: usize = size_of::<LinkedNode>();

    pub(super) fn new(tree: &BuildTree<ChildBounds>, bounds: Aabb) -> Self {
        let (inner, leaves) = tree.count();
        let mut links = Self {
            nodes: Vec::with_capacity(inner + leaves),
            ids: Vec::with_capacity(tree.references()),
        };
        let mut pending = vec![(tree.root(), bounds, ROOT, 0)];
        while let Some((cursor, bounds, parent, side)) = pending.pop() {
            let number = links.nodes.len() as u32;
            let content = match cursor.node() {
                BuildNode::Leaf(ids) => links.push_ids(ids),
                BuildNode::Inner { node, children } => {
                    let [left, right] = node.0;
                    pending.push((children[1], right, number, 1));
                    pending.push((children[0], left, number, 0));
                    Content::Inner([ROOT; 2])
                }
            };
            links.nodes.push(LinkedNode {
                bounds,
                parent,
                content,
            });
            if number != ROOT
                && let Content::Inner(children) = &mut links.nodes[parent as usize].content
            {
                children[side] = number;
            }
        }
        links
    }

    fn push_ids(&mut self, ids: &[u32]) -> Content {
        let first = self.ids.len() as u32;
        self.ids.extend_from_slice(ids);
        Content::Leaf {
            first,
            count: ids.len() as u32,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    pub(super) fn node(&self, number: u32) -> &LinkedNode {
        &self.nodes[number as usize]
    }

    pub(super) fn ids(&self, first: u32, count: u32) -> &[u32] {
        &self.ids[first as usize..(first + count) as usize]
    }

    pub(super) fn is_root(&self, number: u32) -> bool {
        number == ROOT
    }

    /// The other child of `number`'s parent. `number` is not the root.
    pub(super) fn sibling(&self, number: u32) -> u32 {
        match self.node(self.node(number).parent).content {
            Content::Inner([left, right]) if left == number => right,
            Content::Inner([left, _]) => left,
            Content::Leaf { .. } => unreachable!("a parent has children"),
        }
    }

    /// The nodes below the root's children, with the areas of their boxes: a
    /// child of the root has nowhere to go without another root.
    pub(super) fn movable(&self) -> impl Iterator<Item = (f64, u32)> + '_ {
        let numbered = self.nodes.iter().zip(0..);
        let below = numbered.filter(|(node, _)| node.parent != ROOT);
        below.map(|(node, number)| (node.bounds.half_area(), number))
    }

    /// The areas of the boxes of all inner nodes together: what moves change of
    /// the SAH cost.
    pub(super) fn inner_area(&self) -> f64 {
        let is_inner = |node: &&LinkedNode| matches!(node.content, Content::Inner(_));
        let inner = self.nodes.iter().filter(is_inner);
        inner.map(|node| node.bounds.half_area()).sum()
    }

    /// All nodes, parents before children, left subtrees before right ones.
    pub(super) fn depth_first(&self) -> Vec<u32> {
        let mut order = Vec::with_capacity(self.len());
        let mut pending = vec![ROOT];
        while let Some(number) = pending.pop() {
            order.push(number);
            if let Content::Inner([left, right]) = self.node(number).content {
                pending.extend([right, left]);
            }
        }
        order
    }

    /// Edges from the root to the deepest leaf.
    pub(super) fn depth(&self) -> u32 {
        let mut depths = vec![0; self.len()];
        for number in self.depth_first() {
            if !self.is_root(number) {
                depths[number as usize] = depths[self.node(number).parent as usize] + 1;
            }
        }
        depths.into_iter().max().unwrap_or(0)
    }

    /// Takes `node` out, so that its sibling takes the place of their parent,
    /// and makes that parent the parent of `node` and `beside`. Not done if a
    /// node around either place is touched already, or if `beside` has come to
    /// lie below `node`.
    pub(super) fn reinsert(&mut self, node: u32, beside: u32, touched: &mut [bool]) {
        let parent = self.node(node).parent;
        let (sibling, grandparent) = (self.sibling(node), self.node(parent).parent);
        let target = self.node(beside).parent;
        let around = [node, parent, sibling, grandparent, beside, target];
        if around.iter().any(|&number| touched[number as usize]) || self.lies_below(beside, node) {
            return;
        }
        for number in around {
            touched[number as usize] = true;
        }
        self.replace_child(grandparent, parent, sibling);
        self.replace_child(target, beside, parent);
        self.nodes[parent as usize].content = Content::Inner([beside, node]);
        self.nodes[beside as usize].parent = parent;
        self.fit_upward(grandparent);
        self.fit_upward(parent);
    }

    fn lies_below(&self, mut number: u32, ancestor: u32) -> bool {
        while !self.is_root(number) {
            if number == ancestor {
                return true;
            }
            number = self.node(number).parent;
        }
        false
    }

    fn replace_child(&mut self, parent: u32, old: u32, new: u32) {
        if let Content::Inner(children) = &mut self.nodes[parent as usize].content {
            for child in children.iter_mut().filter(|child| **child == old) {
                *child = new;
            }
        }
        self.nodes[new as usize].parent = parent;
    }

    /// Fits the boxes of `number` and all above it to their children.
    fn fit_upward(&mut self, mut number: u32) {
        loop {
            if let Content::Inner([left, right]) = self.node(number).content {
                let bounds = self.node(left).bounds.union(&self.node(right).bounds);
                self.nodes[number as usize].bounds = bounds;
            }
            if self.is_root(number) {
                return;
            }
            number = self.node(number).parent;
        }
    }
}
