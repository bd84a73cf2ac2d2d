//! Rays in packets: what a traversal of many rays at once wants to know.
//!
//! A [`RayPacket`] holds its rays in vectors of lanes, and what they have in
//! common: origin, signs, shear axis, and bounds by interval arithmetic. All box
//! tests compute what [`PreparedRay::slab`] computes, lane by lane, so that a
//! ray in a packet meets the same boxes as the ray alone.

mod bounds;
mod ray_lanes;
#[cfg(test)]
mod tests;

use glam::Vec3;

use super::PreparedRay;
use crate::geometry::Axis;
use crate::simd::Lanes;

pub use bounds::PacketBounds;
pub use ray_lanes::RayLanes;

/// Rays in `VECTORS` vectors of lanes, made ready for traversal.
#[derive(Clone, Debug)]
pub struct RayPacket<'a, L, const VECTORS: usize> {
    rays: &'a [Option<PreparedRay>],
    lanes: [RayLanes<L>; VECTORS],
    t_max: [L; VECTORS],
    shared: SharedFacts,
}

/// What all rays of a packet have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SharedFacts {
    /// The origin, if it is one.
    pub origin: Option<Vec3>,
    /// By axis, whether the directions are negative, if they agree on every
    /// axis.
    pub signs: Option<[bool; 3]>,
    /// The axis along which all directions are longest, if it is one.
    pub shear_axis: Option<Axis>,
}

/// One vector of a packet.
#[derive(Debug)]
pub struct PacketVector<'a, L> {
    /// The rays one by one, as many as there are lanes or fewer.
    pub rays: &'a [Option<PreparedRay>],
    /// The same in lanes.
    pub lanes: &'a RayLanes<L>,
    /// Hits beyond this matter no more; minus infinity for lanes that are empty
    /// or answered.
    pub t_max: &'a mut L,
    /// What the whole packet has in common.
    pub shared: &'a SharedFacts,
}

impl<'a, L: Lanes, const VECTORS: usize> RayPacket<'a, L, VECTORS> {
    /// Puts `rays` into lanes; ray `i` starts with `t_max(i)`.
    ///
    /// # Panics
    /// If there are more rays than lanes, or no ray at all.
    #[inline(always)]
    pub fn new(rays: &'a [Option<PreparedRay>], t_max: impl Fn(usize) -> f32) -> Self {
        assert!(rays.len() <= VECTORS * L::COUNT, "a lane for every ray");
        let first = rays.iter().flatten().next();
        let first = first.expect("a packet has at least one ray");
        // Empty lanes hold a ray of the packet, so that no bound depends on them.
        let mut packet = Self {
            rays,
            lanes: [RayLanes::splat(first); VECTORS],
            t_max: [L::splat(f32::NEG_INFINITY); VECTORS],
            shared: SharedFacts {
                origin: Some(first.origin()),
                signs: Some(Axis::ALL.map(|axis| first.is_negative(axis))),
                shear_axis: Some(first.shear().axis),
            },
        };
        let mut has_one_axis = true;
        for (index, ray) in rays.iter().enumerate() {
            if let Some(ray) = ray {
                let (vector, lane) = (index / L::COUNT, index % L::COUNT);
                packet.lanes[vector].set(lane, ray);
                packet.t_max[vector].lanes_mut()[lane] = t_max(index);
                has_one_axis &= ray.shear().axis == first.shear().axis;
            }
        }
        let (mut has_one_origin, mut have_same_signs) = (true, true);
        for lanes in &mut packet.lanes {
            lanes.pad();
            has_one_origin &= lanes.all_start_at(first.origin());
            have_same_signs &= lanes.all_have_signs_of(first);
        }
        let shared = &mut packet.shared;
        shared.origin = shared.origin.filter(|_| has_one_origin);
        shared.signs = shared.signs.filter(|_| have_same_signs);
        shared.shear_axis = shared.shear_axis.filter(|_| has_one_axis);
        packet
    }

    /// What the rays have in common.
    #[inline(always)]
    pub fn shared(&self) -> &SharedFacts {
        &self.shared
    }

    /// Bounds of all rays: computed here, so ask once.
    #[inline(always)]
    pub fn bounds(&self) -> PacketBounds {
        PacketBounds::of(&self.lanes)
    }

    /// The rays of a vector, in lanes.
    #[inline(always)]
    pub fn lanes(&self, vector: usize) -> &RayLanes<L> {
        &self.lanes[vector]
    }

    /// The directions of the rays of a vector, in lanes; empty lanes hold that of
    /// another ray of the packet.
    #[inline(always)]
    pub fn directions(&self, vector: usize) -> [L; 3] {
        let mut directions = [L::splat(0.0); 3];
        let Some(any) = self.rays.iter().flatten().next() else {
            return directions;
        };
        let rays = self.rays.iter().skip(vector * L::COUNT);
        let in_lanes = rays.chain(std::iter::repeat(&None)).take(L::COUNT);
        for (lane, ray) in in_lanes.enumerate() {
            let direction = ray.as_ref().unwrap_or(any).direction();
            for axis in 0..3 {
                directions[axis].lanes_mut()[lane] = direction[axis];
            }
        }
        directions
    }

    /// By lane, the `t` beyond which hits matter no more; minus infinity for
    /// lanes that are empty or answered.
    #[inline(always)]
    pub fn t_max(&self, vector: usize) -> L {
        self.t_max[vector]
    }

    /// The largest `t_max` of all rays.
    #[inline(always)]
    pub fn farthest(&self) -> f32 {
        let mut most = L::splat(f32::NEG_INFINITY);
        for &t_max in &self.t_max {
            most = most.max_or_keep(t_max);
        }
        most.lanes()
            .iter()
            .fold(f32::NEG_INFINITY, |a, &b| a.max(b))
    }

    /// A vector with all that a leaf needs.
    #[inline(always)]
    pub fn vector(&mut self, vector: usize) -> PacketVector<'_, L> {
        let first = vector * L::COUNT;
        let end = self.rays.len().min(first + L::COUNT);
        PacketVector {
            rays: &self.rays[first.min(end)..end],
            lanes: &self.lanes[vector],
            t_max: &mut self.t_max[vector],
            shared: &self.shared,
        }
    }

    /// The slab test of one vector against a box, of which `plane` gives the low
    /// or the high plane of an axis: where each ray enters it, no earlier than
    /// its `t_min`, and the mask of those that meet it no later than their
    /// `t_max`.
    #[inline(always)]
    pub fn meets(&self, vector: usize, plane: impl Fn(usize, bool) -> f32) -> (L, u32) {
        let (near, far) = self.slab(vector, plane);
        (near, near.le_mask(far))
    }

    /// As [`meets`](Self::meets), with where each ray leaves the box instead of
    /// the mask: no later than its `t_max`, and before it enters if it misses.
    #[inline(always)]
    pub fn slab(&self, vector: usize, plane: impl Fn(usize, bool) -> f32) -> (L, L) {
        match &self.shared.signs {
            Some(signs) => self.lanes[vector].slab_by_sign(signs, self.t_max[vector], plane),
            None => self.lanes[vector].slab(self.t_max[vector], plane),
        }
    }
}

impl<L: Lanes> PacketVector<'_, L> {
    /// The ray in `lane`, `None` if there is none.
    #[inline]
    pub fn ray(&self, lane: usize) -> Option<&PreparedRay> {
        self.rays.get(lane)?.as_ref()
    }

    /// Hits of `lane` beyond `t_max` matter no more.
    #[inline]
    pub fn shorten(&mut self, lane: usize, t_max: f32) {
        self.t_max.lanes_mut()[lane] = t_max;
    }

    /// `lane` is answered: it meets nothing any more.
    #[inline]
    pub fn retire(&mut self, lane: usize) {
        self.shorten(lane, f32::NEG_INFINITY);
    }
}

/// The lanes of a mask, lowest first.
#[inline]
pub fn lanes_of(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = (mask != 0).then(|| mask.trailing_zeros() as usize);
        mask &= mask.wrapping_sub(1);
        lane
    })
}
