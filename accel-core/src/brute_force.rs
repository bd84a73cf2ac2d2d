//! The oracle: every primitive tested against every ray.

use crate::build::InvalidPrimitives;
use crate::error::BuildError;
use crate::geometry::Aabb;
use crate::layout::{LeafStorage, StoredPrimitives};
use crate::primitive::Primitive;
use crate::query::Query;
use crate::ray::PreparedRay;
use crate::reference::gather;
use crate::statistics::{NodeKind, TraversalStatistics, TreeOutline};
use crate::structure::{AccelerationStructure, PacketTraversal};

/// Tests every primitive: slow, simple, and by definition right. All other
/// structures must give its answers, bit for bit.
///
/// Over triangles, `BruteForce<Triangle, TriangleBlocks>` tests sixteen at once.
///
/// ```
/// use accel_core::{AccelerationStructure, BruteForce, RaySegment, Sphere};
/// # fn main() -> Result<(), accel_core::BuildError> {
/// let spheres = [Sphere::new([0.0, 0.0, 5.0], 1.0), Sphere::new([0.0, 0.0, 9.0], 1.0)];
/// let structure = BruteForce::new(&spheres)?;
/// let ray = RaySegment::new([0.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
/// assert_eq!(structure.closest_hit(&ray).unwrap().t, 4.0);
/// assert_eq!(structure.all_hits(&ray).len(), 2);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct BruteForce<P: Primitive, L: LeafStorage<P> = <P as Primitive>::Storage> {
    stored: StoredPrimitives<P, L>,
    /// The one leaf; `None` without primitives.
    leaf: Option<Leaf>,
}

#[derive(Clone, Copy, Debug)]
struct Leaf {
    number: u32,
    bounds: Aabb,
}

impl<P: Primitive> BruteForce<P> {
    /// Over `primitives`, held in their usual storage.
    ///
    /// # Errors
    /// As [`with_storage`](Self::with_storage), rejecting invalid primitives.
    pub fn new(primitives: &[P]) -> Result<Self, BuildError> {
        Self::with_storage(primitives, InvalidPrimitives::Reject)
    }
}

impl<P: Primitive, L: LeafStorage<P>> BruteForce<P, L> {
    /// Over `primitives`, held in storage `L`.
    ///
    /// # Errors
    /// [`BuildError::InvalidPrimitive`] unless `invalid` says to skip such
    /// primitives; [`BuildError::TooManyPrimitives`].
    pub fn with_storage(primitives: &[P], invalid: InvalidPrimitives) -> Result<Self, BuildError> {
        let gathered = gather(primitives, invalid)?;
        let ids: Vec<u32> = gathered
            .references
            .iter()
            .map(|reference| reference.id)
            .collect();
        let mut stored = StoredPrimitives::<P, L>::new(primitives, gathered.skipped, ids.len());
        let leaf = (!ids.is_empty()).then(|| Leaf {
            number: stored.leaves_mut().push_leaf(primitives, &ids),
            bounds: gathered.bounds,
        });
        Ok(Self { stored, leaf })
    }
}

impl<P: Primitive, L: LeafStorage<P>> AccelerationStructure for BruteForce<P, L> {
    type Primitive = P;
    type Storage = L;

    fn traverse<Q: Query, S: TraversalStatistics>(
        &self,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) {
        if let Some(leaf) = self.leaf {
            statistics.visit_node(NodeKind::Leaf, 0);
            let _ = self
                .stored
                .leaves()
                .intersect_leaf(leaf.number, ray, query, statistics);
        }
    }

    fn bounds(&self) -> Option<Aabb> {
        self.leaf.map(|leaf| leaf.bounds)
    }

    fn stored(&self) -> &StoredPrimitives<P, L> {
        &self.stored
    }

    fn node_bytes(&self) -> usize {
        0
    }

    fn outline(&self) -> TreeOutline {
        let mut outline = TreeOutline::default();
        if let Some(leaf) = self.leaf {
            outline.push_leaf(
                leaf.bounds,
                None,
                self.stored.leaves().leaf_ids(leaf.number),
            );
        }
        outline
    }
}

impl<P: Primitive, L: LeafStorage<P>, const N: usize> PacketTraversal<N> for BruteForce<P, L> {}
