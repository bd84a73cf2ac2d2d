//! The Compact BVH: each plane of a box is stored once.
//!
//! Of the twelve planes that bound two children at least six are planes of their
//! parent: on every side of every axis one child reaches as far as the parent. A
//! node stores the other child's plane alone, six in all, and a bit for each that
//! tells whose it is. A ray carries the interval that it has inside the parent, so
//! an inherited plane needs no test.
//!
//! # Source
//! Fabianowski and Dingliana, *Compact BVH Storage for Ray Tracing and Photon
//! Mapping*, Eurographics Ireland 2009. Its comparison with other structures is
//! that of Lin, Shkurko, Mallett and Yuksel, *Dual-Split Trees*, 2019.

mod conversion;
mod node;
mod traversal;

use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::query::Query;
use accel_core::statistics::{NodeKind, TraversalStatistics, TreeOutline};
use accel_core::{
    Aabb, AccelerationStructure, PacketTraversal, PreparedRay, Primitive, ValidationError,
};

use node::{CompactNode, Pointer, Target};

pub use node::COMPACT_NODE_BYTES;

/// A bounding volume hierarchy whose nodes take 32 bytes, their leaves included.
/// Converted from any [`Bvh`](crate::Bvh), whose leaves a ray visits in the same
/// order; owns its primitives.
///
/// ```
/// use accel_bvh::{AccelerationStructure, BvhBuilder, CompactBvh, RaySegment, Sphere};
/// # fn main() -> Result<(), accel_bvh::BuildError> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let bvh = BvhBuilder::default().build(&spheres)?;
/// let compact = CompactBvh::from_bvh(&bvh)?;
/// let ray = RaySegment::new([9.0, 0.0, 0.0], [-1.0, 0.0, 0.0]);
/// assert_eq!(compact.closest_hit(&ray), bvh.closest_hit(&ray));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct CompactBvh<P: Primitive> {
    nodes: Vec<CompactNode>,
    stored: StoredPrimitives<P>,
    /// `None` where there is nothing to hit.
    root: Option<(Pointer, Aabb)>,
    depth: u32,
}

impl<P: Primitive> CompactBvh<P> {
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
}

impl<P: Primitive> AccelerationStructure for CompactBvh<P> {
    type Primitive = P;
    type Storage = P::Storage;

    #[inline]
    fn traverse<Q: Query, S: TraversalStatistics>(
        &self,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) {
        traversal::traverse(self, ray, query, statistics);
    }

    fn bounds(&self) -> Option<Aabb> {
        self.root.map(|(_, bounds)| bounds)
    }

    fn stored(&self) -> &StoredPrimitives<P> {
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
                Target::Leaf(leaf) => {
                    outline.push_leaf(bounds, parent, self.stored.leaves().leaf_ids(leaf));
                }
                Target::Inner(index) => {
                    let node = &self.nodes[index as usize];
                    let position = outline.push_inner(NodeKind::Inner, bounds, parent);
                    let children = node.children().into_iter().zip(node.child_bounds(&bounds));
                    pending.extend(
                        children
                            .rev()
                            .map(|(child, bounds)| (child, bounds, Some(position))),
                    );
                }
            }
        }
        outline
    }
}

impl<P: Primitive, const N: usize> PacketTraversal<N> for CompactBvh<P> {}
