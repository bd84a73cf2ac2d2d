//! Checks that a tree can't lose a hit.

use crate::error::ValidationError;
use crate::geometry::Aabb;
use crate::primitive::Primitive;
use crate::statistics::{NodeKind, OutlineNode, TreeOutline};
use crate::structure::AccelerationStructure;

impl TreeOutline {
    /// Checks the invariants of [`validate`](Self::validate) for the outline of
    /// `structure`.
    ///
    /// # Errors
    /// The first [`ValidationError`] found.
    pub fn validate_of(
        &self,
        structure: &impl AccelerationStructure,
    ) -> Result<(), ValidationError> {
        let count = structure.primitive_count();
        self.validate(count, |id| {
            let primitive = structure.primitive(id)?;
            Some(primitive.bounds().gate())
        })?;
        self.validate_lost(count, structure.skipped_count())
    }

    /// Checks that as many primitives of `count` stand in no leaf as were skipped:
    /// more would be lost.
    ///
    /// # Errors
    /// [`ValidationError::Unreferenced`] otherwise.
    pub fn validate_lost(&self, count: usize, skipped: usize) -> Result<(), ValidationError> {
        let counts = self.reference_counts(count);
        let unreferenced = counts.iter().filter(|&&count| count == 0).count();
        if unreferenced == skipped {
            Ok(())
        } else {
            Err(ValidationError::Unreferenced {
                unreferenced,
                skipped,
            })
        }
    }

    /// Checks that the deepest node is as deep as was `recorded`.
    ///
    /// # Errors
    /// [`ValidationError::DepthMismatch`] if it is not.
    pub fn validate_depth(&self, recorded: u32) -> Result<(), ValidationError> {
        let actual = self.depths().into_iter().max().unwrap_or(0);
        if actual == recorded {
            Ok(())
        } else {
            Err(ValidationError::DepthMismatch { actual, recorded })
        }
    }

    /// Checks the invariants that hits rely on: every child lies inside its
    /// parent, no leaf is empty, every primitive with a gate box stands in at
    /// least one leaf, one without in none, and a primitive that stands in one
    /// leaf only is enclosed by it.
    ///
    /// `gate` gives the gate box of each id below `primitives`, `None` for one
    /// that was skipped.
    ///
    /// # Errors
    /// The first [`ValidationError`] found.
    pub fn validate(
        &self,
        primitives: usize,
        gate: impl Fn(u32) -> Option<Aabb>,
    ) -> Result<(), ValidationError> {
        let counts = self.reference_counts(primitives);
        for (id, &count) in (0..).zip(&counts) {
            if (count > 0) != gate(id).is_some() {
                return Err(ValidationError::ReferenceCount { id, count });
            }
        }
        for (position, node) in self.nodes.iter().enumerate() {
            self.validate_enclosure(position, node)?;
            if node.kind == NodeKind::Leaf {
                self.validate_leaf(position, node, &counts, &gate)?;
            }
        }
        Ok(())
    }

    fn reference_counts(&self, primitives: usize) -> Vec<usize> {
        let mut counts = vec![0; primitives];
        for &id in &self.ids {
            counts[id as usize] += 1;
        }
        counts
    }

    fn validate_enclosure(
        &self,
        position: usize,
        node: &OutlineNode,
    ) -> Result<(), ValidationError> {
        let encloses = |parent: u32| self.nodes[parent as usize].bounds.contains(&node.bounds);
        if node.parent.is_none_or(encloses) {
            Ok(())
        } else {
            Err(ValidationError::NotEnclosed { node: position })
        }
    }

    fn validate_leaf(
        &self,
        position: usize,
        node: &OutlineNode,
        counts: &[usize],
        gate: &impl Fn(u32) -> Option<Aabb>,
    ) -> Result<(), ValidationError> {
        if node.references.is_empty() {
            return Err(ValidationError::EmptyLeaf { node: position });
        }
        for reference in node.references.clone() {
            let id = self.ids[reference as usize];
            let is_inside = gate(id).is_some_and(|gate| node.bounds.contains(&gate));
            if counts[id as usize] == 1 && !is_inside {
                return Err(ValidationError::PrimitiveNotEnclosed { node: position, id });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(x: f32) -> Aabb {
        Aabb::new([x, 0.0, 0.0], [x + 1.0, 1.0, 1.0])
    }

    fn outline(leaf_bounds: Aabb, ids: &[u32]) -> TreeOutline {
        let mut outline = TreeOutline::default();
        let root = outline.push_inner(NodeKind::Inner, Aabb::new([0.0; 3], [2.0, 1.0, 1.0]), None);
        outline.push_leaf(leaf_bounds, Some(root), ids.iter().copied());
        outline.push_leaf(unit(1.0), Some(root), [1].into_iter());
        outline
    }

    fn gate(id: u32) -> Option<Aabb> {
        (id < 2).then(|| unit(id as f32))
    }

    #[test]
    fn each_broken_invariant_is_found() {
        assert_eq!(outline(unit(0.0), &[0]).validate(3, gate), Ok(()));
        let cases = [
            (
                outline(unit(-0.5), &[0]),
                ValidationError::NotEnclosed { node: 1 },
            ),
            (
                outline(unit(0.5), &[0]),
                ValidationError::PrimitiveNotEnclosed { node: 1, id: 0 },
            ),
            (
                outline(unit(0.0), &[1]),
                ValidationError::ReferenceCount { id: 0, count: 0 },
            ),
            (
                outline(unit(0.0), &[0, 2]),
                ValidationError::ReferenceCount { id: 2, count: 1 },
            ),
        ];
        for (outline, error) in cases {
            assert_eq!(outline.validate(3, gate), Err(error));
        }
        let whole = outline(unit(0.0), &[0]);
        assert_eq!(whole.validate_lost(3, 1), Ok(()));
        let lost = ValidationError::Unreferenced {
            unreferenced: 1,
            skipped: 0,
        };
        assert_eq!(whole.validate_lost(3, 0), Err(lost));
        let mut with_empty_leaf = outline(unit(0.0), &[0]);
        with_empty_leaf.push_leaf(unit(0.0), Some(0), std::iter::empty());
        assert_eq!(
            with_empty_leaf.validate(3, gate),
            Err(ValidationError::EmptyLeaf { node: 3 })
        );
    }
}
