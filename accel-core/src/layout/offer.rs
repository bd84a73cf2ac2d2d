//! From an intersection to a hit: gate, clamp, interval, offer. This is the only
//! place where hits are made, for brute force as for every tree.

use std::ops::ControlFlow;

use crate::geometry::Aabb;
use crate::primitive::{Intersection, LaneIntersections, Primitive};
use crate::query::{Hit, Query};
use crate::ray::packet::lanes_of;
use crate::ray::{PacketVector, PreparedRay, max_or_keep, min_or_keep};
use crate::simd::{F32x4, Lanes};

/// Intersects `primitive` and offers the hit, if there is one: the body of every
/// leaf's loop.
#[inline]
pub fn offer_primitive<P: Primitive, Q: Query>(
    primitive: &P,
    id: u32,
    ray: &PreparedRay,
    query: &mut Q,
) -> ControlFlow<()> {
    match primitive.intersect(ray) {
        Some(intersection) => offer_intersection(intersection, id, &primitive.bounds(), ray, query),
        None => ControlFlow::Continue(()),
    }
}

/// As [`offer_primitive`], for the rays of a vector that are in `mask`; yields
/// those of them whose queries go on.
#[inline(always)]
pub fn offer_primitive_packet<P: Primitive, L: Lanes, Q: Query>(
    primitive: &P,
    id: u32,
    mask: u32,
    rays: &mut PacketVector<'_, L>,
    queries: &mut [Q],
) -> u32 {
    let found = primitive.intersect_packet(rays, mask);
    if found.mask == 0 {
        return mask;
    }
    let (t, hits) = gated(&found, &primitive.bounds(), rays);
    let mut answered = 0;
    for lane in lanes_of(hits) {
        let hit = Hit {
            t: t.lanes()[lane],
            u: found.u.lanes()[lane],
            v: found.v.lanes()[lane],
            id,
        };
        match queries[lane].offer(&hit) {
            ControlFlow::Continue(()) => rays.shorten(lane, queries[lane].t_max()),
            ControlFlow::Break(()) => {
                rays.retire(lane);
                answered |= 1 << lane;
            }
        }
    }
    mask & !answered
}

/// The steps of [`offer_intersection`], lane by lane: the clamped `t`, and which
/// lanes are hits.
#[inline(always)]
fn gated<L: Lanes>(
    found: &LaneIntersections<L>,
    bounds: &Aabb,
    rays: &PacketVector<'_, L>,
) -> (L, u32) {
    let (near, far) = rays.lanes.whole_slab(rays.shared, &bounds.gate());
    let finite = finite_mask(found.t) & finite_mask(found.u) & finite_mask(found.v);
    let t = found.t.max_or_keep(near).min_or_keep(far) + L::splat(0.0);
    let within = rays.lanes.t_min.le_mask(t) & t.le_mask(*rays.t_max) & finite_mask(t);
    (t, found.mask & finite & near.le_mask(far) & within)
}

#[inline(always)]
fn finite_mask<L: Lanes>(value: L) -> u32 {
    value.lt_mask(L::splat(f32::INFINITY)) & L::splat(f32::NEG_INFINITY).lt_mask(value)
}

/// Offers `intersection` of the primitive `id`, whose box is `bounds`, to
/// `query` if it is a hit.
///
/// The intersection must pass the slab test of the primitive's *gate box*, and
/// its `t` is clamped to that interval. Intervals of nested boxes are nested as
/// computed, so a box around the gate box is visited by every ray with a hit in
/// it: no tree can lose one. The order of the steps matters: clamp, then turn -0
/// into +0, then compare with the closed interval of the ray.
#[inline]
pub fn offer_intersection<Q: Query>(
    intersection: Intersection,
    id: u32,
    bounds: &Aabb,
    ray: &PreparedRay,
    query: &mut Q,
) -> ControlFlow<()> {
    let Intersection { t, u, v } = intersection;
    let gate = ray.slab(&bounds.gate());
    let is_finite = F32x4::new(t, u, v, 0.0).is_finite();
    if !is_finite || gate.is_empty() {
        return ControlFlow::Continue(());
    }
    let t = min_or_keep(max_or_keep(t, gate.near), gate.far) + 0.0;
    if t >= ray.t_min() && t <= query.t_max() && t.is_finite() {
        query.offer(&Hit { t, u, v, id })
    } else {
        ControlFlow::Continue(())
    }
}
