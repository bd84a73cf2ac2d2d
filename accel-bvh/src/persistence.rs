//! Saving a tree, and loading it from bytes that nobody vouches for.
//!
//! ```text
//! skipped primitives; six words of the root's box; whether the root is a leaf;
//! the words of the nodes; for every leaf, from left to right, its ids
//! ```
//!
//! A loaded tree is validated like a built one: what passes can't lose a hit, but
//! for primitives that stand in several leaves, of whose parts nothing is saved.

use accel_core::archive::{
    Archive, ArchiveReader, ArchiveWriter, LeafLoader, LoadError, MetOnce, bounds_of_scene,
    check_limit, scene_of_slice, scene_of_structure,
};
use accel_core::layout::StoredPrimitives;
use accel_core::{Aabb, AccelerationStructure, Primitive};

use crate::Bvh;
use crate::bvh::Root;
use crate::node::{INNER_WORDS, LEAF_WORDS, Node, NodePointer};

const KIND: [u8; 8] = *b"accelbvh";
const VERSION: u32 = 1;

/// ```
/// use accel_bvh::{Archive, Bvh, BvhBuilder, Sphere};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let bytes = BvhBuilder::default().build(&spheres)?.to_bytes();
/// let bvh = Bvh::from_bytes(&bytes, &spheres)?;
/// # Ok(())
/// # }
/// ```
impl<P: Primitive> Archive for Bvh<P> {
    type Error = LoadError;

    fn to_bytes(&self) -> Vec<u8> {
        let scene = scene_of_structure(self, bounds_of_scene);
        let mut archive = ArchiveWriter::new(KIND, VERSION, scene);
        archive.push(self.skipped_count() as u32);
        archive.push_bounds(&self.bounds().unwrap_or(Aabb::EMPTY));
        let is_leaf = |root: Root| matches!(root.pointer.kind(), Node::Leaf(_));
        archive.push(self.root.is_some_and(is_leaf).into());
        archive.push_list(self.words.iter().copied());
        let root = self.root.map(|root| root.pointer);
        for pointer in root.map_or_else(Vec::new, |root| self.depth_first(root)) {
            if let Node::Leaf(offset) = pointer.kind() {
                let leaf = self.leaf_number(offset);
                archive.push_leaf(self.stored.leaves(), leaf);
            }
        }
        archive.finish()
    }

    fn from_bytes(bytes: &[u8], primitives: &[P]) -> Result<Self, LoadError> {
        let scene = scene_of_slice(primitives, bounds_of_scene);
        let mut archive = ArchiveReader::new(bytes, KIND, VERSION, scene)?;
        let leaves = LeafLoader::new(primitives, &mut archive)?;
        let bounds = archive.bounds()?;
        let is_leaf = archive.word()?;
        check_limit("a mark of a root that is a leaf", is_leaf.into(), 1)?;
        let words = archive.list()?;
        let root = (!words.is_empty()).then(|| Root {
            bounds,
            pointer: NodePointer::new(0, is_leaf == 1),
        });
        let mut loading = Loading {
            archive,
            leaves,
            met: MetOnce::new(words.len()),
            bvh: Self {
                words,
                stored: StoredPrimitives::new(&[], 0, 0),
                root,
                depth: 0,
            },
        };
        loading.read_leaves()?;
        loading.met.finish()?;
        loading.archive.finish()?;
        let mut bvh = loading.bvh;
        bvh.stored = loading.leaves.finish()?;
        bvh.validate()?;
        Ok(bvh)
    }
}

struct Loading<'a, P: Primitive> {
    archive: ArchiveReader<'a>,
    leaves: LeafLoader<'a, P>,
    /// By word.
    met: MetOnce,
    /// Without leaves, until all are read.
    bvh: Bvh<P>,
}

impl<P: Primitive> Loading<'_, P> {
    /// Walks the tree and reads the leaves. Every word must be met once, so the
    /// walk ends.
    fn read_leaves(&mut self) -> Result<(), LoadError> {
        let mut pending = Vec::from_iter(self.bvh.root.map(|root| (root.pointer, 0)));
        while let Some((pointer, depth)) = pending.pop() {
            self.bvh.depth = self.bvh.depth.max(depth);
            match pointer.kind() {
                Node::Leaf(offset) => {
                    self.meet(offset, LEAF_WORDS, depth)?;
                    let leaf = self.leaves.read_leaf(&mut self.archive)?;
                    self.bvh.words[offset as usize] = leaf;
                }
                Node::Inner(offset) => {
                    self.meet(offset, INNER_WORDS, depth)?;
                    let [left, right] = self.bvh.inner_node(offset).children().pointers();
                    pending.extend([(right, depth + 1), (left, depth + 1)]);
                }
            }
        }
        Ok(())
    }

    fn meet(&mut self, offset: u32, words: usize, depth: u32) -> Result<(), LoadError> {
        let offset = offset as usize;
        self.met.meet(offset..offset + words, depth)
    }
}
