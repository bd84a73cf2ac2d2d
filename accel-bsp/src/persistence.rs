//! Saving a tree, and loading it from bytes that nobody vouches for.
//!
//! ```text
//! skipped primitives; six words of the root's box; the two slacks of axis-aligned
//! planes; other planes, four words each; nodes, two words each;
//! for every leaf, back to front in depth: its count and its ids
//! ```

use accel_core::archive::{
    Archive, ArchiveReader, ArchiveWriter, LeafLoader, LoadError, MetOnce, bounds_of_hits,
    check_limit, scene_of_slice, scene_of_structure,
};
use accel_core::glam::{Vec3, Vec4};
use accel_core::{Aabb, AccelerationStructure, Polygonal, ValidationError};

use crate::BspTree;
use crate::node::{MAX_INDEX, Node};
use crate::nodes::Nodes;
use crate::shared_slacks::SharedSlacks;

const KIND: [u8; 8] = *b"accelbsp";
const VERSION: u32 = 3;

/// ```
/// use accel_bsp::{Archive, BspBuilder, BspTree, Triangle};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let triangles = [Triangle::new([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0])];
/// let mut file = Vec::new();
/// BspBuilder::default().build(&triangles)?.write_to(&mut file)?;
/// let tree = BspTree::read_from(file.as_slice(), 1 << 20, &triangles)?;
/// # Ok(())
/// # }
/// ```
impl<P: Polygonal> Archive for BspTree<P> {
    type Error = LoadError;

    fn to_bytes(&self) -> Vec<u8> {
        let scene = scene_of_structure(self, corners);
        let mut archive = ArchiveWriter::new(KIND, VERSION, scene);
        archive.push(self.skipped_count() as u32);
        archive.push_bounds(&self.bounds.unwrap_or(Aabb::EMPTY));
        let SharedSlacks { small, large } = self.nodes.slacks();
        archive.push(small.to_bits());
        archive.push(large.to_bits());
        archive.push(self.nodes.planes().len() as u32);
        for number in self.nodes.planes().iter().flat_map(Vec4::to_array) {
            archive.push(number.to_bits());
        }
        archive.push(self.nodes.len() as u32);
        for node in self.nodes.iter() {
            node.to_words()
                .into_iter()
                .for_each(|word| archive.push(word));
        }
        let mut pending = Vec::from_iter(self.bounds.map(|_| 0));
        while let Some(index) = pending.pop() {
            let node = self.nodes.node(index);
            pending.extend(node.children().into_iter().rev().flatten());
            if let Some(leaf) = node.leaf_number() {
                archive.push_leaf(self.stored.leaves(), leaf);
            }
        }
        archive.finish()
    }

    fn from_bytes(bytes: &[u8], primitives: &[P]) -> Result<Self, LoadError> {
        let scene = scene_of_slice(primitives, corners);
        let mut archive = ArchiveReader::new(bytes, KIND, VERSION, scene)?;
        let leaves = LeafLoader::new(primitives, &mut archive)?;
        let bounds = archive.bounds()?;
        let slacks = SharedSlacks {
            small: slack(&mut archive)?,
            large: slack(&mut archive)?,
        };
        if slacks.small > slacks.large {
            let bits = slacks.small.to_bits().into();
            return meaningless("a small slack above the large one, of bits", bits);
        }
        let plane_count = archive.count(4)?;
        let planes = (0..plane_count).map(|_| read_plane(&mut archive));
        let planes = planes.collect::<Result<_, _>>()?;
        let node_count = archive.count(2)?;
        check_bounds(&bounds, primitives, node_count)?;
        let nodes = (0..node_count).map(|_| read_node(&mut archive));
        let nodes = nodes.collect::<Result<_, _>>()?;
        let mut loading = Loading {
            archive,
            leaves,
            nodes: Nodes::of_parts(nodes, planes, slacks),
            depth: 0,
        };
        loading.read_leaves()?;
        loading.archive.finish()?;
        Ok(Self {
            largest: loading.nodes.largest(),
            nodes: loading.nodes,
            stored: loading.leaves.finish()?,
            bounds: (node_count > 0).then_some(bounds),
            depth: loading.depth,
        })
    }
}

struct Loading<'a, P: Polygonal> {
    archive: ArchiveReader<'a>,
    leaves: LeafLoader<'a, P>,
    nodes: Nodes,
    depth: u32,
}

impl<P: Polygonal> Loading<'_, P> {
    /// Walks the tree, checks every node, and reads the leaves. Every node must
    /// be met once, so the walk ends.
    fn read_leaves(&mut self) -> Result<(), LoadError> {
        let count = self.nodes.len();
        let mut met = MetOnce::new(count);
        let mut pending = Vec::from_iter((count > 0).then_some((0_usize, 0_u32)));
        while let Some((index, depth)) = pending.pop() {
            met.meet(index..index + 1, depth)?;
            self.depth = self.depth.max(depth);
            let node = self.nodes.node(index as u32);
            if node.is_general() {
                let (number, count) = (node.plane_number(), self.nodes.planes().len());
                check_limit("number of a plane", u64::from(number) + 1, count as u64)?;
            } else if !node.is_leaf() && !node.position().is_finite() {
                return meaningless("a plane that is not finite at node", index as u64);
            }
            let children = node.children().into_iter().rev().flatten();
            pending.extend(children.map(|child| (child as usize, depth + 1)));
            if node.is_leaf() {
                let leaf = self.leaves.read_leaf(&mut self.archive)?;
                check_limit("leaf", leaf.into(), MAX_INDEX as u64)?;
                self.nodes
                    .replace(index as u32, node.with_leaf_number(leaf));
            }
        }
        met.finish()
    }
}

fn read_node(archive: &mut ArchiveReader<'_>) -> Result<Node, LoadError> {
    Ok(Node::from_words([archive.word()?, archive.word()?]))
}

fn read_plane(archive: &mut ArchiveReader<'_>) -> Result<Vec4, LoadError> {
    let mut number = || finite(archive);
    Ok(Vec4::new(number()?, number()?, number()?, number()?))
}

/// The box of a tree must hold all that can be hit, and there must be something.
fn check_bounds<P: Polygonal>(
    bounds: &Aabb,
    primitives: &[P],
    node_count: usize,
) -> Result<(), LoadError> {
    let of_hits = bounds_of_hits(primitives);
    if of_hits.is_empty() {
        return check_limit("nodes over nothing:", node_count as u64, 0);
    }
    if bounds.contains(&of_hits) {
        return Ok(());
    }
    let node = 0;
    Err(ValidationError::NotEnclosed { node }.into())
}

fn slack(archive: &mut ArchiveReader<'_>) -> Result<f32, LoadError> {
    let slack = finite(archive)?;
    if slack.is_sign_positive() {
        return Ok(slack);
    }
    meaningless("a slack of negative bits", slack.to_bits().into())
}

fn finite(archive: &mut ArchiveReader<'_>) -> Result<f32, LoadError> {
    let word = archive.word()?;
    let number = f32::from_bits(word);
    if number.is_finite() {
        return Ok(number);
    }
    meaningless("a number of bits that are not finite", word.into())
}

fn meaningless<T>(what: &'static str, value: u64) -> Result<T, LoadError> {
    Err(LoadError::Meaningless { what, value })
}

/// What a primitive's planes depend on.
fn corners<P: Polygonal>(primitive: &P) -> Vec<Vec3> {
    primitive.vertices().collect()
}
