//! From two children a node to eight.

use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::{Aabb, AccelerationStructure, BuildError, Primitive};

use super::WideBvh;
use super::node::{Pointer, Target, WIDTH, WideNode};
use crate::{Bvh, BvhNode, KeptNode, WideCollapse};

impl<P: Primitive> WideBvh<P> {
    /// The wide form of `bvh`, whoever built that. The primitives in its leaves
    /// are copied; hits name them as before.
    ///
    /// # Errors
    /// As [`with_storage`](Self::with_storage).
    pub fn from_bvh(bvh: &Bvh<P>) -> Result<Self, BuildError> {
        Self::with_storage(bvh)
    }
}

impl<P: Primitive, L: LeafStorage<P>> WideBvh<P, L> {
    /// The wide form of `bvh`, its leaves in storage `L`.
    ///
    /// # Errors
    /// [`BuildError::OffsetOverflow`] if the tree has more than 2^31 - 1 nodes or
    /// leaf numbers.
    pub fn with_storage(bvh: &Bvh<P>) -> Result<Self, BuildError> {
        let (stored, primitives) = AccelerationStructure::stored(bvh).emptied();
        let kept = WideCollapse::new(bvh);
        let mut collapse = Collapse {
            bvh,
            kept: &kept,
            primitives,
            nodes: Vec::new(),
            stored,
            depth: 0,
        };
        let root = kept.root().map(|root| collapse.run(root)).transpose()?;
        Ok(Self {
            nodes: collapse.nodes,
            stored: collapse.stored,
            root,
            depth: collapse.depth,
        })
    }
}

struct Collapse<'a, P: Primitive, L: LeafStorage<P>> {
    bvh: &'a Bvh<P>,
    kept: &'a WideCollapse<'a, P, WIDTH>,
    primitives: Vec<P>,
    nodes: Vec<WideNode>,
    stored: StoredPrimitives<P, L>,
    depth: u32,
}

/// An inner node of the binary tree that becomes a wide one.
struct Pending {
    node: KeptNode,
    depth: u32,
    /// The wide node and the place in it that name this one.
    parent: Option<(usize, usize)>,
}

impl<P: Primitive, L: LeafStorage<P>> Collapse<'_, P, L> {
    /// Writes all nodes in depth-first order; returns the root.
    fn run(&mut self, root: KeptNode) -> Result<(Pointer, Aabb), BuildError> {
        let bounds = root.bounds;
        if let BvhNode::Leaf(leaf) = self.bvh.node(root.handle) {
            return Ok((self.leaf(leaf)?, bounds));
        }
        let mut pending = vec![Pending {
            node: root,
            depth: 0,
            parent: None,
        }];
        while let Some(next) = pending.pop() {
            let index = self.nodes.len();
            if let Some((parent, place)) = next.parent {
                let pointer = Pointer::new(Target::Inner(index as u32))?;
                self.nodes[parent].set_child(place, pointer);
            }
            let children = self.kept.children(&next.node);
            let encoded = self.encode(&children)?;
            self.nodes.push(encoded);
            let depth = next.depth + 1;
            self.depth = self.depth.max(depth);
            let inner = children.into_iter().enumerate().rev();
            let inner = inner.filter(|(_, child)| !child.handle.is_leaf());
            pending.extend(inner.map(|(place, node)| Pending {
                node,
                depth,
                parent: Some((index, place)),
            }));
        }
        Ok((Pointer::new(Target::Inner(0))?, bounds))
    }

    /// The node of these children; inner ones are named when they are written.
    fn encode(&mut self, children: &[KeptNode]) -> Result<WideNode, BuildError> {
        let encoded = children.iter().map(|child| {
            let pointer = match self.bvh.node(child.handle) {
                BvhNode::Leaf(leaf) => self.leaf(leaf)?,
                BvhNode::Inner { .. } => Pointer::new(Target::Nothing)?,
            };
            Ok((pointer, child.bounds))
        });
        Ok(WideNode::new(
            &encoded.collect::<Result<Vec<_>, BuildError>>()?,
        ))
    }

    /// Copies a leaf of the binary tree.
    fn leaf(&mut self, leaf: u32) -> Result<Pointer, BuildError> {
        let leaves = AccelerationStructure::stored(self.bvh).leaves();
        let ids: Vec<u32> = leaves.leaf_ids(leaf).collect();
        let leaf = self.stored.leaves_mut().push_leaf(&self.primitives, &ids);
        Pointer::new(Target::Leaf(leaf))
    }
}
