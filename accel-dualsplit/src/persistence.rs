//! Saving a tree, and loading it from bytes that nobody vouches for.
//!
//! ```text
//! skipped primitives; six words of the root's box; the words of the nodes;
//! for every leaf, in the order of their numbers, its ids
//! ```
//!
//! A loaded tree is validated like a converted one: what passes can't lose a hit,
//! but for primitives that stand in several leaves, of whose parts nothing is saved.

use std::marker::PhantomData;

use accel_core::archive::{
    Archive, ArchiveReader, ArchiveWriter, LeafLoader, LoadError, bounds_of_scene, check_limit,
    scene_of_slice, scene_of_structure,
};
use accel_core::{Aabb, AccelerationStructure, Primitive};

use crate::codec::{MAX_OFFSET, MAX_WORDS, Node, NodeWords};
use crate::error::PlaneTreeLoadError;
use crate::node_set::NodeSet;
use crate::tree::PlaneTree;
use crate::validate::check_words;

const VERSION: u32 = 1;

/// ```
/// use accel_dualsplit::{Archive, BvhBuilder, DualSplitConverter, DualSplitTree, Sphere};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let bvh = BvhBuilder::default().build(&spheres)?;
/// let bytes = DualSplitConverter::default().convert(&bvh)?.to_bytes();
/// let tree = DualSplitTree::from_bytes(&bytes, &spheres)?;
/// # Ok(())
/// # }
/// ```
impl<P: Primitive, N: NodeSet> Archive for PlaneTree<P, N> {
    type Error = PlaneTreeLoadError;

    fn to_bytes(&self) -> Vec<u8> {
        let scene = scene_of_structure(self, bounds_of_scene);
        let mut archive = ArchiveWriter::new(N::ARCHIVE_KIND, VERSION, scene);
        archive.push(self.skipped_count() as u32);
        archive.push_bounds(&self.bounds.unwrap_or(Aabb::EMPTY));
        archive.push_list(self.node_words().iter().copied());
        for position in leaf_positions(self.node_words()) {
            let leaf = self.node(position).target as u32;
            archive.push_leaf(self.stored.leaves(), leaf);
        }
        archive.finish()
    }

    fn from_bytes(bytes: &[u8], primitives: &[P]) -> Result<Self, PlaneTreeLoadError> {
        let scene = scene_of_slice(primitives, bounds_of_scene);
        let mut archive = ArchiveReader::new(bytes, N::ARCHIVE_KIND, VERSION, scene)?;
        let mut leaves = LeafLoader::new(primitives, &mut archive)?;
        let bounds = archive.bounds()?;
        let mut words = archive.list()?;
        check_limit("words", words.len() as u64, MAX_WORDS as u64)?;
        let depth = check_words::<N>(&words, |_| true)?;
        for position in leaf_positions(&words) {
            let leaf = leaves.read_leaf(&mut archive)?;
            check_limit("leaf number", leaf.into(), MAX_OFFSET as u64)?;
            let header = Node::decode(&words, position)?.header;
            words[position] = header.encode(leaf as usize);
        }
        archive.finish()?;
        let tree = Self {
            bounds: (!words.is_empty()).then_some(bounds),
            words: NodeWords::new(words),
            stored: leaves.finish()?,
            depth,
            nodes: PhantomData,
        };
        tree.validate().map_err(LoadError::from)?;
        Ok(tree)
    }
}

/// Where the leaves of checked words are, by number: a storage that is filled in
/// this order gives them these numbers again.
fn leaf_positions(words: &[u32]) -> Vec<usize> {
    let mut leaves = Vec::new();
    let mut pending = Vec::from_iter((!words.is_empty()).then_some(0));
    while let Some(position) = pending.pop() {
        let node = Node::decode(words, position).expect("the words were checked");
        if node.header.is_leaf() {
            leaves.push((node.target, position));
        }
        pending.extend(node.children());
    }
    leaves.sort_unstable();
    leaves.into_iter().map(|(_, position)| position).collect()
}
