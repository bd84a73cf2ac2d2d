//! Rays in packets: what a traversal of many rays at once wants to know.
//!
//! A [`RayPacket`] holds its rays in vectors of lanes, and what they have in
//! common: origin, signs, shear axis, and bounds by interval arithmetic. All box
//! tests compute what [`PreparedRay::slab`] computes, lane by lane, so that a
//! ray in a packet meets the same boxes as the ray alone.

mod bounds;
mod packet_ray;
mod ray_lanes;
#[cfg(test)]
mod tests;

use glam::Vec3;

use super::PreparedRay;
use crate::geometry::Axis;
use crate::simd::Lanes;

pub use bounds::PacketBounds;
pub use packet_ray::{PacketRay, go_one_way, start_at_one_point};
pub use ray_lanes::RayLanes;

/// Rays in `VECTORS` vectors of lanes, made ready for traversal.
#[derive(Clone, Debug)]
pub struct RayPacket<'a, L, const VECTORS: usize> {
    rays: &'a [PacketRay],
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
    pub rays: &'a [PacketRay],
    /// The same in lanes.
    pub lanes: &'a RayLanes<L>,
    /// Hits beyond this matter no more; minus infinity for lanes that are empty
    /// or answered.
    pub t_max: &'a mut L,
    /// What the whole packet has in common.
    pub shared: &'a SharedFacts,
}

impl<'a, L: Lanes, const VECTORS: usize> RayPacket<'a, L, VECTORS> {
    /// Makes `rays` ready in lanes; ray `i` starts with `t_max(i)`. `None` if none
    /// of them can hit anything.
    ///
    /// # Panics
    /// If there are more rays than lanes.
    #[inline(always)]
    pub fn new(rays: &'a [PacketRay], t_max: impl Fn(usize) -> f32) -> Option<Self> {
        assert!(rays.len() <= VECTORS * L::COUNT, "a lane for every ray");
        // Rays of a packet mostly lean the same way; those that don't are made
        // ready one by one.
        let main = Axis::largest(rays.first()?.segment().direction);
        let (lanes, ready) = RayLanes::prepare(rays, 0, main);
        let mut packet = Self {
            rays,
            lanes: [lanes; VECTORS],
            t_max: [L::splat(f32::NEG_INFINITY); VECTORS],
            shared: SharedFacts {
                origin: None,
                signs: None,
                shear_axis: Some(main),
            },
        };
        let mut missing = [L::ALL & !ready; VECTORS];
        for (vector, missing) in missing.iter_mut().enumerate() {
            let first = vector * L::COUNT;
            if vector > 0 {
                let (lanes, ready) = RayLanes::prepare(rays, first, main);
                packet.lanes[vector] = lanes;
                *missing = L::ALL & !ready;
            }
            packet.t_max[vector] = L::from_fn(|lane| {
                if first + lane < rays.len() {
                    t_max(first + lane)
                } else {
                    f32::NEG_INFINITY
                }
            });
        }
        if missing.iter().any(|&missing| missing != 0) {
            packet.set_one_by_one(&missing)?;
        }
        packet.shared.origin = packet.common_origin();
        packet.shared.signs = packet.common_signs();
        Some(packet)
    }

    /// Sets the lanes that are `missing`. Those without a ray that can hit
    /// anything hold another ray of the packet, so that no bound depends on them.
    #[cold]
    #[inline(never)]
    fn set_one_by_one(&mut self, missing: &[u32; VECTORS]) -> Option<()> {
        let substitute = self.rays.iter().find_map(PacketRay::prepared)?;
        for (vector, &missing) in missing.iter().enumerate() {
            for lane in lanes_of(missing) {
                let ray = self.rays.get(vector * L::COUNT + lane);
                let ray = ray.and_then(PacketRay::prepared);
                if ray.is_none() {
                    self.t_max[vector].lanes_mut()[lane] = f32::NEG_INFINITY;
                }
                let ray = ray.unwrap_or(substitute);
                self.lanes[vector].set(lane, ray);
                let shear_axis = &mut self.shared.shear_axis;
                *shear_axis = shear_axis.filter(|&axis| axis == ray.shear().axis);
            }
        }
        Some(())
    }

    #[inline(always)]
    fn common_origin(&self) -> Option<Vec3> {
        let [x, y, z] = &self.lanes[0].origin;
        let origin = Vec3::new(x.lanes()[0], y.lanes()[0], z.lanes()[0]);
        let mut is_common = true;
        for lanes in &self.lanes {
            is_common &= lanes.all_start_at(origin);
        }
        is_common.then_some(origin)
    }

    #[inline(always)]
    fn common_signs(&self) -> Option<[bool; 3]> {
        let mut signs = [false; 3];
        for (axis, sign) in signs.iter_mut().enumerate() {
            let (mut all, mut any) = (L::ALL, 0);
            for lanes in &self.lanes {
                let negative = lanes.near_reciprocal[axis].lt_mask(L::splat(0.0));
                all &= negative;
                any |= negative;
            }
            if any != 0 && all != L::ALL {
                return None;
            }
            *sign = any != 0;
        }
        Some(signs)
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

impl<'a, L: Lanes> PacketVector<'a, L> {
    /// The ray in `lane` on its own, `None` if there is none that can hit anything.
    #[inline]
    pub fn ray(&self, lane: usize) -> Option<&'a PreparedRay> {
        self.rays.get(lane)?.prepared()
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
