//! The shape of a tree, independent of how its nodes are encoded.

use std::ops::Range;

use super::NodeKind;
use crate::geometry::Aabb;

/// A tree as a list of nodes, each after its parent. Every structure can
/// produce one; statistics, validation and drawings read it.
#[derive(Clone, Debug, Default)]
pub struct TreeOutline {
    /// The nodes, the root first; none for an empty scene.
    pub nodes: Vec<OutlineNode>,
    /// The primitive ids of all leaves; leaves hold ranges of it.
    pub ids: Vec<u32>,
    /// Whether nodes are cells that boxes merely enclose, siblings sharing nothing
    /// but their faces: then nothing overlaps, whatever the boxes do.
    pub divides_space: bool,
}

/// A node of a [`TreeOutline`].
#[derive(Clone, Debug)]
pub struct OutlineNode {
    /// What it is.
    pub kind: NodeKind,
    /// The box that a ray must meet to visit it, or one around its cell.
    pub bounds: Aabb,
    /// Half of its surface area, which may be less than that of its bounds.
    pub half_area: f64,
    /// Position of the parent in the list; `None` for the root.
    pub parent: Option<u32>,
    /// Of a leaf, the range of its references in [`TreeOutline::ids`]; empty
    /// otherwise.
    pub references: Range<u32>,
}

impl TreeOutline {
    /// Adds an inner node and returns its position.
    pub fn push_inner(&mut self, kind: NodeKind, bounds: Aabb, parent: Option<u32>) -> u32 {
        let end = self.ids.len() as u32;
        self.push(kind, bounds, parent, end..end)
    }

    /// Adds a leaf and returns its position.
    pub fn push_leaf(
        &mut self,
        bounds: Aabb,
        parent: Option<u32>,
        ids: impl Iterator<Item = u32>,
    ) -> u32 {
        let first = self.ids.len() as u32;
        self.ids.extend(ids);
        let end = self.ids.len() as u32;
        self.push(NodeKind::Leaf, bounds, parent, first..end)
    }

    fn push(
        &mut self,
        kind: NodeKind,
        bounds: Aabb,
        parent: Option<u32>,
        references: Range<u32>,
    ) -> u32 {
        self.nodes.push(OutlineNode {
            kind,
            bounds,
            half_area: bounds.half_area(),
            parent,
            references,
        });
        self.nodes.len() as u32 - 1
    }

    /// The depth of every node, the root's being 0.
    pub fn depths(&self) -> Vec<u32> {
        let mut depths: Vec<u32> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            depths.push(node.parent.map_or(0, |parent| depths[parent as usize] + 1));
        }
        depths
    }

    /// The positions of every node's children, in order.
    pub fn children(&self) -> Vec<Vec<u32>> {
        let mut children = vec![Vec::new(); self.nodes.len()];
        for (position, node) in (0..).zip(&self.nodes) {
            if let Some(parent) = node.parent {
                children[parent as usize].push(position);
            }
        }
        children
    }
}
