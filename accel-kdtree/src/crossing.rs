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
}

/// Where the rays of a vector cross planes, if all their directions have the same
/// signs.
#[derive(Clone, Copy, Debug)]
pub struct CrossingLanes<L> {
    pub(crate) axes: [Crossing<L>; 4],
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
    /// 0 if the ray is below planes first, 1 if above.
    near_child: u32,
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
        Self { axes: [x, y, z, z] }
    }
}

impl<L: Lanes> CrossingLanes<L> {
    /// For rays whose directions all have these signs.
    #[inline(always)]
    pub(crate) fn new(rays: &RayLanes<L>, signs: &[bool; 3], tolerance: &Tolerance) -> Self {
        let zero = L::splat(0.0);
        let slack = L::splat(tolerance.slack.reach());
        let along = |axis: Axis| {
            let index = axis.index();
            let origin = rays.origin[index];
            let magnitude = origin.max_or_keep(zero - origin);
            let reach = slack + magnitude * L::splat(ORIGIN_STEP);
            Crossing::new(
                signs[index],
                [origin - reach, origin + reach],
                rays.near_reciprocal[index] * L::splat(tolerance.entry_factor),
                rays.far_reciprocal[index] * L::splat(tolerance.exit_factor),
            )
        };
        let [x, y, z] = [along(Axis::X), along(Axis::Y), along(Axis::Z)];
        Self { axes: [x, y, z, z] }
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
            near_child: u32::from(is_negative),
        }
    }

    /// The child that rays are in first, and the other one, of the two from
    /// `first` on.
    #[inline(always)]
    pub(crate) fn children(&self, first: u32) -> [u32; 2] {
        [first + self.near_child, first + 1 - self.near_child]
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
