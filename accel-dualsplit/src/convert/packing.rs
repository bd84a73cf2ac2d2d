//! From plans to words. Siblings are adjacent, everything else is in depth-first
//! order (Lin 2019, section 4).
//!
//! Offsets are relative, so the words below a node do not depend on where they
//! will lie: large subtrees are converted in parallel and appended. What is large
//! depends on the tree alone, so the words are the same for any number of
//! threads.

use accel_bvh::{Bvh, BvhNode, NodeHandle};
use accel_core::build::join;
use accel_core::layout::LeafStorage;
use accel_core::{Aabb, AccelerationStructure, BuildError, Primitive};

use super::carving::{Carving, CarvingChoices, CarvingPlan};
use super::sizes::{SizedNode, SubtreeSizes};
use super::splitting::SplittingPlan;
use crate::codec::{Header, LEAF_WORDS, MAX_OFFSET, NODE_WORDS};

/// Subtrees of fewer references than this are converted by one thread.
const FORK_SIZE: u32 = 4096;

/// Nothing forks further below the root than this.
const FORK_DEPTH: u32 = 24;

/// Bytes that a conversion holds at most, besides the BVH: for each inner node a
/// splitting node, and three carving nodes of two planes each before either child.
/// One bounding node of six planes takes no more.
pub(super) fn most_bytes<P: Primitive>(bvh: &Bvh<P>) -> usize {
    let storage = bvh.stored().leaves().bytes();
    let nodes = bvh.node_bytes() / accel_bvh::INNER_NODE_BYTES + 1;
    let words = nodes * (NODE_WORDS * 7 + LEAF_WORDS);
    words * size_of::<u32>() + storage.references + storage.primitives
}

pub(super) struct Packing<'a, P: Primitive> {
    choices: &'a CarvingChoices,
    bvh: &'a Bvh<P>,
    sizes: &'a SubtreeSizes,
}

/// A child of a splitting node whose first word is reserved.
struct Reserved {
    position: usize,
    node: SizedNode,
    plan: CarvingPlan,
    depth: u32,
}

impl<'a, P: Primitive> Packing<'a, P> {
    pub(super) fn new(
        choices: &'a CarvingChoices,
        bvh: &'a Bvh<P>,
        sizes: &'a SubtreeSizes,
    ) -> Self {
        Self {
            choices,
            bvh,
            sizes,
        }
    }

    pub(super) fn pack(&self, root: NodeHandle, bounds: Aabb) -> Result<Vec<u32>, BuildError> {
        let node = self.sizes.root(self.bvh, root);
        let mut words = Vec::new();
        let plan = CarvingPlan::uncarved(bounds);
        let position = reserve(&mut words, first_words(node, &plan));
        let root = Reserved {
            position,
            node,
            plan,
            depth: 0,
        };
        self.pack_below(root, &mut words)?;
        Ok(words)
    }

    /// Writes a node and everything below it, on one thread unless it is large.
    fn pack_below(&self, root: Reserved, words: &mut Vec<u32>) -> Result<(), BuildError> {
        let mut pending = vec![root];
        while let Some(reserved) = pending.pop() {
            let forks = reserved.node.references >= FORK_SIZE && reserved.depth < FORK_DEPTH;
            let Some([first, second]) = self.write(&reserved, words)? else {
                continue;
            };
            if forks {
                self.fork(first, second, words)?;
            } else {
                pending.extend([second, first]);
            }
        }
        Ok(())
    }

    /// Writes both children and everything below them, in parallel.
    fn fork(
        &self,
        first: Reserved,
        mut second: Reserved,
        words: &mut Vec<u32>,
    ) -> Result<(), BuildError> {
        // The second starts behind a copy of its own place, which keeps its
        // offsets right until the words of the first come between.
        let own = first_words(second.node, &second.plan);
        let mut below_second = vec![0; own];
        let position = std::mem::take(&mut second.position);
        let (first_packed, second_packed) = join(
            || self.pack_below(first, words),
            || self.pack_below(second, &mut below_second),
        );
        first_packed.and(second_packed)?;
        let distance = words.len() - (position + own);
        words[position..position + own].copy_from_slice(&below_second[..own]);
        words.extend_from_slice(&below_second[own..]);
        move_target(words, position, distance)
    }

    /// Writes the reserved node, the carving nodes under it and the splitting
    /// node under these; reserves that node's children.
    fn write(
        &self,
        reserved: &Reserved,
        words: &mut Vec<u32>,
    ) -> Result<Option<[Reserved; 2]>, BuildError> {
        let Reserved {
            mut position,
            node,
            ref plan,
            depth,
        } = *reserved;
        let source = self.bvh.node(node.handle);
        let mut carvings = plan.carvings().peekable();
        while let Some(carving) = carvings.next() {
            let next = carvings.peek().copied();
            let header = |is_leaf| Header::Carving {
                planes: carving.planes,
                is_leaf,
            };
            let positions = carving.stored_positions();
            match source {
                BvhNode::Leaf(leaf) if next.is_none() => {
                    write_node(words, position, header(true), leaf as usize, positions)?;
                    return Ok(None);
                }
                _ => {
                    let offset = words.len() - position;
                    write_node(words, position, header(false), offset, positions)?;
                }
            }
            // What follows is no plain leaf: that would be this node.
            position = reserve(words, next.map_or(NODE_WORDS, carving_words));
        }
        match source {
            BvhNode::Leaf(leaf) => {
                words[position] = encode(Header::Leaf, leaf as usize)?;
                Ok(None)
            }
            BvhNode::Inner { bounds, children } => {
                let children = self.sizes.children(self.bvh, node, children);
                let split = SplittingPlan::cheapest(self.choices, plan.region, bounds, children);
                let [(first, first_plan), (second, second_plan)] = split.children;
                let header = Header::Splitting {
                    axis: split.axis,
                    first_child_words: first_words(first, &first_plan),
                };
                let offset = words.len() - position;
                write_node(words, position, header, offset, &split.positions)?;
                let mut child = |node, plan| Reserved {
                    position: reserve(words, first_words(node, &plan)),
                    node,
                    plan,
                    depth: depth + 1,
                };
                Ok(Some([child(first, first_plan), child(second, second_plan)]))
            }
        }
    }
}

/// Words of the first node that stands for a node of the BVH.
fn first_words(node: SizedNode, plan: &CarvingPlan) -> usize {
    match plan.carvings().next() {
        Some(carving) => carving_words(carving),
        None if node.handle.is_leaf() => LEAF_WORDS,
        None => NODE_WORDS,
    }
}

fn carving_words(carving: Carving) -> usize {
    LEAF_WORDS + carving.planes.count()
}

fn reserve(words: &mut Vec<u32>, count: usize) -> usize {
    let position = words.len();
    words.resize(position + count, 0);
    position
}

fn write_node(
    words: &mut [u32],
    position: usize,
    header: Header,
    offset: usize,
    planes: &[f32],
) -> Result<(), BuildError> {
    let (first, rest) = words[position..]
        .split_first_mut()
        .expect("the node's words are reserved");
    *first = encode(header, offset)?;
    for (word, plane) in rest.iter_mut().zip(planes) {
        *word = plane.to_bits();
    }
    Ok(())
}

fn encode(header: Header, offset: usize) -> Result<u32, BuildError> {
    if offset > MAX_OFFSET {
        return Err(BuildError::OffsetOverflow {
            needed: offset,
            limit: MAX_OFFSET,
        });
    }
    Ok(header.encode(offset))
}

/// Moves the first child of the node at `position` away by `distance` words;
/// a leaf stays as it is.
fn move_target(words: &mut [u32], position: usize, distance: usize) -> Result<(), BuildError> {
    let word = crate::codec::FirstWord(words[position]);
    let header = Header::decode(word).expect("this node was just written");
    if !header.is_leaf() {
        words[position] = encode(header, word.offset() as usize + distance)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use accel_bvh::BvhBuilder;
    use accel_core::{RaySegment, Sphere};

    use super::*;
    use crate::codec::NodeWords;
    use crate::convert::CarvingRules;
    use crate::{CarvingCosts, DualSplitNodes, DualSplitTree, Partitioning, check_words};

    #[test]
    fn an_offset_beyond_26_bits_is_a_typed_error_and_the_largest_is_none() {
        let node = |offset| write_node(&mut [0; 3], 0, Header::Leaf, offset, &[]);
        assert_eq!(node((1 << 26) - 1), Ok(()));
        let error = BuildError::OffsetOverflow {
            needed: 1 << 26,
            limit: 67_108_863,
        };
        assert_eq!(node(1 << 26), Err(error));
    }

    #[test]
    fn moving_a_target_checks_its_offset_and_leaves_leaves_alone() {
        let splitting = Header::Splitting {
            axis: accel_core::geometry::Axis::X,
            first_child_words: 1,
        };
        let mut words = [splitting.encode(3), 0, 0];
        move_target(&mut words, 0, 7).unwrap();
        assert_eq!(words[0], splitting.encode(10));
        assert!(move_target(&mut words, 0, MAX_OFFSET).is_err());
        let mut leaf = [Header::Leaf.encode(5)];
        move_target(&mut leaf, 0, MAX_OFFSET).unwrap();
        assert_eq!(leaf[0], Header::Leaf.encode(5));
    }

    /// The root stands at the start and its children as many words behind it as
    /// asked for: as if a large subtree stood between.
    fn tree_with_offset(
        spheres: &[Sphere],
        offset: usize,
    ) -> Result<DualSplitTree<Sphere>, BuildError> {
        let bvh = BvhBuilder::default().build(spheres)?;
        let (handle, bounds) = bvh.root().expect("there are spheres");
        let rules = CarvingRules {
            partitioning: Partitioning::Identical,
            costs: CarvingCosts::default().into(),
        };
        let sizes = SubtreeSizes::new(&bvh, handle);
        let choices = CarvingChoices::new(&rules);
        let packing = Packing::new(&choices, &bvh, &sizes);
        let root = Reserved {
            position: 0,
            node: sizes.root(&bvh, handle),
            plan: CarvingPlan::uncarved(bounds),
            depth: 0,
        };
        let mut words = Vec::with_capacity(offset + 64);
        words.resize(offset, 0);
        packing.pack_below(root, &mut words)?;
        Ok(DualSplitTree {
            words: NodeWords::new(words),
            stored: bvh.stored().clone(),
            bounds: Some(bounds),
            depth: bvh.depth(),
            nodes: std::marker::PhantomData,
        })
    }

    #[test]
    fn a_tree_at_the_26_bit_limit_is_built_right_and_one_beyond_it_is_a_typed_error() {
        let sphere = |i: u8| Sphere::new([f32::from(i), 0.0, 0.0], 0.4);
        let spheres: Vec<Sphere> = (0..12).map(sphere).collect();
        let tree = tree_with_offset(&spheres, MAX_OFFSET).unwrap();
        assert_eq!(
            check_words::<DualSplitNodes>(tree.node_words(), |_| true),
            Ok(tree.depth())
        );
        tree.validate().unwrap();
        for i in 0..12_u8 {
            let ray = RaySegment::new([f32::from(i), 5.0, 0.0], [0.0, -1.0, 0.0]);
            assert_eq!(tree.closest_hit(&ray).map(|hit| hit.id), Some(i.into()));
        }
        let error = BuildError::OffsetOverflow {
            needed: MAX_OFFSET + 1,
            limit: MAX_OFFSET,
        };
        let beyond = tree_with_offset(&spheres, MAX_OFFSET + 1);
        assert_eq!(beyond.map(|_| ()), Err(error));
    }
}
