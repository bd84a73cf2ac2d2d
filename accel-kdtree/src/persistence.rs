//! Saving a tree, and loading it from bytes that nobody vouches for.
//!
//! ```text
//! skipped primitives; nodes, two words each;
//! for every leaf that holds something, in depth-first order: its count and its ids
//! ```
//!
//! The root's cell and the slack follow from the primitives.

use accel_core::archive::{
    Archive, ArchiveReader, ArchiveWriter, LeafLoader, LoadError, MetOnce, bounds_of_hits,
    bounds_of_scene, check_limit, scene_of_slice, scene_of_structure,
};
use accel_core::layout::StoredPrimitives;
use accel_core::{Aabb, AccelerationStructure, Clip};

use crate::KdTree;
use crate::node::{Leaf, MAX_INDEX, Node, NodeKind};
use crate::part::Slack;

const KIND: [u8; 8] = *b"accelkdt";
const VERSION: u32 = 1;

/// What loads can be checked further by [`validate`](KdTree::validate).
///
/// ```
/// use accel_kdtree::{Archive, KdTree, KdTreeBuilder, Triangle};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let triangles = [Triangle::new([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0])];
/// let mut file = Vec::new();
/// KdTreeBuilder::default().build(&triangles)?.write_to(&mut file)?;
/// let tree = KdTree::read_from(file.as_slice(), 1 << 20, &triangles)?;
/// # Ok(())
/// # }
/// ```
impl<P: Clip> Archive for KdTree<P> {
    type Error = LoadError;

    fn to_bytes(&self) -> Vec<u8> {
        let scene = scene_of_structure(self, bounds_of_scene);
        let mut archive = ArchiveWriter::new(KIND, VERSION, scene);
        archive.push(self.skipped_count() as u32);
        archive.push(self.nodes.len() as u32);
        for word in self.nodes.iter().flat_map(|node| node.words()) {
            archive.push(word);
        }
        let mut pending = Vec::from_iter(self.bounds.map(|_| 0));
        while let Some(index) = pending.pop() {
            match self.nodes[index as usize].kind() {
                NodeKind::Inner { children, .. } => pending.extend([children + 1, children]),
                NodeKind::Leaf(Leaf::Empty) => {}
                NodeKind::Leaf(Leaf::Of(leaf)) => {
                    archive.push_leaf(self.stored.leaves(), leaf);
                }
            }
        }
        archive.finish()
    }

    fn from_bytes(bytes: &[u8], primitives: &[P]) -> Result<Self, LoadError> {
        let scene = scene_of_slice(primitives, bounds_of_scene);
        let mut archive = ArchiveReader::new(bytes, KIND, VERSION, scene)?;
        let leaves = LeafLoader::new(primitives, &mut archive)?;
        let count = archive.count(2)?;
        let nodes = (0..count).map(|_| read_node(&mut archive));
        let nodes = nodes.collect::<Result<Vec<Node>, LoadError>>()?;
        let cell = bounds_of_hits(primitives);
        if cell.is_empty() {
            check_limit("nodes over nothing:", count as u64, 0)?;
        }
        let boxes = primitives.iter().map(P::bounds).filter(Aabb::is_valid);
        let mut loading = Loading {
            archive,
            leaves,
            tree: Self {
                nodes,
                stored: StoredPrimitives::new(&[], 0, 0),
                bounds: (count > 0).then_some(cell),
                slack: Slack::of(boxes),
                depth: 0,
            },
        };
        loading.read_leaves()?;
        loading.archive.finish()?;
        Ok(Self {
            stored: loading.leaves.finish()?,
            ..loading.tree
        })
    }
}

struct Loading<'a, P: Clip> {
    archive: ArchiveReader<'a>,
    leaves: LeafLoader<'a, P>,
    /// Without leaves, until all are read.
    tree: KdTree<P>,
}

impl<P: Clip> Loading<'_, P> {
    fn read_leaves(&mut self) -> Result<(), LoadError> {
        let mut met = MetOnce::new(self.tree.nodes.len());
        let mut pending = Vec::from_iter(self.tree.bounds.map(|_| (0_usize, 0_u32)));
        while let Some((index, depth)) = pending.pop() {
            met.meet(index..index + 1, depth)?;
            self.tree.depth = self.tree.depth.max(depth);
            match self.tree.nodes[index].kind() {
                NodeKind::Inner { children, .. } => {
                    let children = children as usize;
                    pending.extend([(children + 1, depth + 1), (children, depth + 1)]);
                }
                NodeKind::Leaf(Leaf::Empty) => {}
                NodeKind::Leaf(Leaf::Of(_)) => {
                    let leaf = self.leaves.read_leaf(&mut self.archive)?;
                    check_limit("leaf", leaf.into(), MAX_INDEX as u64)?;
                    self.tree.nodes[index] = Node::leaf(Leaf::Of(leaf));
                }
            }
        }
        met.finish()
    }
}

fn read_node(archive: &mut ArchiveReader<'_>) -> Result<Node, LoadError> {
    let words = [archive.word()?, archive.word()?];
    Node::from_words(words).ok_or(LoadError::Meaningless {
        what: "a node of no axis or no finite plane, in the words",
        value: u64::from(words[0]) | u64::from(words[1]) << 32,
    })
}
