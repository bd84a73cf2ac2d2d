//! New boxes for moved primitives, on the old tree.

use accel_core::layout::LeafStorage;
use accel_core::{Aabb, Primitive, RefitError};

use crate::Bvh;
use crate::node::{INNER_WORDS, InnerNode, Node, NodePointer};

impl<P: Primitive> Bvh<P> {
    /// Takes the primitives again, moved, in the order of the build, and fits
    /// all boxes to them. Much faster than a build; the tree keeps its shape, so
    /// the more the primitives have moved against each other, the slower it
    /// becomes. Primitives that the build skipped stay skipped.
    ///
    /// # Errors
    /// [`RefitError::CountMismatch`] if there are more or fewer than at the
    /// build; [`RefitError::InvalidPrimitive`] if one in the tree has no finite
    /// bounds any more. Then the tree is as it was.
    pub fn refit(&mut self, primitives: &[P]) -> Result<(), RefitError> {
        if primitives.len() != self.stored.count() {
            return Err(RefitError::CountMismatch {
                given: primitives.len(),
                expected: self.stored.count(),
            });
        }
        let Some(root) = self.root else { return Ok(()) };
        let order = self.depth_first(root.pointer);
        self.check_bounds(&order, primitives)?;
        self.stored.leaves_mut().replace(primitives);
        let root_bounds = self.refit_nodes(&order, primitives);
        if let Some(root) = &mut self.root {
            root.bounds = root_bounds;
        }
        Ok(())
    }

    /// All nodes, parents before children, left subtrees before right ones.
    pub(crate) fn depth_first(&self, root: NodePointer) -> Vec<NodePointer> {
        let mut order = Vec::new();
        let mut pending = vec![root];
        while let Some(pointer) = pending.pop() {
            order.push(pointer);
            if let Node::Inner(offset) = pointer.kind() {
                let [left, right] = self.inner_node(offset).children().pointers();
                pending.extend([right, left]);
            }
        }
        order
    }

    fn check_bounds(&self, order: &[NodePointer], primitives: &[P]) -> Result<(), RefitError> {
        for pointer in order {
            let Node::Leaf(offset) = pointer.kind() else {
                continue;
            };
            for id in self.stored.leaves().leaf_ids(self.leaf_number(offset)) {
                let bounds = primitives[id as usize].bounds();
                if !bounds.is_valid() {
                    return Err(RefitError::InvalidPrimitive { id, bounds });
                }
            }
        }
        Ok(())
    }

    /// Recomputes boxes from the last node to the first; returns the root's.
    fn refit_nodes(&mut self, order: &[NodePointer], primitives: &[P]) -> Aabb {
        // Boxes of subtrees whose parent is still to come, the left one on top.
        let mut boxes: Vec<Aabb> = Vec::new();
        for &pointer in order.iter().rev() {
            let bounds = match pointer.kind() {
                Node::Leaf(offset) => self
                    .stored
                    .leaves()
                    .leaf_ids(self.leaf_number(offset))
                    .map(|id| primitives[id as usize].bounds().gate())
                    .fold(Aabb::EMPTY, |all, gate| all.union(&gate)),
                Node::Inner(offset) => {
                    let left = boxes.pop().unwrap_or(Aabb::EMPTY);
                    let right = boxes.pop().unwrap_or(Aabb::EMPTY);
                    self.set_child_bounds(offset, [left, right]);
                    left.union(&right)
                }
            };
            boxes.push(bounds);
        }
        boxes.pop().unwrap_or(Aabb::EMPTY)
    }

    fn set_child_bounds(&mut self, offset: u32, bounds: [Aabb; 2]) {
        let children = self.inner_node(offset).children();
        let words = InnerNode::encode(&bounds, children);
        self.words[offset as usize..offset as usize + INNER_WORDS].copy_from_slice(&words);
    }
}
