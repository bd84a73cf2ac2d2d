//! New planes for moved primitives, on the old tree (Lin 2019, section 6, asks how).
//!
//! ```text
//! from the last node to the first, each box from those below it:
//!     leaf:       the box of its primitives
//!     carving:    its planes go to the box of its child
//!     splitting:  the first plane goes to the high bound of the first child,
//!                 the second one to the low bound of the second child
//! ```
//!
//! Every plane encloses what lies below it, so no hit is lost, however the primitives
//! have moved. What a refit can't do is add a plane: a bound that a node inherits from
//! a node above it stays inherited, even where the node has shrunk away from it. A
//! BVH has all six planes of every box and fits them all. So a tree of planes loses
//! more speed by large motion than the BVH that it comes from; where that matters,
//! refit the BVH and convert it again.

use accel_core::layout::LeafStorage;
use accel_core::{Aabb, Primitive, RefitError};

use crate::codec::{Header, Node};
use crate::node_set::NodeSet;
use crate::tree::PlaneTree;

impl<P: Primitive, N: NodeSet> PlaneTree<P, N> {
    /// Takes the primitives again, moved, in the order of the build, and fits all
    /// planes to them. The tree keeps its shape, and nodes the bounds that they share:
    /// the more the primitives have moved against each other, the slower it becomes.
    /// Primitives that the build skipped stay skipped.
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
        if self.bounds.is_none() {
            return Ok(());
        }
        let order = self.depth_first();
        self.check_bounds(&order, primitives)?;
        self.stored.leaves_mut().replace(primitives);
        self.bounds = self.refit_nodes(&order, primitives);
        Ok(())
    }

    /// The positions of all nodes, parents before children, first subtrees before
    /// second ones.
    fn depth_first(&self) -> Vec<usize> {
        let mut order = Vec::new();
        let mut pending = vec![0];
        while let Some(position) = pending.pop() {
            order.push(position);
            pending.extend(self.node(position).children().rev());
        }
        order
    }

    fn check_bounds(&self, order: &[usize], primitives: &[P]) -> Result<(), RefitError> {
        let leaves = order.iter().map(|&position| self.node(position));
        for leaf in leaves.filter(|node| node.header.is_leaf()) {
            for id in self.stored.leaves().leaf_ids(leaf.target as u32) {
                let bounds = primitives[id as usize].bounds();
                if !bounds.is_valid() {
                    return Err(RefitError::InvalidPrimitive { id, bounds });
                }
            }
        }
        Ok(())
    }

    /// Moves planes from the last node to the first; returns the root's box.
    fn refit_nodes(&mut self, order: &[usize], primitives: &[P]) -> Option<Aabb> {
        // Boxes of subtrees whose parent is still to come, the first child's on top.
        let mut boxes: Vec<Aabb> = Vec::new();
        for &position in order.iter().rev() {
            let node = self.node(position);
            if node.header.is_leaf() {
                boxes.push(self.leaf_box(&node, primitives));
            }
            let below = boxes.pop()?;
            let bounds = match node.header {
                Header::Leaf => below,
                Header::Carving { planes, .. } => {
                    let positions = planes.around(&below);
                    self.words
                        .set_planes(position, &positions[..planes.count()]);
                    below
                }
                Header::Splitting { axis, .. } => {
                    let second = boxes.pop()?;
                    let positions = [axis.of(below.max), axis.of(second.min)];
                    self.words.set_planes(position, &positions);
                    below.union(&second)
                }
            };
            boxes.push(bounds);
        }
        boxes.pop()
    }

    fn leaf_box(&self, leaf: &Node, primitives: &[P]) -> Aabb {
        let ids = self.stored.leaves().leaf_ids(leaf.target as u32);
        ids.map(|id| primitives[id as usize].bounds().gate())
            .fold(Aabb::EMPTY, |all, gate| all.union(&gate))
    }
}

#[cfg(test)]
mod tests {
    use accel_core::testing::{families, rays};
    use accel_core::{AccelerationStructure, BruteForce, Triangle};

    use super::*;
    use crate::{BvhBuilder, DualSplitConverter, DualSplitTree, Partitioning};

    fn tree(scene: &[Triangle], partitioning: Partitioning) -> DualSplitTree<Triangle> {
        let converter = DualSplitConverter {
            partitioning,
            ..DualSplitConverter::default()
        };
        let bvh = BvhBuilder::default().build(scene).unwrap();
        converter.convert(&bvh).unwrap()
    }

    /// The planes that refitting finds from below are those that the conversion found
    /// from above.
    #[test]
    fn refitting_to_where_primitives_are_changes_no_word() {
        for family in ["soup-mixed-sizes", "hairball", "duplicates"] {
            let scene = families::find(family).unwrap().scene(3, 700);
            for partitioning in [Partitioning::Identical, Partitioning::Similar] {
                let mut tree = tree(&scene, partitioning);
                let words = tree.node_words().to_vec();
                tree.refit(&scene).unwrap();
                assert!(tree.node_words() == words, "{family} {partitioning:?}");
            }
        }
    }

    #[test]
    fn moved_primitives_are_hit_where_they_are() {
        let scene = families::find("soup-mixed-sizes").unwrap().scene(3, 400);
        // To the place of another one, so that boxes shrink, grow and change sides.
        let mut moved = scene.clone();
        moved.rotate_left(scene.len() / 3);
        let oracle = BruteForce::new(&moved).unwrap();
        for partitioning in [Partitioning::Identical, Partitioning::Similar] {
            let mut tree = tree(&scene, partitioning);
            tree.refit(&moved).unwrap();
            tree.validate().unwrap();
            for ray in rays::mixed(&moved, 5, 400) {
                assert_eq!(tree.closest_hit(&ray), oracle.closest_hit(&ray), "{ray:?}");
            }
        }
    }

    #[test]
    fn what_does_not_fit_leaves_the_tree_as_it_was() {
        let scene = families::find("soup-mixed-sizes").unwrap().scene(3, 50);
        let mut tree = tree(&scene, Partitioning::Similar);
        let words = tree.node_words().to_vec();
        let fewer = tree.refit(&scene[1..]).unwrap_err();
        assert!(matches!(fewer, RefitError::CountMismatch { given: 49, .. }));
        let mut broken = scene.clone();
        broken[7] = Triangle::new([f32::NAN; 3], [0.0; 3], [1.0; 3]);
        let broken = tree.refit(&broken).unwrap_err();
        assert!(matches!(broken, RefitError::InvalidPrimitive { id: 7, .. }));
        assert!(tree.node_words() == words);
    }
}
