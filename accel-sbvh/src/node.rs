//! A node while it is built: its references, and how they are divided.

use accel_bvh::ObjectSplit;
use accel_core::Aabb;
use accel_core::geometry::Axis;
use accel_core::reference::{Reference, bounds_of};

use crate::fragment::{Fragment, tight_bounds_of};

/// A node whose subtree is still to be built.
#[derive(Debug)]
pub(crate) struct Node {
    pub fragments: Fragments,
    pub depth: u32,
    /// The padded box, which the tree stores.
    pub bounds: Aabb,
    /// The box without pads, for costs.
    pub tight: Aabb,
    /// How many references its subtree may add; `None` where subtrees have no
    /// shares of their own.
    pub allowance: Option<usize>,
}

/// The fragments of a node, each exactly once in every order: sorted along the
/// three axes for the full sweep, or in any order at all for binning.
#[derive(Debug)]
pub(crate) struct Fragments {
    orders: Vec<Vec<Fragment>>,
}

impl Node {
    pub(crate) fn new(fragments: Fragments, depth: u32, allowance: Option<usize>) -> Self {
        Self {
            bounds: bounds_of(fragments.any_order()),
            tight: tight_bounds_of(fragments.any_order()),
            fragments,
            depth,
            allowance,
        }
    }

    /// The children of a node at `depth`, the allowance shared in proportion to
    /// their references.
    pub(crate) fn children(
        halves: [Fragments; 2],
        depth: u32,
        allowance: Option<usize>,
    ) -> [Self; 2] {
        let [left, right] = halves.each_ref().map(|half| half.any_order().len());
        let left_share =
            allowance.map(|all| (all as u128 * left as u128 / (left + right) as u128) as usize);
        let shares = [
            left_share,
            allowance.zip(left_share).map(|(all, left)| all - left),
        ];
        let mut shares = shares.into_iter();
        halves.map(|half| Self::new(half, depth + 1, shares.next().flatten()))
    }

    pub(crate) fn count(&self) -> usize {
        self.fragments.any_order().len()
    }
}

impl Fragments {
    /// Sorted copies along every axis.
    pub(crate) fn sorted(fragments: Vec<Fragment>) -> Self {
        let mut orders = vec![fragments.clone(), fragments.clone(), fragments];
        for (axis, order) in Axis::ALL.into_iter().zip(&mut orders) {
            sort_along(order, axis);
        }
        Self { orders }
    }

    /// Bytes that a fragment takes while its node is divided: in all orders, and
    /// in those of the children, one after the other. A list has up to twice the
    /// room that it needs, which tells where there is only one.
    pub(crate) fn bytes_per_fragment(object_split: ObjectSplit) -> usize {
        let copies = match object_split {
            ObjectSplit::FullSweep => 2 * Axis::ALL.len(),
            ObjectSplit::Binned { .. } => 4,
        };
        copies * size_of::<Fragment>()
    }

    /// One copy, unsorted.
    pub(crate) fn unsorted(fragments: Vec<Fragment>) -> Self {
        Self {
            orders: vec![fragments],
        }
    }

    pub(crate) fn any_order(&self) -> &[Fragment] {
        &self.orders[0]
    }

    /// The order along `axis`; `None` where there is no order.
    pub(crate) fn along(&self, axis: Axis) -> Option<&[Fragment]> {
        let is_sorted = self.orders.len() == Axis::ALL.len();
        is_sorted.then(|| self.orders[axis.index()].as_slice())
    }

    pub(crate) fn into_references(mut self) -> Vec<Reference> {
        let order = self.orders.swap_remove(0);
        order.iter().map(|fragment| fragment.reference).collect()
    }

    /// Divides the fragments: `side` tells where each goes as it is, or that it
    /// is replaced. `replacements` are what the replaced ones become on the left
    /// and on the right.
    pub(crate) fn divide(
        self,
        side: impl Fn(&Fragment) -> Placement,
        replacements: [Vec<Fragment>; 2],
    ) -> [Self; 2] {
        let is_sorted = self.orders.len() == Axis::ALL.len();
        let count = self.orders.len();
        let mut halves = [(); 2].map(|()| Self {
            orders: Vec::with_capacity(count),
        });
        let mut new = replacements;
        for (axis, mut order) in Axis::ALL.into_iter().zip(self.orders) {
            let mut right = Vec::new();
            order.retain(|fragment| match side(fragment) {
                Placement::Left => true,
                Placement::Right => {
                    right.push(*fragment);
                    false
                }
                Placement::Replaced => false,
            });
            // What is taken from a large node is not kept for a small one.
            order.shrink_to(order.len() * 2);
            for ((half, kept), new) in halves.iter_mut().zip([order, right]).zip(&mut new) {
                if is_sorted {
                    sort_along(new, axis);
                }
                let merged = if is_sorted {
                    merge(kept, new, axis)
                } else {
                    append(kept, new)
                };
                half.orders.push(merged);
            }
        }
        halves
    }
}

/// Where a fragment goes when its node is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Placement {
    Left,
    Right,
    /// Others take its place.
    Replaced,
}

fn sort_along(fragments: &mut [Fragment], axis: Axis) {
    fragments.sort_unstable_by_key(|fragment| fragment.reference.key(axis));
}

fn append(mut kept: Vec<Fragment>, new: &[Fragment]) -> Vec<Fragment> {
    kept.extend_from_slice(new);
    kept
}

/// Merges two lists that are sorted along `axis`.
fn merge(kept: Vec<Fragment>, new: &[Fragment], axis: Axis) -> Vec<Fragment> {
    if new.is_empty() {
        return kept;
    }
    let mut merged = Vec::with_capacity(kept.len() + new.len());
    let mut rest = kept.as_slice();
    for fragment in new {
        let key = fragment.reference.key(axis);
        let before = rest.partition_point(|other| other.reference.key(axis) < key);
        merged.extend_from_slice(&rest[..before]);
        merged.push(*fragment);
        rest = &rest[before..];
    }
    merged.extend_from_slice(rest);
    merged
}
