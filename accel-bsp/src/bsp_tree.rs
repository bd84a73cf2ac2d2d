//! The tree.

use accel_core::geometry::rounding;
use accel_core::glam::Vec4;
use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::query::Query;
use accel_core::statistics::{NodeKind as StatisticsKind, TraversalStatistics, TreeOutline};
use accel_core::{Aabb, AccelerationStructure, PreparedRay, Primitive};

use crate::crossing::{PlaneLimits, Tolerance};
use crate::node::{Node, NodeKind};
use crate::nodes::Nodes;
use crate::plane_tracking::Untracked;
use crate::polytope::{Polytope, Reach};
use crate::traversal::traverse;

/// A general BSP tree in nodes of 8 bytes, and 16 for each plane that is not
/// axis-aligned. Made by [`BspBuilder`](crate::BspBuilder); owns its primitives.
#[derive(Clone, Debug)]
pub struct BspTree<P: Primitive> {
    pub(crate) nodes: Nodes,
    pub(crate) stored: StoredPrimitives<P>,
    /// `None` where there is nothing to hit.
    pub(crate) bounds: Option<Aabb>,
    /// Edges from the root to the deepest leaf.
    pub(crate) depth: u32,
    /// From [`Nodes::largest`].
    pub(crate) largest: Vec4,
}

/// How many nodes and leaves of each kind a [`BspTree`] has: the rows of Table 3
/// of the paper.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BspShape {
    /// Nodes split orthogonally to an axis.
    pub axis_aligned: usize,
    /// Nodes split by other planes, or by such with a slack of their own.
    pub general: usize,
    /// By the number of primitives, the number of leaves that hold as many; those of
    /// none take no node.
    pub leaves_by_size: Vec<usize>,
    /// Of the leaves of one primitive, those that the traversal itself can answer
    /// (section 4.3).
    pub bounded_leaves: usize,
}

impl<P: Primitive> BspTree<P> {
    /// Edges from the root to the deepest leaf.
    pub fn depth(&self) -> u32 {
        self.depth
    }

    /// Whether both trees have the same nodes in the same order.
    pub fn has_same_nodes(&self, other: &Self) -> bool {
        self.nodes == other.nodes
    }

    /// The ids of a leaf; none of an inner node.
    pub(crate) fn ids_of(&self, node: &Node) -> impl Iterator<Item = u32> + '_ {
        let leaf = node.leaf_number().into_iter();
        leaf.flat_map(|leaf| self.stored.leaves().leaf_ids(leaf))
    }

    /// What a ray must know of all planes.
    #[inline]
    pub(crate) fn plane_limits(&self) -> PlaneLimits {
        PlaneLimits {
            general: self.largest,
            slacks: self.nodes.slacks(),
        }
    }

    /// Counts nodes and leaves by kind.
    pub fn shape(&self) -> BspShape {
        let mut shape = BspShape::default();
        for node in self.nodes.iter() {
            let size = match node.kind() {
                NodeKind::AxisAligned { .. } => {
                    shape.axis_aligned += 1;
                    continue;
                }
                NodeKind::General { .. } => {
                    shape.general += 1;
                    continue;
                }
                NodeKind::Leaf(leaf) => self.stored.leaves().leaf_ids(leaf).count(),
                NodeKind::PlanarLeaf { .. } => 1,
                NodeKind::BoundedLeaf { .. } => {
                    shape.bounded_leaves += 1;
                    1
                }
            };
            if shape.leaves_by_size.len() <= size {
                shape.leaves_by_size.resize(size + 1, 0);
            }
            shape.leaves_by_size[size] += 1;
        }
        if let Some(empty) = shape.leaves_by_size.first_mut() {
            // Every part but the whole is one of two of an inner node.
            *empty = 2 * (shape.axis_aligned + shape.general) + 1 - self.nodes.len();
        }
        shape
    }
}

impl<P: Primitive> AccelerationStructure for BspTree<P> {
    type Primitive = P;
    type Storage = P::Storage;

    #[inline]
    fn traverse<Q: Query, S: TraversalStatistics>(
        &self,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) {
        traverse::<_, Untracked, _, _>(self, ray, query, statistics, Tolerance::SAFE);
    }

    fn bounds(&self) -> Option<Aabb> {
        self.bounds
    }

    fn stored(&self) -> &StoredPrimitives<P> {
        &self.stored
    }

    fn node_bytes(&self) -> usize {
        self.nodes.bytes()
    }

    /// Areas are those of the cells, bounds the boxes around them.
    fn outline(&self) -> TreeOutline {
        let mut outline = TreeOutline {
            divides_space: true,
            ..TreeOutline::default()
        };
        let root = self
            .bounds
            .map(|bounds| (Some(0), Polytope::of_box(&bounds), None));
        let mut pending: Vec<(Option<u32>, Polytope, Option<u32>)> = root.into_iter().collect();
        while let Some((index, cell, parent)) = pending.pop() {
            // A part that holds nothing has no node.
            let node = index.map(|index| self.nodes.node(index));
            let [low, high] = cell.bounds();
            let bounds = Aabb {
                min: rounding::vec3_down(low),
                max: rounding::vec3_up(high),
            };
            let position = match node.and_then(|node| Some((node, self.nodes.split_plane(node)?))) {
                Some((node, plane)) => {
                    let position = outline.push_inner(StatisticsKind::Inner, bounds, parent);
                    // The planes of a loaded tree may miss their cells.
                    let parts = cell.cut(&plane, Reach::Slack);
                    let [behind, in_front] = parts.unwrap_or_else(|_| [cell.clone(), cell.clone()]);
                    pending.push((node.child(1), in_front, Some(position)));
                    pending.push((node.child(0), behind, Some(position)));
                    position
                }
                None => {
                    let ids = node.into_iter().flat_map(|node| self.ids_of(node));
                    outline.push_leaf(bounds, parent, ids)
                }
            };
            outline.nodes[position as usize].half_area = 0.5 * cell.area();
        }
        outline
    }
}
