//! From an intersection to a hit: gate, clamp, interval, offer. This is the only
//! place where hits are made, for brute force as for every tree.

use std::ops::ControlFlow;

use crate::geometry::Aabb;
use crate::primitive::{Intersection, Primitive};
use crate::query::{Hit, Query};
use crate::ray::PreparedRay;

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
    let is_finite = t.is_finite() && u.is_finite() && v.is_finite();
    if !is_finite || gate.is_empty() {
        return ControlFlow::Continue(());
    }
    let t = t.max(gate.near).min(gate.far) + 0.0;
    if t >= ray.t_min() && t <= query.t_max() && t.is_finite() {
        query.offer(&Hit { t, u, v, id })
    } else {
        ControlFlow::Continue(())
    }
}
