//! Triangles in blocks, corner by corner and coordinate by coordinate, so that
//! one instruction works on all triangles of a block.

use std::ops::ControlFlow;

use super::{LeafStorage, ReferenceList, StorageBytes, offer_primitive};
use crate::primitive::Triangle;
use crate::primitive::watertight::LaneTest;
use crate::query::Query;
use crate::ray::PreparedRay;
use crate::statistics::TraversalStatistics;

const LANES: usize = 16;

/// Storage for large leaves: each begins a block of 16 triangles, unused lanes
/// hold NaN and are never hit. The vector units that the machine has are found
/// at run time, once per leaf.
#[derive(Clone, Debug)]
pub struct TriangleBlocks {
    references: ReferenceList,
    blocks: Vec<Block>,
    /// By block, the position of its first reference.
    first_references: Vec<u32>,
    primitives: Vec<Triangle>,
    is_held: Vec<bool>,
}

#[derive(Clone, Debug)]
#[repr(align(64))]
struct Block {
    /// Corner, coordinate, lane.
    vertices: [[[f32; LANES]; 3]; 3],
    /// How many lanes hold a triangle, from the first.
    used: u8,
    is_last_in_leaf: bool,
}

impl Block {
    fn new(triangles: impl ExactSizeIterator<Item = Triangle>, is_last_in_leaf: bool) -> Self {
        let mut block = Self {
            vertices: [[[f32::NAN; LANES]; 3]; 3],
            used: triangles.len() as u8,
            is_last_in_leaf,
        };
        for (lane, triangle) in triangles.enumerate() {
            for (corner, vertex) in triangle.vertices().into_iter().enumerate() {
                for (coordinate, value) in vertex.to_array().into_iter().enumerate() {
                    block.vertices[corner][coordinate][lane] = value;
                }
            }
        }
        block
    }

    fn used_lanes(&self) -> u32 {
        (1 << self.used) - 1
    }
}

impl LeafStorage<Triangle> for TriangleBlocks {
    fn with_capacity(primitives: &[Triangle], references: usize) -> Self {
        Self {
            references: ReferenceList::with_capacity(references),
            blocks: Vec::with_capacity(references.div_ceil(LANES)),
            first_references: Vec::with_capacity(references.div_ceil(LANES)),
            primitives: primitives.to_vec(),
            is_held: vec![false; primitives.len()],
        }
    }

    fn push_leaf(&mut self, primitives: &[Triangle], ids: &[u32]) -> u32 {
        let leaf = self.blocks.len() as u32;
        let first_reference = self.references.push_leaf(ids);
        let block_count = ids.len().div_ceil(LANES);
        for (index, ids) in ids.chunks(LANES).enumerate() {
            let triangles = ids.iter().map(|&id| primitives[id as usize]);
            self.blocks
                .push(Block::new(triangles, index + 1 == block_count));
            self.first_references
                .push(first_reference + (index * LANES) as u32);
        }
        for &id in ids {
            self.is_held[id as usize] = true;
        }
        leaf
    }

    fn intersect_leaf<Q: Query, S: TraversalStatistics>(
        &self,
        leaf: u32,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) -> ControlFlow<()> {
        dispatch::intersect_leaf(self, leaf, ray, query, statistics)
    }

    fn leaf_ids(&self, leaf: u32) -> impl Iterator<Item = u32> + '_ {
        self.references.leaf(self.first_references[leaf as usize])
    }

    fn primitive(&self, id: u32) -> Option<Triangle> {
        let is_held = *self.is_held.get(id as usize)?;
        is_held.then(|| self.primitives[id as usize])
    }

    fn replace(&mut self, primitives: &[Triangle]) {
        self.primitives.clone_from_slice(primitives);
        for (block, &first) in self.blocks.iter_mut().zip(&self.first_references) {
            let lanes = first as usize..first as usize + usize::from(block.used);
            let triangles = lanes.map(|position| primitives[self.references.id(position) as usize]);
            *block = Block::new(triangles, block.is_last_in_leaf);
        }
    }

    fn reference_count(&self) -> usize {
        self.references.len()
    }

    fn bytes(&self) -> StorageBytes {
        StorageBytes {
            references: self.references.bytes() + size_of_val(self.first_references.as_slice()),
            primitives: size_of_val(self.blocks.as_slice())
                + size_of_val(self.primitives.as_slice())
                + size_of_val(self.is_held.as_slice()),
        }
    }
}

impl TriangleBlocks {
    /// The leaf loop, inlined into one function per instruction set.
    #[inline(always)]
    fn intersect_leaf_lanes<Q: Query, S: TraversalStatistics>(
        &self,
        leaf: u32,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) -> ControlFlow<()> {
        let test = LaneTest::new(ray);
        for (index, block) in (leaf as usize..).zip(&self.blocks[leaf as usize..]) {
            statistics.test_primitives(u32::from(block.used));
            let candidates = test.candidates(&block.vertices) & block.used_lanes();
            if candidates != 0 {
                self.offer_lanes(index, candidates, ray, query)?;
            }
            if block.is_last_in_leaf {
                break;
            }
        }
        ControlFlow::Continue(())
    }

    /// Decides the lanes that the lane test kept, with the scalar kernel.
    #[inline(never)]
    fn offer_lanes<Q: Query>(
        &self,
        block: usize,
        mut lanes: u32,
        ray: &PreparedRay,
        query: &mut Q,
    ) -> ControlFlow<()> {
        let first = self.first_references[block] as usize;
        while lanes != 0 {
            let id = self.references.id(first + lanes.trailing_zeros() as usize);
            let triangle = &self.primitives[id as usize];
            offer_primitive(triangle, id, ray, query)?;
            lanes &= lanes - 1;
        }
        ControlFlow::Continue(())
    }
}

/// One instance of the leaf loop per instruction set, chosen at run time. None
/// enables fused multiply-add, which the kernel must not use.
#[allow(unsafe_code)]
mod dispatch {
    use super::{ControlFlow, PreparedRay, Query, TraversalStatistics, TriangleBlocks};

    pub(super) fn intersect_leaf<Q: Query, S: TraversalStatistics>(
        blocks: &TriangleBlocks,
        leaf: u32,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) -> ControlFlow<()> {
        #[cfg(target_arch = "x86_64")]
        {
            if std::arch::is_x86_feature_detected!("avx512f") {
                // SAFETY: the machine has AVX-512F, as just tested.
                return unsafe { avx512(blocks, leaf, ray, query, statistics) };
            }
            if std::arch::is_x86_feature_detected!("avx2") {
                // SAFETY: the machine has AVX2, as just tested.
                return unsafe { avx2(blocks, leaf, ray, query, statistics) };
            }
        }
        blocks.intersect_leaf_lanes(leaf, ray, query, statistics)
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f")]
    fn avx512<Q: Query, S: TraversalStatistics>(
        blocks: &TriangleBlocks,
        leaf: u32,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) -> ControlFlow<()> {
        blocks.intersect_leaf_lanes(leaf, ray, query, statistics)
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn avx2<Q: Query, S: TraversalStatistics>(
        blocks: &TriangleBlocks,
        leaf: u32,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) -> ControlFlow<()> {
        blocks.intersect_leaf_lanes(leaf, ray, query, statistics)
    }
}
