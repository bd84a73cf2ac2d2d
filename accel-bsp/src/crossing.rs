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
//! Where a distance could overflow, tau is NaN, which constrains nothing: both sides
//! are visited.

use accel_core::PreparedRay;
use accel_core::geometry::{Axis, rounding::UNIT_ROUNDOFF};
use accel_core::glam::{DVec4, Vec3, Vec4};
use accel_core::ray::{max_or_keep, min_or_keep};

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

/// What tells where a ray crosses planes.
pub(crate) struct Crossings<'a> {
    pub ray: &'a PreparedRay,
    axes: AxisCrossings,
    /// With the plane's normal and offset, the signed distance of the origin.
    origin: Vec4,
    /// Likewise the slope.
    direction: Vec4,
    /// With magnitudes of normal and offset, how far the origin's distance may be
    /// off, and per unit of `t`, a hit's.
    rounding_at_origin: Vec4,
    rounding_along: Vec4,
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
    /// 0 if the ray is behind planes first, 1 if in front of them.
    near_children: [u32; AXES_AND_CLASSES],
}

impl AxisCrossings {
    #[inline]
    fn new(ray: &PreparedRay, slacks: SharedSlacks, tolerance: Tolerance) -> Self {
        let along_the_ray = ALONG_THE_RAY * tolerance.rounding;
        let (origin, reciprocal) = (ray.origin().extend(0.0), ray.reciprocal().extend(1.0));
        let moved_by = |slack: f32, sign: f32| {
            // With what moving the origin rounds.
            let slack = Vec4::splat(slack * tolerance.slack)
                + origin.abs() * (MOVED_ORIGIN * tolerance.rounding);
            let moved = origin + sign * slack.copysign(reciprocal);
            // Beyond all numbers nothing can be told of a side, and NaN visits both.
            moved + moved * 0.0
        };
        let both = |sign| twice(moved_by(slacks.small, sign), moved_by(slacks.large, sign));
        let scaled = |share| twice(reciprocal * share, reciprocal * share);
        let [x, y, z] = Axis::ALL.map(|axis| u32::from(ray.is_negative(axis)));
        Self {
            entry_origins: both(1.0),
            exit_origins: both(-1.0),
            entry_reciprocals: scaled(1.0 - along_the_ray),
            exit_reciprocals: scaled(1.0 + along_the_ray),
            near_children: [x, y, z, 0, x, y, z, 0],
        }
    }
}

/// What is looked up for planes of small slack, and of large.
#[inline]
fn twice(small: Vec4, large: Vec4) -> [f32; AXES_AND_CLASSES] {
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
    /// For a tree whose planes have these limits.
    #[inline]
    pub(crate) fn new(ray: &'a PreparedRay, limits: PlaneLimits, tolerance: Tolerance) -> Self {
        let (origin, direction) = (ray.origin(), ray.direction());
        let along_the_ray = ALONG_THE_RAY * tolerance.rounding;
        let at_the_origin = AT_THE_ORIGIN * tolerance.rounding;
        let magnitudes = (origin.abs() + direction.abs()).extend(1.0);
        let may_overflow = !(2.0 * limits.general.dot(magnitudes)).is_finite();
        Self {
            ray,
            axes: AxisCrossings::new(ray, limits.slacks, tolerance),
            origin: origin.extend(-1.0),
            direction: direction.extend(0.0),
            rounding_at_origin: origin.abs().extend(1.0) * at_the_origin,
            rounding_along: (direction.abs() * along_the_ray)
                .max(Vec3::splat(
                    least_rounding(direction.abs().max_element()) * tolerance.rounding,
                ))
                .extend(0.0),
            slack: if may_overflow {
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
        let nearer = axes.near_children[index];
        let position = node.position();
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
    pub(crate) fn general(&self, plane: Vec4, far: f32) -> GeneralCrossing {
        let rounding = self.rounding_at_origin + self.rounding_along * far;
        GeneralCrossing {
            start: plane.dot(self.origin),
            slope: plane.dot(self.direction),
            tau: self.slack + plane.abs().dot(rounding),
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
            nearer: u32::from(self.slope.is_sign_negative()),
            exit: (self.tau - start) * reciprocal,
            entry: (-self.tau - start) * reciprocal,
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
