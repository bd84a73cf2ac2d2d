//! Where a ray crosses a plane, and how far from it both sides must be visited (Ize
//! 2008, section 4.1), in single precision.
//!
//! A hit at `t` that belongs to a side lies at most tau over the plane, as computed
//! here. tau is the sum of
//!
//! ```text
//! slack of the plane                what the build let reach over it
//! rounding * (|d| t, by axis)       what the kernel rounds along far rays
//! rounding of this very evaluation: of the start, a share of |n| |o| + |offset|;
//!                                   of the slope and of `t`, in `rounding`
//! ```
//!
//! where `t` is the end of the ray's part in the scene's box, for all nodes.
//!
//! Where a distance could overflow, tau is NaN, which constrains nothing: both sides
//! are visited.

use accel_core::PreparedRay;
use accel_core::geometry::rounding::UNIT_ROUNDOFF;
use accel_core::glam::{DVec4, Vec3, Vec4};
use accel_core::ray::{max_or_keep, min_or_keep};
use accel_core::structure::predicted_bit;

use crate::node::{AXES_AND_CLASSES, Node};
use crate::shared_slacks::SharedSlacks;

/// What tau is made of. Both parts are needed: tests show that hits are lost
/// without either.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    /// How much of the slack that the build used.
    pub slack: f32,
    /// How much of what is rounded, by the kernel and here.
    pub rounding: f32,
}

impl Tolerance {
    pub(crate) const SAFE: Self = Self {
        slack: 1.0,
        rounding: 1.0,
    };
}

/// How far a hit may be off, relative to how far the ray has come: what the kernel
/// rounds of vertices and of `t`, and the gate's clamp.
pub(crate) const HIT_ROUNDING: f32 = 16.0 * UNIT_ROUNDOFF;

/// The same with the rounding of slopes and crossings computed here.
const ALONG_THE_RAY: f32 = HIT_ROUNDING + 12.0 * UNIT_ROUNDOFF;

/// How far the signed distance of the origin may be off, relative to its terms.
const AT_THE_ORIGIN: f32 = 8.0 * UNIT_ROUNDOFF;

/// How far the origin may be off when the slack has moved it, relative to itself.
const MOVED_ORIGIN: f32 = 2.0 * UNIT_ROUNDOFF;

/// What a ray must know of all planes of a tree before it meets one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlaneLimits {
    /// Of general planes, the largest magnitudes of normals and offsets.
    pub general: Vec4,
    /// Of axis-aligned ones.
    pub slacks: SharedSlacks,
}

impl PlaneLimits {
    /// Whether a distance from a general plane may overflow, or the speed at which it
    /// changes, for such an origin and direction; both may be magnitudes, axis by axis.
    #[inline]
    pub(crate) fn may_overflow(&self, origin: Vec4, direction: Vec4) -> bool {
        let magnitudes = origin.abs() + direction.abs();
        !(2.0 * self.general.dot(magnitudes)).is_finite()
    }
}

/// What tells where a ray crosses planes.
pub(crate) struct Crossings<'a> {
    pub ray: &'a PreparedRay,
    axes: AxisCrossings,
    /// With the plane's normal and offset, the signed distance of the origin.
    origin: Vec4,
    /// Likewise the slope.
    direction: Vec4,
    /// With magnitudes of normal and offset, how far the distance of a hit may be off
    /// anywhere on the ray's part in the scene.
    rounding: Vec4,
    /// Of general planes; NaN where distances from them could overflow.
    slack: f32,
}

/// What tells where the ray crosses axis-aligned planes, by axis and class of slack
/// ([`Node::axis_and_class`]). Entries 3 and 7 are never read, and spare checks.
struct AxisCrossings {
    /// The origin, moved forwards along the ray by the slack of planes: so are both
    /// ends of the slack met without a sum for each plane.
    entry_origins: [f32; AXES_AND_CLASSES],
    /// Moved backwards.
    exit_origins: [f32; AXES_AND_CLASSES],
    entry_reciprocals: [f32; AXES_AND_CLASSES],
    exit_reciprocals: [f32; AXES_AND_CLASSES],
    /// A bit for each, set where the ray is in front of planes first. Which child to go
    /// to next waits for it, and a register is nearer than a table.
    is_in_front_first: u32,
}

impl AxisCrossings {
    #[inline]
    fn new(ray: &PreparedRay, slacks: SharedSlacks, tolerance: Tolerance) -> Self {
        let along_the_ray = ALONG_THE_RAY * tolerance.rounding;
        let origin = Vec4::from(ray.origin_in_lanes());
        let reciprocal = Vec4::from(ray.reciprocal_in_lanes());
        // With what moving the origin rounds.
        let rounding = origin.abs() * (MOVED_ORIGIN * tolerance.rounding);
        let distance = |slack: f32| Vec4::splat(slack * tolerance.slack) + rounding;
        let distances = [slacks.small, slacks.large].map(distance);
        let farthest = distances[1];
        let negative = reciprocal.is_negative_bitmask();
        // Beyond all numbers nothing can be told of a side, and NaN visits both.
        let reciprocal = reciprocal + (origin.abs() + farthest) * 0.0;
        let forwards = distances.map(|distance| distance.copysign(reciprocal));
        let scaled = |share| in_both_classes([reciprocal * share; 2]);
        Self {
            entry_origins: in_both_classes(forwards.map(|forwards| origin + forwards)),
            exit_origins: in_both_classes(forwards.map(|forwards| origin - forwards)),
            entry_reciprocals: scaled(1.0 - along_the_ray),
            exit_reciprocals: scaled(1.0 + along_the_ray),
            is_in_front_first: negative | negative << 4,
        }
    }
}

/// What is looked up for planes of small slack, and of large.
#[inline]
fn in_both_classes([small, large]: [Vec4; 2]) -> [f32; AXES_AND_CLASSES] {
    let mut both = [0.0; AXES_AND_CLASSES];
    small.write_to_slice(&mut both[..4]);
    large.write_to_slice(&mut both[4..]);
    both
}

/// What a hit may be off per unit of `t` on an axis, however small the direction's
/// component there: below the normal numbers it is no share of the component that is
/// rounded, neither here nor in the kernel's shear, the ratio to the largest one.
#[inline]
pub(crate) fn least_rounding(largest_component: f32) -> f32 {
    f32::MIN_POSITIVE * (4.0 * UNIT_ROUNDOFF * largest_component).max(1.0)
}

/// The part of the ray inside a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval {
    pub near: f32,
    pub far: f32,
}

/// Which children of a node to visit, 0 behind the plane and 1 in front of it.
pub(crate) enum Sides {
    One(u32),
    /// With the nearer one, and where each is left and entered.
    Both {
        nearer: u32,
        exit: f32,
        entry: f32,
    },
}

/// Signed distances along the ray: `start + t * slope`.
pub(crate) struct GeneralCrossing {
    start: f32,
    slope: f32,
    tau: f32,
}

impl<'a> Crossings<'a> {
    /// For a tree whose planes have these limits, and hits up to `far`.
    #[inline]
    pub(crate) fn new(
        ray: &'a PreparedRay,
        far: f32,
        limits: PlaneLimits,
        tolerance: Tolerance,
    ) -> Self {
        let origin = Vec4::from(ray.origin_in_lanes());
        let direction = Vec4::from(ray.direction_in_lanes());
        let least = least_rounding(ray.largest_component()) * tolerance.rounding;
        let at_origin = origin.abs() * (AT_THE_ORIGIN * tolerance.rounding);
        let along = direction.abs() * (ALONG_THE_RAY * tolerance.rounding);
        let along = along.max(Vec3::splat(least).extend(0.0));
        Self {
            ray,
            axes: AxisCrossings::new(ray, limits.slacks, tolerance),
            origin,
            direction,
            rounding: at_origin + along * far.min(f32::MAX),
            slack: if limits.may_overflow(origin, direction) {
                f32::NAN
            } else {
                tolerance.slack
            },
        }
    }

    /// The fast path of a kd-tree. The slack is a little more than the build used,
    /// for the rounding of the difference.
    #[inline]
    pub(crate) fn axis_aligned(&self, node: &Node, interval: Interval) -> Sides {
        let (axes, index) = (&self.axes, node.axis_and_class());
        let position = node.position();
        let nearer = axes.is_in_front_first >> index & 1;
        let exit = (position - axes.exit_origins[index]) * axes.exit_reciprocals[index];
        if exit < interval.near {
            return Sides::One(1 - nearer);
        }
        let entry = (position - axes.entry_origins[index]) * axes.entry_reciprocals[index];
        if entry > interval.far {
            return Sides::One(nearer);
        }
        Sides::Both {
            nearer,
            exit,
            entry,
        }
    }

    /// Of a general plane, its offset behind its normal.
    #[inline]
    pub(crate) fn general(&self, plane: Vec4) -> GeneralCrossing {
        GeneralCrossing {
            start: plane.dot(self.origin),
            slope: plane.dot(self.direction),
            tau: self.slack + plane.abs().dot(self.rounding),
        }
    }

    /// Where the ray crosses a general plane, exactly.
    pub(crate) fn general_at(&self, plane: Vec4) -> f64 {
        let along = |ray: Vec4| plane.as_dvec4().dot(ray.as_dvec4());
        -along(self.origin) / along(self.direction)
    }

    /// Where the ray crosses an axis-aligned plane, exactly.
    pub(crate) fn axis_aligned_at(&self, node: &Node) -> f64 {
        let (axis, position) = (node.axis_and_class() % 4, node.position());
        let [origin, direction]: [DVec4; 2] = [self.origin, self.direction].map(Vec4::as_dvec4);
        (f64::from(position) - origin[axis]) / direction[axis]
    }
}

impl GeneralCrossing {
    /// Whether the ray comes within tau of the plane.
    #[inline]
    pub(crate) fn meets(&self, interval: Interval) -> bool {
        let (lowest, highest) = self.distances(interval);
        !(lowest > self.tau || highest < -self.tau)
    }

    #[inline]
    pub(crate) fn sides(&self, interval: Interval) -> Sides {
        let (lowest, highest) = self.distances(interval);
        if lowest > self.tau {
            return Sides::One(1);
        }
        if highest < -self.tau {
            return Sides::One(0);
        }
        let start = self.start * 1.0_f32.copysign(self.slope);
        let reciprocal = 1.0 / self.slope.abs();
        Sides::Both {
            nearer: predicted_bit(self.slope < 0.0),
            exit: (self.tau - start) * reciprocal,
            // Infinite where the slope is too small, at which the entry may yet be finite.
            entry: (-self.tau - start) * min_or_keep(reciprocal, f32::MAX),
        }
    }

    /// The least signed distance in the interval and the greatest. Whether they rise
    /// or fall is not asked: all nodes would wait for the answer.
    #[inline]
    fn distances(&self, interval: Interval) -> (f32, f32) {
        let at = |t| self.start + t * self.slope;
        let (near, far) = (at(interval.near), at(interval.far));
        (min_or_keep(near, far), max_or_keep(near, far))
    }
}

impl Interval {
    /// Up to where a node is left.
    #[inline]
    pub(crate) fn until(self, exit: f32) -> Self {
        Self {
            far: min_or_keep(self.far, exit),
            ..self
        }
    }

    /// From where a node is entered.
    #[inline]
    pub(crate) fn after(self, entry: f32) -> Self {
        Self {
            near: max_or_keep(self.near, entry),
            ..self
        }
    }
}
