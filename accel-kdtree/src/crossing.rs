//! Where rays cross planes, widened so that no hit is lost: [`crate::part`] tells
//! why that suffices.

use accel_core::PreparedRay;
use accel_core::Primitive;
use accel_core::geometry::{Axis, rounding};
use accel_core::ray::packet::RayLanes;
use accel_core::simd::Lanes;

use crate::KdTree;
use crate::part::Slack;

/// How far intervals are widened. Both parts are needed: tests show that hits are
/// lost without either.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    pub slack: Slack,
    /// What reciprocals to compute entries with are multiplied by, besides the
    /// factor that [`PreparedRay::near_reciprocal`] holds.
    pub entry_factor: f32,
    /// Likewise for exits.
    pub exit_factor: f32,
}

impl<P: Primitive> KdTree<P> {
    /// About 18 units of rounding of the distance, and the slack.
    pub(crate) fn tolerance(&self) -> Tolerance {
        const MORE: f32 = rounding::gamma(12);
        Tolerance {
            slack: self.slack,
            entry_factor: 1.0 - MORE,
            exit_factor: 1.0 + MORE,
        }
    }
}

/// Where a ray crosses planes, by axis. A fourth entry, never read, spares the
/// check of two bits against three.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossings {
    pub axes: [Crossing<f32>; 4],
    pub near_children: NearChildren,
}

/// Where the rays of a vector cross planes, if all their directions have the same
/// signs.
#[derive(Clone, Copy, Debug)]
pub struct CrossingLanes<L> {
    pub(crate) axes: [Crossing<L>; 4],
    pub(crate) near_children: NearChildren,
}

/// Which children rays are in first: a bit by axis, set for those above the planes. The
/// next node waits for it, and a register is nearer than a table: single rays were 1.02
/// to 1.10 times as fast.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearChildren(u32);

impl NearChildren {
    #[inline(always)]
    fn new([x, y, z]: [bool; 3]) -> Self {
        Self(u32::from(x) | u32::from(y) << 1 | u32::from(z) << 2)
    }

    /// The child of a node that rays are in first, and the other one, of the two from
    /// `first` on.
    #[inline(always)]
    pub(crate) fn of(self, axis: usize, first: u32) -> [u32; 2] {
        let near = self.0 >> axis & 1;
        [first + near, first + (1 - near)]
    }
}

/// What tells where rays cross planes orthogonal to one axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing<T> {
    /// The origin, moved so that the far side begins a slack earlier.
    entry_origin: T,
    /// The origin, moved so that the near side ends a slack later.
    exit_origin: T,
    entry_reciprocal: T,
    exit_reciprocal: T,
}

impl Crossings {
    #[inline]
    pub(crate) fn new(ray: &PreparedRay, tolerance: &Tolerance) -> Self {
        let along = |axis: Axis| {
            let origin = axis.of(ray.origin());
            let reach = tolerance.slack.reach() + origin.abs() * ORIGIN_STEP;
            Crossing::new(
                ray.is_negative(axis),
                [origin - reach, origin + reach],
                axis.of(ray.near_reciprocal()) * tolerance.entry_factor,
                axis.of(ray.far_reciprocal()) * tolerance.exit_factor,
            )
        };
        let [x, y, z] = Axis::ALL.map(along);
        Self {
            axes: [x, y, z, z],
            near_children: NearChildren::new(Axis::ALL.map(|axis| ray.is_negative(axis))),
        }
    }
}

impl<L: Lanes> CrossingLanes<L> {
    /// For rays whose directions all have these signs.
    #[inline(always)]
    pub(crate) fn new(rays: &RayLanes<L>, signs: &[bool; 3], tolerance: &Tolerance) -> Self {
        let [x, y, z] = [
            Crossing::of_lanes(rays, 0, signs[0], tolerance),
            Crossing::of_lanes(rays, 1, signs[1], tolerance),
            Crossing::of_lanes(rays, 2, signs[2], tolerance),
        ];
        Self {
            axes: [x, y, z, z],
            near_children: NearChildren::new(*signs),
        }
    }
}

/// Rounding must not take the slack away again: the origin moves by at least one
/// unit in its last place.
const ORIGIN_STEP: f32 = 2.0 * rounding::UNIT_ROUNDOFF;

impl Slack {
    /// The slack and a little more, for sums in single precision.
    #[inline(always)]
    fn reach(&self) -> f32 {
        self.0 as f32 * (1.0 + rounding::gamma(4))
    }
}

impl<T: Copy> Crossing<T> {
    #[inline(always)]
    fn new(is_negative: bool, [low, high]: [T; 2], entry: T, exit: T) -> Self {
        let (entry_origin, exit_origin) = if is_negative {
            (low, high)
        } else {
            (high, low)
        };
        Self {
            entry_origin,
            exit_origin,
            entry_reciprocal: entry,
            exit_reciprocal: exit,
        }
    }
}

impl Crossing<f32> {
    /// Where the far side begins and where the near side ends.
    #[inline(always)]
    pub(crate) fn at(&self, position: f32) -> [f32; 2] {
        [
            (position - self.entry_origin) * self.entry_reciprocal,
            (position - self.exit_origin) * self.exit_reciprocal,
        ]
    }
}

impl<L: Lanes> Crossing<L> {
    // As a closure it was not inlined, and so compiled without the vectors of the
    // machine: more than a quarter of the time of packets.
    #[inline(always)]
    fn of_lanes(rays: &RayLanes<L>, axis: usize, is_negative: bool, tolerance: &Tolerance) -> Self {
        let origin = rays.origin[axis];
        let magnitude = origin.max_or_keep(L::splat(0.0) - origin);
        let slack = L::splat(tolerance.slack.reach());
        let reach = slack + magnitude * L::splat(ORIGIN_STEP);
        Self::new(
            is_negative,
            [origin - reach, origin + reach],
            rays.near_reciprocal[axis] * L::splat(tolerance.entry_factor),
            rays.far_reciprocal[axis] * L::splat(tolerance.exit_factor),
        )
    }

    /// Where the far side begins and where the near side ends, ray by ray.
    #[inline(always)]
    pub(crate) fn lanes_at(&self, position: f32) -> [L; 2] {
        let position = L::splat(position);
        [
            (position - self.entry_origin) * self.entry_reciprocal,
            (position - self.exit_origin) * self.exit_reciprocal,
        ]
    }
}
