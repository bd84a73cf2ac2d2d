//! Counting pieces on both sides of a plane without visiting them all: a
//! bounding sphere hierarchy with the number of pieces below each node (Ize
//! 2008, section 3.5).

use accel_core::geometry::Side;
use accel_core::glam::DVec3;

use crate::pieces::{Counts, Pieces, bounds_of, margin};
use crate::split_plane::SplitPlane;

/// Nodes of at most this many pieces test them one by one.
const LEAF_SIZE: usize = 4;

/// Spheres around the pieces of a node of the tree.
pub(crate) struct SphereHierarchy<'a> {
    pieces: &'a Pieces,
    order: Vec<u32>,
    /// In depth-first order.
    nodes: Vec<SphereNode>,
}

struct SphereNode {
    center: DVec3,
    radius: f64,
    /// The largest pad of the pieces below.
    pad: f64,
    /// The range of `order` below.
    first: u32,
    count: u32,
    /// The node to go on with if this one is decided.
    next: u32,
}

impl<'a> SphereHierarchy<'a> {
    pub(crate) fn new(pieces: &'a Pieces) -> Self {
        let centers: Vec<DVec3> = (0..pieces.len())
            .map(|piece| {
                let [low, high] = bounds_of(pieces.corners(piece));
                0.5 * low + 0.5 * high
            })
            .collect();
        let mut hierarchy = Self {
            pieces,
            order: (0..pieces.len() as u32).collect(),
            nodes: Vec::with_capacity(pieces.len()),
        };
        hierarchy.build(&centers, 0, pieces.len());
        hierarchy
    }

    /// Builds the subtree of a range by halving it along its widest axis:
    /// recursion to the logarithm of the count.
    fn build(&mut self, centers: &[DVec3], first: usize, count: usize) {
        let position = self.nodes.len();
        let node = self.enclose(first, count);
        self.nodes.push(node);
        if count > LEAF_SIZE {
            let order = &mut self.order[first..first + count];
            let points: Vec<DVec3> = order.iter().map(|&piece| centers[piece as usize]).collect();
            let [low, high] = bounds_of(&points);
            let axis = widest(high - low);
            let key = |piece: &u32| (centers[*piece as usize][axis], *piece);
            order.select_nth_unstable_by(count / 2, |a, b| {
                key(a).0.total_cmp(&key(b).0).then(a.cmp(b))
            });
            self.build(centers, first, count / 2);
            self.build(centers, first + count / 2, count - count / 2);
        }
        self.nodes[position].next = self.nodes.len() as u32;
    }

    fn enclose(&self, first: usize, count: usize) -> SphereNode {
        let below = &self.order[first..first + count];
        let corners = || {
            below
                .iter()
                .flat_map(|&piece| self.pieces.corners(piece as usize))
        };
        let unbounded = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = corners().fold(unbounded, |(low, high), &corner| {
            (low.min(corner), high.max(corner))
        });
        let center = 0.5 * low + 0.5 * high;
        let distance = |&corner: &DVec3| corner.distance(center);
        let pads = below.iter().map(|&piece| self.pieces.pad(piece as usize));
        SphereNode {
            center,
            radius: corners().map(distance).fold(0.0, f64::max),
            pad: pads.fold(0.0, f64::max),
            first: first as u32,
            count: count as u32,
            next: 0,
        }
    }

    /// How many pieces lie where; `None` as soon as `may_pay` says of the counts so
    /// far, which only grow, that the plane does not.
    pub(crate) fn count(
        &self,
        plane: &SplitPlane,
        may_pay: impl Fn(&Counts) -> bool,
    ) -> Option<Counts> {
        let mut counts = Counts::default();
        let length = plane.normal().length();
        let mut position = 0;
        while let Some(node) = self.nodes.get(position) {
            let s = plane.signed_distance(node.center);
            let reach = node.radius * length;
            let side = Side::of_range(s - reach, s + reach, -margin(node.pad, plane));
            if side != Side::Straddling {
                counts.add(side, node.count as usize);
                position = node.next as usize;
                continue;
            }
            if node.count as usize <= LEAF_SIZE {
                let range = node.first as usize..(node.first + node.count) as usize;
                for &piece in &self.order[range] {
                    counts.add(self.pieces.side(piece as usize, plane), 1);
                }
                if !may_pay(&counts) {
                    return None;
                }
            }
            position += 1;
        }
        Some(counts)
    }
}

impl Counts {
    fn add(&mut self, side: Side, count: usize) {
        match side {
            Side::Back => self.behind += count,
            Side::Front => self.in_front += count,
            Side::Planar => self.planar += count,
            Side::Straddling => self.straddling += count,
        }
    }
}

fn widest(extent: DVec3) -> usize {
    if extent.x >= extent.y && extent.x >= extent.z {
        0
    } else if extent.y >= extent.z {
        1
    } else {
        2
    }
}
