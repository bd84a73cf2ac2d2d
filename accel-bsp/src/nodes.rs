//! The nodes of a tree, and what they refer to.

use accel_core::glam::Vec4;

use crate::node::{NODE_BYTES, Node, NodeKind};
use crate::shared_slacks::SharedSlacks;
use crate::split_plane::SplitPlane;

/// Bytes of a plane that is not axis-aligned.
pub const PLANE_BYTES: usize = size_of::<Vec4>();

/// How many bytes a visit of a node reads, those of its plane included.
#[inline]
pub(crate) fn bytes_of(node: &Node) -> u32 {
    let plane = if node.is_general() { PLANE_BYTES } else { 0 };
    (NODE_BYTES + plane) as u32
}

/// The nodes of a tree, its root the first, and their planes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Nodes {
    nodes: Vec<Node>,
    /// Normals and offsets, scaled so that the slack is 1.
    planes: Vec<Vec4>,
    slacks: SharedSlacks,
}

impl Nodes {
    /// None yet, whose axis-aligned planes will share these slacks.
    pub(crate) fn new(slacks: SharedSlacks, capacity: usize) -> Self {
        Self {
            nodes: Vec::with_capacity(capacity),
            planes: Vec::new(),
            slacks,
        }
    }

    /// The nodes of a saved tree. Not validated.
    pub(crate) fn of_parts(nodes: Vec<Node>, planes: Vec<Vec4>, slacks: SharedSlacks) -> Self {
        Self {
            nodes,
            planes,
            slacks,
        }
    }

    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.nodes.len()
    }

    #[inline]
    pub(crate) fn node(&self, index: u32) -> &Node {
        &self.nodes[index as usize]
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Node> {
        self.nodes.iter()
    }

    /// The plane of this number: its normal and its offset.
    #[inline]
    pub(crate) fn plane(&self, number: u32) -> Vec4 {
        self.planes[number as usize]
    }

    pub(crate) fn planes(&self) -> &[Vec4] {
        &self.planes
    }

    pub(crate) fn slacks(&self) -> SharedSlacks {
        self.slacks
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice()) + size_of_val(self.planes.as_slice())
    }

    /// The plane of an inner node.
    pub(crate) fn split_plane(&self, node: &Node) -> Option<SplitPlane> {
        match node.kind() {
            NodeKind::AxisAligned {
                axis,
                position,
                slack,
                ..
            } => {
                let slack = self.slacks.of(slack);
                let normal = axis.unit();
                Some(SplitPlane::from_stored(Some(axis), normal, position, slack))
            }
            NodeKind::General { plane, .. } => {
                let plane = self.plane(plane);
                let (normal, offset) = (plane.truncate(), plane.w);
                Some(SplitPlane::from_stored(None, normal, offset, 1.0))
            }
            _ => None,
        }
    }

    /// Adds a node, and returns its index.
    pub(crate) fn push(&mut self, node: Node) -> u32 {
        self.nodes.push(node);
        self.nodes.len() as u32 - 1
    }

    pub(crate) fn replace(&mut self, index: u32, node: Node) {
        self.nodes[index as usize] = node;
    }

    /// Adds a plane that is not axis-aligned, and returns its number.
    pub(crate) fn push_plane(&mut self, plane: Vec4) -> u32 {
        self.planes.push(plane);
        self.planes.len() as u32 - 1
    }

    pub(crate) fn shrink_to_fit(&mut self) {
        self.nodes.shrink_to_fit();
        self.planes.shrink_to_fit();
    }

    /// The largest magnitudes of the numbers of planes that are not axis-aligned.
    pub(crate) fn largest(&self) -> Vec4 {
        let magnitudes = self.planes.iter().map(|plane| plane.abs());
        magnitudes.fold(Vec4::ZERO, Vec4::max)
    }
}
