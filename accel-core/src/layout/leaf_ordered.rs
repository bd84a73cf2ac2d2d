//! Copies of the primitives in leaf order.

use std::ops::ControlFlow;

use super::{LeafStorage, ReferenceList, StorageBytes, offer_primitive, offer_primitive_packet};
use crate::primitive::Primitive;
use crate::query::Query;
use crate::ray::{PacketVector, PreparedRay};
use crate::simd::Lanes;
use crate::statistics::TraversalStatistics;

/// One copy of a primitive per reference, in leaf order: a leaf is read in one
/// run of memory.
#[derive(Clone, Debug)]
pub struct LeafOrdered<P> {
    references: ReferenceList,
    copies: Vec<P>,
    /// By id, the position of one of its copies; 0 where no leaf holds the id,
    /// which the reference there then tells.
    positions: Vec<u32>,
}

impl<P: Primitive> LeafStorage<P> for LeafOrdered<P> {
    fn with_capacity(primitives: &[P], references: usize) -> Self {
        Self {
            references: ReferenceList::with_capacity(references),
            copies: Vec::with_capacity(references),
            positions: vec![0; primitives.len()],
        }
    }

    fn push_leaf(&mut self, primitives: &[P], ids: &[u32]) -> u32 {
        let first = self.references.push_leaf(ids);
        for (position, &id) in (first..).zip(ids) {
            self.copies.push(primitives[id as usize].clone());
            self.positions[id as usize] = position;
        }
        first
    }

    // A call of its own keeps the kernel's registers out of the loop over nodes:
    // inlined, coherent rays were 0.9 times as fast.
    #[inline(never)]
    fn intersect_leaf<Q: Query, S: TraversalStatistics>(
        &self,
        leaf: u32,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) -> ControlFlow<()> {
        let copies = &self.copies[leaf as usize..];
        for (id, primitive) in self.references.leaf(leaf).zip(copies) {
            statistics.test_primitives(1);
            offer_primitive(primitive, id, ray, query)?;
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
        let copies = &self.copies[leaf as usize..];
        for (id, primitive) in self.references.leaf(leaf).zip(copies) {
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
        let position = *self.positions.get(id as usize)? as usize;
        let is_held = position < self.references.len() && self.references.id(position) == id;
        is_held.then(|| self.copies[position].clone())
    }

    fn replace(&mut self, primitives: &[P]) {
        for (position, copy) in self.copies.iter_mut().enumerate() {
            copy.clone_from(&primitives[self.references.id(position) as usize]);
        }
    }

    fn reference_count(&self) -> usize {
        self.references.len()
    }

    fn bytes(&self) -> StorageBytes {
        StorageBytes {
            references: self.references.bytes(),
            primitives: size_of_val(self.copies.as_slice())
                + size_of_val(self.positions.as_slice()),
        }
    }
}
