//! From a build tree to nodes.

use std::collections::HashMap;

use accel_core::build::{BuildNode, BuildTree, Cursor};
use accel_core::glam::{Vec3, Vec4};
use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::{Aabb, BuildError, Polygonal, Primitive};

use crate::candidates::planes_of;
use crate::node::{MAX_INDEX, NODE_BYTES, Node, NodePlane, SlackClass};
use crate::nodes::{Nodes, PLANE_BYTES};
use crate::pieces::{margin, pad_of};
use crate::shared_slacks::{SharedSlacks, SlackCounts};
use crate::split_plane::SplitPlane;
use crate::{BspBuilder, BspTree, SingleLeaves};

/// Bytes that a node takes at most while a tree is packed, its plane included.
pub(crate) const BYTES_PER_NODE: usize =
    BuildTree::<SplitPlane>::BYTES_PER_NODE + NODE_BYTES + PLANE_BYTES + KnownPlanes::BYTES_EACH;

/// Bytes that a reference takes while a tree is packed, its copy of the primitive included.
pub(crate) const fn bytes_per_reference<P>() -> usize {
    size_of::<P>() + 3 * size_of::<u32>()
}

impl<P: Primitive> BspTree<P> {
    /// The tree over nothing that can be hit.
    pub(crate) fn empty(primitives: &[P], skipped: usize) -> Self {
        Self {
            nodes: Nodes::new(SharedSlacks::default(), 0),
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
        let (of_nodes, slacks) = survey(tree);
        let of_leaves = match builder.single_leaves {
            SingleLeaves::Planar => leaves.min(primitives.len()),
            _ => 0,
        };
        let planes = (of_nodes + of_leaves) * (PLANE_BYTES + KnownPlanes::BYTES_EACH);
        let nodes = (inner + leaves) * (BuildTree::<SplitPlane>::BYTES_PER_NODE + NODE_BYTES);
        let bytes = nodes + planes + references * bytes_per_reference::<P>();
        builder.budget.check_bytes(bytes)?;
        let mut packed = Self {
            nodes: Nodes::new(slacks, inner + leaves),
            stored: StoredPrimitives::new(primitives, skipped, references),
            bounds: Some(bounds),
            depth: 0,
            largest: Vec4::ZERO,
        };
        let mut known = KnownPlanes::default();
        let mut pending = vec![(tree.root(), packed.nodes.push(Node::leaf(0)), 0)];
        while let Some((cursor, index, depth)) = pending.pop() {
            packed.depth = packed.depth.max(depth);
            let node = match cursor.node() {
                BuildNode::Leaf(ids) => packed.leaf(builder, primitives, ids, &mut known),
                BuildNode::Inner { node, children } => {
                    let are_there = children.each_ref().map(holds_any);
                    let plane = known.of_node(node, &mut packed.nodes);
                    let inner = Node::inner(plane, packed.nodes.len() as u32, are_there);
                    let first = pending.len();
                    for (cursor, is_there) in children.into_iter().zip(are_there) {
                        if is_there {
                            pending.push((cursor, packed.nodes.push(Node::leaf(0)), depth + 1));
                        }
                    }
                    pending[first..].reverse();
                    inner
                }
            };
            packed.nodes.replace(index, node);
        }
        packed.nodes.shrink_to_fit();
        packed.largest = packed.nodes.largest();
        if builder.single_leaves == SingleLeaves::Bounded {
            packed.mark_bounded_leaves(primitives);
        }
        Ok(packed)
    }

    fn leaf(
        &mut self,
        builder: &BspBuilder,
        primitives: &[P],
        ids: &[u32],
        known: &mut KnownPlanes,
    ) -> Node {
        let leaf = self.stored.leaves_mut().push_leaf(primitives, ids);
        let plane = match ids {
            [id] if builder.single_leaves == SingleLeaves::Planar => {
                plane_around(&primitives[*id as usize])
            }
            _ => None,
        };
        plane.map_or(Node::leaf(leaf), |plane| {
            Node::planar_leaf(leaf, known.number_of(&plane, &mut self.nodes))
        })
    }
}

/// The numbers of planes by their bits. A primitive's plane splits several nodes, and
/// stands in its leaves.
#[derive(Default)]
struct KnownPlanes(HashMap<[u32; 4], u32>);

impl KnownPlanes {
    /// Bytes that a plane takes here, with the room that a table keeps free.
    const BYTES_EACH: usize = 2 * size_of::<([u32; 4], u32)>();

    fn of_node(&mut self, plane: &SplitPlane, nodes: &mut Nodes) -> NodePlane {
        let Some(axis) = plane.axis() else {
            return NodePlane::General(self.number_of(plane, nodes));
        };
        let (_, position, slack) = plane.stored();
        let class = nodes.slacks().class_of(slack);
        match (class, plane.with_slack_of_its_own()) {
            (None, Some(general)) => NodePlane::General(self.number_of(&general, nodes)),
            _ => NodePlane::AxisAligned {
                axis,
                position,
                slack: class.unwrap_or(SlackClass::Large),
            },
        }
    }

    /// Of a plane that is not axis-aligned.
    fn number_of(&mut self, plane: &SplitPlane, nodes: &mut Nodes) -> u32 {
        debug_assert!(plane.axis().is_none());
        let (normal, offset, _) = plane.stored();
        let plane = normal.extend(offset);
        let bits = plane.to_array().map(f32::to_bits);
        *self
            .0
            .entry(bits)
            .or_insert_with(|| nodes.push_plane(plane))
    }
}

/// How many nodes have a plane with a slack of its own, and what the others share.
fn survey(tree: &BuildTree<SplitPlane>) -> (usize, SharedSlacks) {
    let (mut general, mut slacks) = (0, SlackCounts::default());
    let mut pending = vec![tree.root()];
    while let Some(cursor) = pending.pop() {
        if let BuildNode::Inner { node, children } = cursor.node() {
            pending.extend(children);
            match node.axis() {
                Some(_) => slacks.count(node.stored().2),
                None => general += 1,
            }
        }
    }
    let shared = slacks.shared();
    (general + slacks.unsuited(shared), shared)
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
