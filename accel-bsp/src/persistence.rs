//! Saving a tree, and loading it from bytes that nobody vouches for.
//!
//! ```text
//! skipped primitives; six words of the root's box; nodes, five words each;
//! for every leaf, back to front in depth: its count and its ids
//! ```
//!
//! Primitives are not saved: the archive knows them by a fingerprint.

use accel_core::archive::{ArchiveReader, ArchiveWriter, LoadError, fingerprint};
use accel_core::glam::Vec3;
use accel_core::layout::{LeafStorage, StoredPrimitives};
use accel_core::{Aabb, AccelerationStructure, BuildBudget, Polygonal};

use crate::BspTree;
use crate::node::{NODE_WORDS, Node, NodeKind};

const KIND: [u8; 8] = *b"accelbsp";
const VERSION: u32 = 1;

impl<P: Polygonal> BspTree<P> {
    /// The tree as bytes, without its primitives, on any machine the same.
    pub fn to_bytes(&self) -> Vec<u8> {
        let primitives = (0..self.primitive_count() as u32).map(|id| self.primitive(id));
        let mut archive = ArchiveWriter::new(KIND, VERSION, scene_fingerprint(primitives));
        archive.push(self.skipped_count() as u32);
        let bounds = self.bounds.unwrap_or(Aabb::EMPTY);
        for coordinate in [bounds.min, bounds.max]
            .map(|corner| corner.to_array())
            .as_flattened()
        {
            archive.push(coordinate.to_bits());
        }
        archive.push(self.nodes.len() as u32);
        for node in &self.nodes {
            node.to_words()
                .into_iter()
                .for_each(|word| archive.push(word));
        }
        let mut pending = Vec::from_iter(self.bounds.map(|_| 0));
        while let Some(index) = pending.pop() {
            let node = self.nodes[index as usize];
            if let Some(children) = node.children() {
                pending.extend([children + 1, children]);
            } else if let Some(leaf) = node.leaf_number() {
                let ids: Vec<u32> = self.stored.leaves().leaf_ids(leaf).collect();
                archive.push(ids.len() as u32);
                ids.into_iter().for_each(|id| archive.push(id));
            }
        }
        archive.finish()
    }

    /// The tree that [`to_bytes`](Self::to_bytes) saved, over the same primitives.
    /// `bytes` may come from anywhere: all of them are validated.
    ///
    /// # Errors
    /// A [`LoadError`] that names what is wrong.
    pub fn from_bytes(bytes: &[u8], primitives: &[P]) -> Result<Self, LoadError> {
        let valid = |primitive: &P| primitive.bounds().is_valid().then(|| primitive.clone());
        let scene = scene_fingerprint(primitives.iter().map(valid));
        let mut archive = ArchiveReader::new(bytes, KIND, VERSION, scene)?;
        let skipped = archive.word()?;
        let bounds = read_bounds(&mut archive)?;
        let node_count = archive.count(NODE_WORDS)?;
        let mut nodes = Vec::with_capacity(node_count);
        for _ in 0..node_count {
            let mut words = [0; NODE_WORDS];
            for word in &mut words {
                *word = archive.word()?;
            }
            nodes.push(Node::from_words(words));
        }
        let mut loading = Loading {
            primitives,
            archive,
            tree: Self {
                nodes,
                stored: StoredPrimitives::new(primitives, skipped as usize, 0),
                bounds: (node_count > 0).then_some(bounds),
                depth: 0,
            },
        };
        loading.read_leaves()?;
        loading.archive.finish()?;
        loading.check_all_held(skipped)?;
        Ok(loading.tree)
    }
}

struct Loading<'a, P: Polygonal> {
    primitives: &'a [P],
    archive: ArchiveReader<'a>,
    tree: BspTree<P>,
}

impl<P: Polygonal> Loading<'_, P> {
    /// Walks the tree, checks every node, and reads the leaves. Every node must
    /// be met once, so the walk ends.
    fn read_leaves(&mut self) -> Result<(), LoadError> {
        let count = self.tree.nodes.len();
        let mut is_met = vec![false; count];
        let mut pending = Vec::from_iter(self.tree.bounds.map(|_| (0_usize, 0_u32)));
        let mut met = 0;
        while let Some((index, depth)) = pending.pop() {
            limit("node", index as u64, count as u64 - 1)?;
            limit("depth", u64::from(depth), u64::from(BuildBudget::DEEPEST))?;
            if std::mem::replace(&mut is_met[index], true) {
                return out_of_range("a second parent of node", index as u64, 0);
            }
            met += 1;
            self.tree.depth = self.tree.depth.max(depth);
            let node = self.tree.nodes[index];
            if !node.is_finite() {
                return out_of_range("a plane that is not finite at node", index as u64, 0);
            }
            if let Some(children) = node.children() {
                let first = children as usize;
                pending.extend([(first + 1, depth + 1), (first, depth + 1)]);
            } else if !matches!(node.kind(), NodeKind::Empty) {
                let ids = self.read_ids()?;
                let leaves = self.tree.stored.leaves_mut();
                let leaf = leaves.push_leaf(self.primitives, &ids);
                self.tree.nodes[index] = node.with_leaf_number(leaf);
            }
        }
        if met < count {
            return out_of_range("nodes", count as u64, met as u64);
        }
        Ok(())
    }

    fn read_ids(&mut self) -> Result<Vec<u32>, LoadError> {
        let count = self.archive.count(1)?;
        if count == 0 {
            return out_of_range("a leaf of primitives", 0, 1);
        }
        let mut ids = Vec::with_capacity(count);
        for _ in 0..count {
            let id = self.archive.word()?;
            let is_valid = |primitive: &P| primitive.bounds().is_valid();
            if !self.primitives.get(id as usize).is_some_and(is_valid) {
                return out_of_range("id", u64::from(id), self.primitives.len() as u64);
            }
            ids.push(id);
        }
        Ok(ids)
    }

    /// Whether every primitive but the skipped ones stands in a leaf, without
    /// which it could not be hit.
    fn check_all_held(&self, skipped: u32) -> Result<(), LoadError> {
        let ids = 0..self.primitives.len() as u32;
        let missing = ids.filter(|&id| self.tree.primitive(id).is_none()).count();
        let skipped = u64::from(skipped);
        if missing as u64 == skipped {
            Ok(())
        } else {
            out_of_range("primitives in no leaf", missing as u64, skipped)
        }
    }
}

/// The box of the root, finite or empty.
fn read_bounds(archive: &mut ArchiveReader<'_>) -> Result<Aabb, LoadError> {
    let mut corner = || -> Result<Vec3, LoadError> {
        let mut word = || archive.word().map(f32::from_bits);
        Ok(Vec3::new(word()?, word()?, word()?))
    };
    let bounds = Aabb::new(corner()?, corner()?);
    if bounds.is_valid() || bounds == Aabb::EMPTY {
        Ok(bounds)
    } else {
        out_of_range("boxes that are not finite", 1, 0)
    }
}

fn limit(what: &'static str, value: u64, limit: u64) -> Result<(), LoadError> {
    if value <= limit {
        Ok(())
    } else {
        out_of_range(what, value, limit)
    }
}

fn out_of_range<T>(what: &'static str, value: u64, limit: u64) -> Result<T, LoadError> {
    Err(LoadError::OutOfRange { what, value, limit })
}

/// Of the corners of all primitives, and of which there are none.
fn scene_fingerprint<P: Polygonal>(primitives: impl Iterator<Item = Option<P>>) -> u64 {
    let words = |primitive: Option<P>| -> Vec<u32> {
        let Some(primitive) = primitive else {
            return vec![0];
        };
        let corners = primitive.vertices();
        let coordinates = corners.flat_map(|corner| corner.to_array().map(f32::to_bits));
        std::iter::once(1).chain(coordinates).collect()
    };
    fingerprint(primitives.flat_map(words))
}
