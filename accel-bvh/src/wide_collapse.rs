//! From two children a node to several: which nodes of a binary tree a wide one keeps.
//!
//! The surface area heuristic decides: what a ray costs in expectation is the area of
//! all inner nodes that stay, since the leaves are those of the binary tree. With
//! `area(n)` the half area of the box of node `n`, relative to the root's:
//!
//! ```text
//! cost(n, 1)     = area(n) + split(n, WIDTH)       as a node of its own
//! split(n, i)    = min over k of cost(left, k) + cost(right, i - k)
//! cost(n, i)     = min(split(n, i), cost(n, 1))   as at most i nodes
//! cost(leaf, i)  = 0
//! ```
//!
//! # Source
//! Ylitie, Karras and Laine, *Efficient Incoherent Ray Traversal on GPUs Through
//! Compressed Wide BVHs*, 2017, section 3.1.

use accel_core::{Aabb, Primitive};

use crate::{Bvh, BvhNode, NodeHandle};

/// What a node costs at least, so that of nodes without extent few are kept.
const LEAST_AREA: f32 = 1e-9;

/// A [`Bvh`] seen as a tree of at most `WIDTH` children a node, of all such the one of
/// the least cost.
///
/// ```
/// use accel_bvh::{BvhBuilder, Sphere, WideCollapse};
/// # fn main() -> Result<(), accel_bvh::BuildError> {
/// let spheres = [0.0, 4.0, 9.0].map(|x| Sphere::new([x, 0.0, 0.0], 1.0));
/// let bvh = BvhBuilder::default().build(&spheres)?;
/// let wide = WideCollapse::<_, 8>::new(&bvh);
/// let root = wide.root().unwrap();
/// assert!(wide.children(&root).iter().all(|child| child.handle.is_leaf()));
/// # Ok(())
/// # }
/// ```
pub struct WideCollapse<'a, P: Primitive, const WIDTH: usize> {
    bvh: &'a Bvh<P>,
    /// Of the inner nodes in depth-first order, so that the left child of a node comes
    /// next to it.
    nodes: Vec<Costs<WIDTH>>,
}

/// A node of the binary tree that a wide one keeps.
#[derive(Clone, Copy, Debug)]
pub struct KeptNode {
    /// The node.
    pub handle: NodeHandle,
    /// Its box.
    pub bounds: Aabb,
    /// Among the inner nodes; of a leaf, any number.
    number: u32,
}

/// What is known of an inner node.
#[derive(Clone, Copy)]
struct Costs<const WIDTH: usize> {
    handle: NodeHandle,
    /// The number of the right child, if that is an inner node.
    right: u32,
    /// The least cost of what it holds: as one node, as at most two, and so on.
    as_at_most: [f32; WIDTH],
}

impl<'a, P: Primitive, const WIDTH: usize> WideCollapse<'a, P, WIDTH> {
    /// Weighs all nodes of `bvh`, in time and memory that grow with their number.
    pub fn new(bvh: &'a Bvh<P>) -> Self {
        const { assert!(WIDTH >= 2, "a node has two children or more") };
        let mut collapse = Self {
            bvh,
            nodes: Vec::new(),
        };
        collapse.number_nodes();
        for number in (0..collapse.nodes.len()).rev() {
            collapse.weigh(number);
        }
        collapse
    }

    /// The root; `None` where there is nothing to hit.
    pub fn root(&self) -> Option<KeptNode> {
        self.bvh.root().map(|(handle, bounds)| KeptNode {
            handle,
            bounds,
            number: 0,
        })
    }

    /// The children of a node in the wide tree, in the order of the binary tree; none
    /// of a leaf.
    pub fn children(&self, node: &KeptNode) -> Vec<KeptNode> {
        let mut kept = Vec::with_capacity(WIDTH);
        self.split(node, WIDTH, &mut kept);
        kept
    }

    /// Numbers inner nodes and notes their areas.
    fn number_nodes(&mut self) {
        let Some((root, bounds)) = self.bvh.root() else {
            return;
        };
        let whole = bounds.half_area();
        // With the number of the parent whose right child it is.
        let mut pending = vec![(root, bounds, None::<usize>)];
        while let Some((handle, bounds, parent)) = pending.pop() {
            let BvhNode::Inner {
                bounds: [left_bounds, right_bounds],
                children: [left, right],
            } = self.bvh.node(handle)
            else {
                continue;
            };
            let number = self.nodes.len();
            if let Some(parent) = parent {
                self.nodes[parent].right = number as u32;
            }
            let area = bounds.half_area() / whole;
            let mut as_at_most = [0.0; WIDTH];
            // Not a number where areas are beyond all numbers, or there are none.
            as_at_most[0] = (area as f32).max(LEAST_AREA);
            self.nodes.push(Costs {
                handle,
                right: 0,
                as_at_most,
            });
            pending.push((right, right_bounds, Some(number)));
            pending.push((left, left_bounds, None));
        }
    }

    /// Replaces the area of a node, whose children are weighed, by its costs.
    fn weigh(&mut self, number: usize) {
        let node = &self.nodes[number];
        let BvhNode::Inner { children, .. } = self.bvh.node(node.handle) else {
            return;
        };
        let [left, right] = [number as u32 + 1, node.right];
        let [left, right] = [(children[0], left), (children[1], right)]
            .map(|(handle, number)| self.costs(handle, number));
        let mut costs = [node.as_at_most[0] + cheapest_share(&left, &right, WIDTH).1; WIDTH];
        for count in 2..=WIDTH {
            let split = cheapest_share(&left, &right, count).1;
            costs[count - 1] = split.min(costs[0]);
        }
        self.nodes[number].as_at_most = costs;
    }

    fn costs(&self, handle: NodeHandle, number: u32) -> [f32; WIDTH] {
        if handle.is_leaf() {
            return [0.0; WIDTH];
        }
        self.nodes[number as usize].as_at_most
    }

    /// Keeps at most `count` nodes in place of the children of an inner node.
    fn split(&self, node: &KeptNode, count: usize, kept: &mut Vec<KeptNode>) {
        let BvhNode::Inner { bounds, children } = self.bvh.node(node.handle) else {
            return;
        };
        let numbers = [node.number + 1, self.nodes[node.number as usize].right];
        let [left, right] = [0, 1].map(|side| KeptNode {
            handle: children[side],
            bounds: bounds[side],
            number: numbers[side],
        });
        let costs = [&left, &right].map(|child| self.costs(child.handle, child.number));
        let (share, _) = cheapest_share(&costs[0], &costs[1], count);
        self.keep(left, share, kept);
        self.keep(right, count - share, kept);
    }

    /// Keeps a node, or at most `count` below it where these cost no more.
    fn keep(&self, node: KeptNode, count: usize, kept: &mut Vec<KeptNode>) {
        let costs = self.costs(node.handle, node.number);
        if costs[count - 1] < costs[0] {
            self.split(&node, count, kept);
        } else {
            kept.push(node);
        }
    }
}

/// How many of `count` nodes the left child gets, for the least cost of both.
fn cheapest_share<const WIDTH: usize>(
    left: &[f32; WIDTH],
    right: &[f32; WIDTH],
    count: usize,
) -> (usize, f32) {
    let shares = (1..count).map(|share| (share, left[share - 1] + right[count - share - 1]));
    shares
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .expect("there is one at least")
}

#[cfg(test)]
mod tests {
    use accel_core::Triangle;
    use accel_core::testing::families;

    use super::*;
    use crate::{BvhBuilder, LeafRule};

    const WIDTH: usize = 4;

    fn fine_bvh(scene: &[Triangle]) -> Bvh<Triangle> {
        let builder = BvhBuilder {
            leaf_rule: LeafRule::StopAt(1),
            ..BvhBuilder::default()
        };
        builder.build(scene).unwrap()
    }

    /// The areas of the inner nodes that are kept, and how many they are.
    fn kept(collapse: &WideCollapse<'_, Triangle, WIDTH>) -> (f64, usize) {
        let (mut area, mut count) = (0.0, 0);
        let mut pending = Vec::from_iter(collapse.root());
        while let Some(node) = pending.pop() {
            if !node.handle.is_leaf() {
                area += node.bounds.half_area();
                count += 1;
            }
            let children = collapse.children(&node);
            assert!(children.len() <= WIDTH);
            pending.extend(children);
        }
        (area, count)
    }

    /// The least area of inner nodes at and below one, by trying everything.
    fn least_area(bvh: &Bvh<Triangle>, handle: NodeHandle, bounds: Aabb) -> f64 {
        if handle.is_leaf() {
            return 0.0;
        }
        let below = |nodes: &[(NodeHandle, Aabb)]| -> f64 {
            nodes.iter().map(|&(n, b)| least_area(bvh, n, b)).sum()
        };
        let choices = openings(bvh, handle, WIDTH);
        let least = choices.iter().map(|nodes| below(nodes));
        bounds.half_area() + least.fold(f64::INFINITY, f64::min)
    }

    /// All ways to put at most `count` nodes in place of an inner one.
    fn openings(
        bvh: &Bvh<Triangle>,
        handle: NodeHandle,
        count: usize,
    ) -> Vec<Vec<(NodeHandle, Aabb)>> {
        let BvhNode::Inner { bounds, children } = bvh.node(handle) else {
            return Vec::new();
        };
        let mut found = Vec::new();
        for share in 1..count {
            let [left, right] = [(0, share), (1, count - share)].map(|(side, share)| {
                let (child, bounds) = (children[side], bounds[side]);
                let mut ways = vec![vec![(child, bounds)]];
                ways.extend((2..=share).flat_map(|share| openings(bvh, child, share)));
                ways
            });
            for first in &left {
                found.extend(right.iter().map(|second| [&first[..], second].concat()));
            }
        }
        found
    }

    #[test]
    fn no_other_collapse_keeps_less_area() {
        for seed in 0..40 {
            let scene = families::find("soup-mixed-sizes").unwrap().scene(seed, 11);
            let bvh = fine_bvh(&scene);
            let (root, bounds) = bvh.root().unwrap();
            let (area, _) = kept(&WideCollapse::new(&bvh));
            let least = least_area(&bvh, root, bounds);
            assert!(area <= least * (1.0 + 1e-5), "seed {seed}: {area}, {least}");
        }
    }

    #[test]
    fn nodes_without_extent_are_filled() {
        let point = Triangle::new([1.0; 3], [1.0; 3], [1.0; 3]);
        let bvh = fine_bvh(&[point; 64]);
        let (_, count) = kept(&WideCollapse::new(&bvh));
        // 16 of four leaves each, 4 of these, and the root.
        assert_eq!(count, 21);
    }

    #[test]
    fn a_leaf_has_no_children_and_nothing_has_no_root() {
        let bvh = fine_bvh(&[Triangle::new([0.0; 3], [1.0; 3], [0.0, 1.0, 0.0])]);
        let collapse = WideCollapse::<_, WIDTH>::new(&bvh);
        assert!(collapse.children(&collapse.root().unwrap()).is_empty());
        assert!(
            WideCollapse::<_, WIDTH>::new(&fine_bvh(&[]))
                .root()
                .is_none()
        );
    }
}
