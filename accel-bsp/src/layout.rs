//! From a build tree to nodes.

use accel_core::build::{BuildNode, BuildTree, Cursor};
use accel_core::glam::{Vec3, Vec4};
use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::{Aabb, BuildError, Polygonal, Primitive};

use crate::bsp_tree::largest_of;
use crate::candidates::planes_of;
use crate::node::{MAX_INDEX, NODE_BYTES, Node};
use crate::pieces::{margin, pad_of};
use crate::split_plane::SplitPlane;
use crate::{BspBuilder, BspTree, SingleLeaves};

impl<P: Primitive> BspTree<P> {
    /// The tree over nothing that can be hit.
    pub(crate) fn empty(primitives: &[P], skipped: usize) -> Self {
        Self {
            nodes: Vec::new(),
            stored: StoredPrimitives::new(primitives, skipped, 0),
            bounds: None,
            depth: 0,
            largest: Vec4::ZERO,
        }
    }
}

impl<P: Polygonal> BspTree<P> {
    /// Packs a build tree in depth-first order, siblings adjacent, without its empty
    /// leaves.
    pub(crate) fn pack(
        builder: &BspBuilder,
        primitives: &[P],
        tree: &BuildTree<SplitPlane>,
        bounds: Aabb,
        skipped: usize,
    ) -> Result<Self, BuildError> {
        let (inner, leaves) = tree.count();
        let references = tree.references();
        let needed = (inner + leaves).max(references);
        if needed > MAX_INDEX {
            return Err(BuildError::OffsetOverflow {
                needed,
                limit: MAX_INDEX,
            });
        }
        let storage = references * (size_of::<P>() + 2 * size_of::<u32>());
        let bytes = tree.bytes() + (inner + leaves) * NODE_BYTES + storage;
        builder.budget.check_bytes(bytes)?;
        let mut packed = Self {
            nodes: Vec::with_capacity(inner + leaves),
            stored: StoredPrimitives::new(primitives, skipped, references),
            bounds: Some(bounds),
            depth: 0,
            largest: Vec4::ZERO,
        };
        packed.nodes.push(Node::leaf(0));
        let mut pending = vec![(tree.root(), 0, 0)];
        while let Some((cursor, position, depth)) = pending.pop() {
            packed.depth = packed.depth.max(depth);
            packed.nodes[position] = match cursor.node() {
                BuildNode::Leaf(ids) => packed.leaf(builder, primitives, ids),
                BuildNode::Inner { node, children } => {
                    let are_there = children.each_ref().map(holds_any);
                    let inner = Node::inner(node, packed.nodes.len() as u32, are_there);
                    for side in [1, 0] {
                        if let Some(place) = inner.child(side) {
                            pending.push((children[side as usize], place as usize, depth + 1));
                            packed.nodes.push(Node::leaf(0));
                        }
                    }
                    inner
                }
            };
        }
        packed.nodes.shrink_to_fit();
        packed.largest = largest_of(&packed.nodes);
        if builder.single_leaves == SingleLeaves::Bounded {
            packed.mark_bounded_leaves(primitives);
        }
        Ok(packed)
    }

    fn leaf(&mut self, builder: &BspBuilder, primitives: &[P], ids: &[u32]) -> Node {
        let leaf = self.stored.leaves_mut().push_leaf(primitives, ids);
        let plane = match ids {
            [id] if builder.single_leaves == SingleLeaves::Planar => {
                plane_around(&primitives[*id as usize])
            }
            _ => None,
        };
        plane.map_or(Node::leaf(leaf), |plane| Node::planar_leaf(leaf, &plane))
    }
}

fn holds_any(node: &Cursor<'_, SplitPlane>) -> bool {
    !matches!(node.node(), BuildNode::Leaf([]))
}

/// The plane within whose slack the whole primitive lies, and every hit on it,
/// rounding of the ray aside.
fn plane_around<P: Polygonal>(primitive: &P) -> Option<SplitPlane> {
    let plane = planes_of(primitive, 0.0).next()?;
    let reach = -margin(pad_of(primitive), &plane);
    let is_within = |corner: Vec3| plane.signed_distance(corner.as_dvec3()).abs() <= reach;
    primitive.vertices().all(is_within).then_some(plane)
}
