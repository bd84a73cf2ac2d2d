//! How leaves hold primitives, and the one loop that turns a leaf into hits.

mod indexed;
mod leaf_ordered;
mod offer;
mod reference_list;
mod stored_primitives;
mod triangle_blocks;

use std::ops::ControlFlow;

use crate::primitive::Primitive;
use crate::query::Query;
use crate::ray::packet::lanes_of;
use crate::ray::{PacketVector, PreparedRay};
use crate::simd::Lanes;
use crate::statistics::TraversalStatistics;

pub use indexed::Indexed;
pub use leaf_ordered::LeafOrdered;
pub use offer::{offer_intersection, offer_primitive, offer_primitive_packet};
pub use reference_list::{MAX_PRIMITIVES, ReferenceList};
pub use stored_primitives::StoredPrimitives;
pub use triangle_blocks::TriangleBlocks;

/// Bytes that a leaf storage holds, by part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StorageBytes {
    /// References: an id and an end marker in four bytes each.
    pub references: usize,
    /// The primitives themselves, and what finds them by id.
    pub primitives: usize,
}

/// The leaves of a tree: each a list of primitives, found by the number that
/// [`push_leaf`](Self::push_leaf) gave.
///
/// A tree stores that number in its leaf node and nothing else: the storage
/// knows where the leaf ends. So the same tree can hold plain copies, indices
/// or SIMD blocks.
pub trait LeafStorage<P: Primitive>: Clone + Send + Sync + Sized {
    /// No leaves yet, for a scene of `primitives` primitives and about
    /// `references` references in leaves.
    fn with_capacity(primitives: &[P], references: usize) -> Self;

    /// Adds a leaf of the primitives with these ids, at least one, and returns
    /// its number. `primitives` is the slice that the structure is built over.
    fn push_leaf(&mut self, primitives: &[P], ids: &[u32]) -> u32;

    /// Tests the primitives of leaf `leaf` and offers the hits to `query`.
    fn intersect_leaf<Q: Query, S: TraversalStatistics>(
        &self,
        leaf: u32,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) -> ControlFlow<()>;

    /// Tests the primitives of leaf `leaf` for the rays of a vector that are in
    /// `mask` and offers their hits to the queries of the same lanes. Afterwards
    /// `rays.t_max` is that of the queries; lanes whose query broke are retired.
    ///
    /// The default takes ray by ray. An override must be `#[inline(always)]`, so
    /// that it uses the vectors of the machine.
    #[inline(always)]
    fn intersect_leaf_packet<L: Lanes, Q: Query, S: TraversalStatistics>(
        &self,
        leaf: u32,
        mask: u32,
        rays: &mut PacketVector<'_, L>,
        queries: &mut [Q],
        statistics: &mut S,
    ) {
        for lane in lanes_of(mask) {
            let (Some(ray), query) = (rays.ray(lane), &mut queries[lane]) else {
                continue;
            };
            match self.intersect_leaf(leaf, ray, query, statistics) {
                ControlFlow::Continue(()) => rays.shorten(lane, query.t_max()),
                ControlFlow::Break(()) => rays.retire(lane),
            }
        }
    }

    /// The ids in leaf `leaf`, in order.
    fn leaf_ids(&self, leaf: u32) -> impl Iterator<Item = u32> + '_;

    /// The primitive with this id, if a leaf holds it.
    fn primitive(&self, id: u32) -> Option<P>;

    /// Takes moved primitives, in the order and number of the original slice.
    fn replace(&mut self, primitives: &[P]);

    /// References in all leaves together.
    fn reference_count(&self) -> usize;

    /// Bytes by part.
    fn bytes(&self) -> StorageBytes;
}
