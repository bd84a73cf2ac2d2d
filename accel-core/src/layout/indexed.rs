//! One copy of each primitive, found by id.

use std::ops::ControlFlow;

use super::{LeafStorage, ReferenceList, StorageBytes, offer_primitive, offer_primitive_packet};
use crate::primitive::Primitive;
use crate::query::Query;
use crate::ray::{PacketVector, PreparedRay};
use crate::simd::Lanes;
use crate::statistics::TraversalStatistics;

/// References into one array of primitives in their original order: for large
/// primitive types, or trees that reference a primitive many times.
#[derive(Clone, Debug)]
pub struct Indexed<P> {
    references: ReferenceList,
    primitives: Vec<P>,
    /// By id, whether a leaf holds it: skipped primitives have none.
    is_held: Vec<bool>,
}

impl<P: Primitive> LeafStorage<P> for Indexed<P> {
    fn with_capacity(primitives: &[P], references: usize) -> Self {
        Self {
            references: ReferenceList::with_capacity(references),
            primitives: primitives.to_vec(),
            is_held: vec![false; primitives.len()],
        }
    }

    fn push_leaf(&mut self, _: &[P], ids: &[u32]) -> u32 {
        for &id in ids {
            self.is_held[id as usize] = true;
        }
        self.references.push_leaf(ids)
    }

    #[inline]
    fn intersect_leaf<Q: Query, S: TraversalStatistics>(
        &self,
        leaf: u32,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) -> ControlFlow<()> {
        for id in self.references.leaf(leaf) {
            statistics.test_primitives(1);
            offer_primitive(&self.primitives[id as usize], id, ray, query)?;
        }
        ControlFlow::Continue(())
    }

    #[inline(always)]
    fn intersect_leaf_packet<L: Lanes, Q: Query, S: TraversalStatistics>(
        &self,
        leaf: u32,
        mut mask: u32,
        rays: &mut PacketVector<'_, L>,
        queries: &mut [Q],
        statistics: &mut S,
    ) {
        for id in self.references.leaf(leaf) {
            let primitive = &self.primitives[id as usize];
            statistics.test_primitives(mask.count_ones());
            mask = offer_primitive_packet(primitive, id, mask, rays, queries);
            if mask == 0 {
                return;
            }
        }
    }

    fn leaf_ids(&self, leaf: u32) -> impl Iterator<Item = u32> + '_ {
        self.references.leaf(leaf)
    }

    fn primitive(&self, id: u32) -> Option<P> {
        let is_held = *self.is_held.get(id as usize)?;
        is_held.then(|| self.primitives[id as usize].clone())
    }

    fn replace(&mut self, primitives: &[P]) {
        self.primitives.clone_from_slice(primitives);
    }

    fn reference_count(&self) -> usize {
        self.references.len()
    }

    fn bytes(&self) -> StorageBytes {
        StorageBytes {
            references: self.references.bytes(),
            primitives: size_of_val(self.primitives.as_slice())
                + size_of_val(self.is_held.as_slice()),
        }
    }
}
