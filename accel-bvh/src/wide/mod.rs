//! The wide BVH: eight children a node, whose boxes one test of eight lanes
//! decides.
//!
//! Collapsed from a binary [`Bvh`](crate::Bvh), whatever built it, so that the nodes
//! that stay have the least area ([`WideCollapse`](crate::WideCollapse)). A ray then
//! visits a third as many nodes, each of which is one wait for memory and a few
//! instructions on all children at once.
//!
//! # Source
//! Wald, Benthin and Boulos, *Getting Rid of Packets: Efficient SIMD Single-Ray
//! Traversal using Multi-branching BVHs*, 2008; the collapse is that of Ylitie, Karras
//! and Laine 2017.

mod collapse;
mod node;
mod traversal;

use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::query::Query;
use accel_core::simd::SimdLevel;
use accel_core::statistics::{NodeKind, TraversalStatistics, TreeOutline};
use accel_core::{
    Aabb, AccelerationStructure, PacketTraversal, PreparedRay, Primitive, ValidationError,
};

use node::{Pointer, Target, WideNode};

pub use node::WIDE_NODE_BYTES;

/// A bounding volume hierarchy whose nodes have up to eight children, tested
/// together. Collapsed from any [`Bvh`](crate::Bvh); owns its primitives.
///
/// ```
/// use accel_bvh::{AccelerationStructure, BvhBuilder, RaySegment, Sphere, WideBvh};
/// # fn main() -> Result<(), accel_bvh::BuildError> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let bvh = BvhBuilder::default().build(&spheres)?;
/// let wide = WideBvh::from_bvh(&bvh)?;
/// let ray = RaySegment::new([9.0, 0.0, 0.0], [-1.0, 0.0, 0.0]);
/// assert_eq!(wide.closest_hit(&ray), bvh.closest_hit(&ray));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct WideBvh<P: Primitive, L: LeafStorage<P> = <P as Primitive>::Storage> {
    nodes: Vec<WideNode>,
    stored: StoredPrimitives<P, L>,
    /// `None` where there is nothing to hit.
    root: Option<(Pointer, Aabb)>,
    depth: u32,
}

impl<P: Primitive, L: LeafStorage<P>> WideBvh<P, L> {
    /// Edges from the root to the deepest leaf.
    pub fn depth(&self) -> u32 {
        self.depth
    }

    /// Checks everything that hits rely on: boxes enclose what is below them,
    /// every primitive that was not skipped stands in a leaf, and the recorded
    /// depth is right.
    ///
    /// # Errors
    /// The first [`ValidationError`] found.
    pub fn validate(&self) -> Result<(), ValidationError> {
        let outline = self.outline();
        outline.validate_depth(self.depth)?;
        outline.validate_of(self)
    }

    /// As [`traverse`](AccelerationStructure::traverse), with the vectors of
    /// `level`: the answers are the same bits at every level.
    pub fn traverse_at<Q: Query, S: TraversalStatistics>(
        &self,
        level: SimdLevel,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) {
        traversal::traverse(self, level, ray, query, statistics);
    }
}

impl<P: Primitive, L: LeafStorage<P>> AccelerationStructure for WideBvh<P, L> {
    type Primitive = P;
    type Storage = L;

    #[inline]
    fn traverse<Q: Query, S: TraversalStatistics>(
        &self,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) {
        traversal::traverse(self, SimdLevel::detect(), ray, query, statistics);
    }

    fn bounds(&self) -> Option<Aabb> {
        self.root.map(|(_, bounds)| bounds)
    }

    fn stored(&self) -> &StoredPrimitives<P, L> {
        &self.stored
    }

    fn node_bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice())
    }

    fn outline(&self) -> TreeOutline {
        let mut outline = TreeOutline::default();
        let mut pending = Vec::from_iter(self.root.map(|(root, bounds)| (root, bounds, None)));
        while let Some((pointer, bounds, parent)) = pending.pop() {
            match pointer.target() {
                Target::Nothing => {}
                Target::Leaf(leaf) => {
                    outline.push_leaf(bounds, parent, self.stored.leaves().leaf_ids(leaf));
                }
                Target::Inner(index) => {
                    let position = outline.push_inner(NodeKind::Inner, bounds, parent);
                    let children = self.nodes[index as usize].children().rev();
                    pending.extend(children.map(|(child, bounds)| (child, bounds, Some(position))));
                }
            }
        }
        outline
    }
}

impl<P: Primitive, L: LeafStorage<P>, const N: usize> PacketTraversal<N> for WideBvh<P, L> {}
