//! Checks that a tree can't lose a hit.

use accel_core::geometry::rounding;
use accel_core::glam::Vec3;
use accel_core::layout::LeafStorage;
use accel_core::structure::AccelerationStructure;
use accel_core::{Aabb, Clip, ValidationError};

use crate::KdTree;
use crate::node::Leaf;
use crate::part::displacement_of;

impl<P: Clip> KdTree<P> {
    /// Checks the invariants that hits rely on: every primitive stands in each
    /// leaf whose cell holds part of it, one that was skipped stands in none, and
    /// the depth is that recorded. Parts so near to the rim of a cell that rounding may
    /// have placed them beyond it, or in a cell as thin as that, are not looked for. Takes
    /// as long as a build or several times as long.
    ///
    /// # Errors
    /// The first [`ValidationError`] found.
    pub fn validate(&self) -> Result<(), ValidationError> {
        let mut actual = 0;
        self.walk(|_, _, depth| {
            actual = actual.max(depth);
            true
        });
        if actual != self.depth {
            return Err(ValidationError::DepthMismatch {
                actual,
                recorded: self.depth,
            });
        }
        self.outline()
            .validate_lost(self.primitive_count(), self.skipped_count())?;
        let references = self.references();
        (0..self.primitive_count() as u32)
            .filter_map(|id| Some((id, self.primitive(id)?)))
            .try_for_each(|(id, primitive)| self.validate_primitive(id, &primitive, &references))
    }

    /// The ids and leaves of all references, in order.
    fn references(&self) -> Vec<(u32, u32)> {
        let leaves = self.nodes.iter().filter_map(|node| match node.as_leaf() {
            Some(Leaf::Of(leaf)) => Some(leaf),
            _ => None,
        });
        let stored = self.stored.leaves();
        let of_leaf = |leaf| stored.leaf_ids(leaf).map(move |id| (id, leaf));
        let mut references: Vec<(u32, u32)> = leaves.flat_map(of_leaf).collect();
        references.sort_unstable();
        references
    }

    /// Every leaf with part of the primitive well inside references it.
    fn validate_primitive(
        &self,
        id: u32,
        primitive: &P,
        references: &[(u32, u32)],
    ) -> Result<(), ValidationError> {
        let is_held = |leaf| match leaf {
            Leaf::Empty => false,
            Leaf::Of(leaf) => references.binary_search(&(id, leaf)).is_ok(),
        };
        let rim = 2.0 * displacement_of(primitive).max(self.slack.0);
        let mut result = Ok(());
        self.walk(|index, cell, _| {
            let inside = shrunk(cell, rim);
            let is_met = !inside.is_empty() && primitive.clip(&inside).is_some();
            if let (true, Some(leaf)) = (is_met, self.nodes[index as usize].as_leaf())
                && !is_held(leaf)
                && result.is_ok()
            {
                let node = index as usize;
                result = Err(ValidationError::PrimitiveNotEnclosed { node, id });
            }
            reaches(cell, primitive)
        });
        result
    }
}

/// The cell without a rim of this width, and at least of one unit in the last
/// place; perhaps empty.
fn shrunk(cell: &Aabb, rim: f64) -> Aabb {
    let (low, high) = (cell.min.as_dvec3() + rim, cell.max.as_dvec3() - rim);
    let next_up = Vec3::from_array(cell.min.to_array().map(f32::next_up));
    let next_down = Vec3::from_array(cell.max.to_array().map(f32::next_down));
    Aabb {
        min: rounding::vec3_up(low).max(next_up),
        max: rounding::vec3_down(high).min(next_down),
    }
}

/// Whether some leaf below this cell may hold the primitive.
fn reaches<P: Clip>(cell: &Aabb, primitive: &P) -> bool {
    !cell.intersection(&primitive.bounds()).is_empty()
}
