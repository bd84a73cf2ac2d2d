//! Wide dual-split trees: eight children a node, and for each of them only the planes
//! that it does not share with the node (Lin 2019, section 6, leaves wide trees to
//! future work).
//!
//! A wide BVH stores six planes for every child, though most of them are planes of
//! the node's own box. Here a ray carries the interval that it has inside a node, as
//! in every dual-split tree, and a child has four planes that cut this interval
//! further, each on an axis and a side of its own. What more there would be to cut
//! stays for the nodes below, or uncut: the four planes that leave least are kept.
//!
//! Eight children are tested at once. The planes of one row belong to eight different
//! axes and sides, so what meeting them takes of the ray is picked from a table of
//! eight numbers by three bits a plane: one instruction a row where the machine has
//! registers of eight lanes.

mod conversion;
mod node;
mod traversal;

use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::query::Query;
use accel_core::simd::SimdLevel;
use accel_core::statistics::{NodeKind, TraversalStatistics, TreeOutline};
use accel_core::{
    Aabb, AccelerationStructure, PacketTraversal, PreparedRay, Primitive, ValidationError,
};

use node::{PADDING, Target, WideNode, WidePointer};

/// A tree of nodes with up to eight children and four planes for each. Converted from
/// any [`Bvh`](crate::Bvh); owns its primitives. It is neither refitted nor saved: both
/// are done to the BVH, which converts in less time than it builds.
///
/// ```
/// use accel_dualsplit::{
///     AccelerationStructure, BvhBuilder, RaySegment, Sphere, WideDualSplitTree,
/// };
/// # fn main() -> Result<(), accel_dualsplit::BuildError> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let bvh = BvhBuilder::default().build(&spheres)?;
/// let wide = WideDualSplitTree::from_bvh(&bvh)?;
/// let ray = RaySegment::new([9.0, 0.0, 0.0], [-1.0, 0.0, 0.0]);
/// assert_eq!(wide.closest_hit(&ray), bvh.closest_hit(&ray));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct WideDualSplitTree<P: Primitive> {
    /// The nodes, and padding behind them.
    words: Vec<u32>,
    stored: StoredPrimitives<P>,
    /// `None` where there is nothing to hit.
    root: Option<(WidePointer, Aabb)>,
}

impl<P: Primitive> WideDualSplitTree<P> {
    /// Checks everything that hits rely on: every node's region encloses the
    /// primitives below it, and every primitive that was not skipped stands in a leaf.
    ///
    /// # Errors
    /// The first [`ValidationError`] found.
    pub fn validate(&self) -> Result<(), ValidationError> {
        self.outline().validate_of(self)
    }
}

impl<P: Primitive> AccelerationStructure for WideDualSplitTree<P> {
    type Primitive = P;
    type Storage = P::Storage;

    #[inline]
    fn traverse<Q: Query, S: TraversalStatistics>(
        &self,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) {
        traversal::traverse_at(SimdLevel::detect(), self, ray, query, statistics);
    }

    fn bounds(&self) -> Option<Aabb> {
        self.root.map(|(_, bounds)| bounds)
    }

    fn stored(&self) -> &StoredPrimitives<P> {
        &self.stored
    }

    fn node_bytes(&self) -> usize {
        size_of_val(&self.words[PADDING..])
    }

    fn outline(&self) -> TreeOutline {
        let mut outline = TreeOutline::default();
        let mut pending = Vec::from_iter(self.root.map(|(root, bounds)| (root, bounds, None)));
        while let Some((pointer, bounds, parent)) = pending.pop() {
            match pointer.target() {
                Target::Leaf(leaf) => {
                    outline.push_leaf(bounds, parent, self.stored.leaves().leaf_ids(leaf));
                }
                Target::Inner(position) => {
                    let node = WideNode::at(&self.words, position);
                    let position = outline.push_inner(NodeKind::Inner, bounds, parent);
                    let children = (0..node.children()).rev();
                    pending.extend(
                        children.map(|lane| {
                            (node.child(lane), node.region(lane, bounds), Some(position))
                        }),
                    );
                }
            }
        }
        outline
    }
}

impl<P: Primitive, const N: usize> PacketTraversal<N> for WideDualSplitTree<P> {}
