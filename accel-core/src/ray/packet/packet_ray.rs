//! A ray on its way into a packet.

use std::cell::OnceCell;

use glam::Vec3;

use crate::ray::{PreparedRay, Ray, RaySegment};

/// A ray of a packet. It is made ready in lanes, together with the others; on its
/// own, once, only if it comes to be traced on its own.
#[derive(Clone, Debug)]
pub struct PacketRay {
    segment: RaySegment,
    prepared: OnceCell<Option<PreparedRay>>,
}

/// Whether the directions of `rays` agree in sign on every axis: told before they
/// are made ready in lanes, which rays without a common way would pay for in vain.
#[inline(always)]
pub fn go_one_way(rays: &[PacketRay]) -> bool {
    let signs = |ray: &PacketRay| ray.segment.direction.cmplt(Vec3::ZERO).bitmask();
    let mut all = rays.iter().map(signs);
    let first = all.next();
    all.all(|signs| Some(signs) == first)
}

/// Whether `rays` start at one point: see [`go_one_way`].
#[inline(always)]
pub fn start_at_one_point(rays: &[PacketRay]) -> bool {
    let mut all = rays.iter().map(|ray| ray.segment.origin);
    let first = all.next();
    all.all(|origin| Some(origin) == first)
}

impl PacketRay {
    /// `ray`, as its caller describes it.
    #[inline(always)]
    pub fn new(ray: &impl Ray) -> Self {
        Self {
            segment: RaySegment {
                origin: ray.origin(),
                direction: ray.direction(),
                t_min: ray.t_min(),
                t_max: ray.t_max(),
            },
            prepared: OnceCell::new(),
        }
    }

    /// The ray as its caller described it.
    #[inline(always)]
    pub fn segment(&self) -> &RaySegment {
        &self.segment
    }

    /// The ray made ready on its own; `None` if it can hit nothing.
    #[inline]
    pub fn prepared(&self) -> Option<&PreparedRay> {
        let prepared = self
            .prepared
            .get_or_init(|| PreparedRay::new(&self.segment));
        prepared.as_ref()
    }
}
