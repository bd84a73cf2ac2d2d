//! Triangles in blocks, corner by corner and coordinate by coordinate, so that
//! one instruction works on all triangles of a block.

mod block;
mod dispatch;

use std::ops::ControlFlow;

use self::block::Block;
use super::{LeafStorage, StorageBytes};
use crate::primitive::Triangle;
use crate::primitive::watertight::LaneTest;
use crate::query::Query;
use crate::ray::PreparedRay;
use crate::statistics::TraversalStatistics;

/// Leaves of blocks of `LANES` triangles: 16 for large leaves, 4 for those of a tree.
/// Each leaf begins a block; unused lanes hold NaN and are never hit.
///
/// Blocks of four work on every machine, and decide what the test of all lanes keeps
/// from the numbers that it has; wider ones sieve, with the vector units that the
/// machine has, found at run time once a leaf, and decide one by one.
#[derive(Clone, Debug)]
pub struct TriangleBlocks<const LANES: usize = 16> {
    blocks: Vec<Block<LANES>>,
    /// By id, the block and lane of one of its copies; 0 where no leaf holds the
    /// id, which the id there then tells.
    positions: Vec<u32>,
    reference_count: usize,
}

impl<const LANES: usize> LeafStorage<Triangle> for TriangleBlocks<LANES> {
    fn with_capacity(primitives: &[Triangle], references: usize) -> Self {
        const { assert!(1 <= LANES && LANES <= 16, "1 to 16 triangles a block") };
        Self {
            blocks: Vec::with_capacity(references.div_ceil(LANES)),
            positions: vec![0; primitives.len()],
            reference_count: 0,
        }
    }

    fn push_leaf(&mut self, primitives: &[Triangle], ids: &[u32]) -> u32 {
        let leaf = self.blocks.len() as u32;
        let block_count = ids.len().div_ceil(LANES);
        for (index, ids) in ids.chunks(LANES).enumerate() {
            let first = (self.blocks.len() * LANES) as u32;
            for (position, &id) in (first..).zip(ids) {
                self.positions[id as usize] = position;
            }
            let block = Block::new(primitives, ids, index + 1 == block_count);
            self.blocks.push(block);
        }
        self.reference_count += ids.len();
        leaf
    }

    #[inline(never)]
    fn intersect_leaf<Q: Query, S: TraversalStatistics>(
        &self,
        leaf: u32,
        ray: &PreparedRay,
        query: &mut Q,
        statistics: &mut S,
    ) -> ControlFlow<()> {
        if LANES == 4 {
            self.intersect_leaf_lanes(leaf, ray, query, statistics)
        } else {
            dispatch::intersect_leaf(self, leaf, ray, query, statistics)
        }
    }

    fn leaf_ids(&self, leaf: u32) -> impl Iterator<Item = u32> + '_ {
        let mut ended = false;
        let blocks = self.blocks[leaf as usize..].iter().map_while(move |block| {
            let ids = (!ended).then(|| block.used_ids());
            ended = block.is_last_in_leaf;
            ids
        });
        blocks.flatten().copied()
    }

    fn primitive(&self, id: u32) -> Option<Triangle> {
        let position = *self.positions.get(id as usize)? as usize;
        let (block, lane) = (self.blocks.get(position / LANES)?, position % LANES);
        (block.ids[lane] == id).then(|| block.triangle(lane))
    }

    fn replace(&mut self, primitives: &[Triangle]) {
        for block in &mut self.blocks {
            block.fill(primitives);
        }
    }

    fn reference_count(&self) -> usize {
        self.reference_count
    }

    fn bytes(&self) -> StorageBytes {
        let references = self.blocks.len() * size_of::<[u32; LANES]>();
        StorageBytes {
            references,
            primitives: size_of_val(self.blocks.as_slice()) - references
                + size_of_val(self.positions.as_slice()),
        }
    }
}

impl<const LANES: usize> TriangleBlocks<LANES> {
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
        for block in &self.blocks[leaf as usize..] {
            statistics.test_primitives(u32::from(block.used));
            block.offer(&test, ray, query)?;
            if block.is_last_in_leaf {
                break;
            }
        }
        ControlFlow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::query::AllHits;
    use crate::testing::{families, rays};

    fn check<const LANES: usize>() {
        let scene = families::find("axis-grid").unwrap().scene(1, 200);
        let held: Vec<u32> = (0..scene.len() as u32).filter(|id| id % 7 != 3).collect();
        let mut blocks = TriangleBlocks::<LANES>::with_capacity(&scene, held.len());
        let leaves: Vec<(u32, &[u32])> = [1, LANES, LANES + 1, 3 * LANES, 2]
            .into_iter()
            .scan(0, |first, count| {
                let ids = &held[*first..*first + count];
                *first += count;
                Some((blocks.push_leaf(&scene, ids), ids))
            })
            .collect();
        assert_eq!(blocks.reference_count(), 5 * LANES + 4);
        assert_eq!(blocks.primitive(held[0]), Some(scene[held[0] as usize]));
        assert_eq!(blocks.primitive(3), None);
        let mut moved = scene.clone();
        moved.reverse();
        for triangles in [&scene, &moved] {
            blocks.replace(triangles);
            for &(leaf, ids) in &leaves {
                assert_eq!(blocks.leaf_ids(leaf).collect::<Vec<_>>(), ids);
                for ray in rays::mixed(triangles, 3, 60) {
                    let Some(ray) = PreparedRay::new(&ray) else {
                        continue;
                    };
                    let (mut all, mut one_by_one) = (AllHits::new(&ray), AllHits::new(&ray));
                    let _ = blocks.intersect_leaf(leaf, &ray, &mut all, &mut ());
                    for &id in ids {
                        let triangle = &triangles[id as usize];
                        let _ = crate::layout::offer_primitive(triangle, id, &ray, &mut one_by_one);
                    }
                    assert_eq!(all.into_sorted(), one_by_one.into_sorted());
                }
            }
        }
    }

    #[test]
    fn leaves_are_those_put_in_and_hit_as_one_by_one() {
        check::<4>();
        check::<8>();
        check::<16>();
    }
}
