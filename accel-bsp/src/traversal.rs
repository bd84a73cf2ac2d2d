//! The one traversal, for every query and with or without statistics (Ize 2008,
//! section 4.1).
//!
//! ```text
//! s0, s1 := signed distances of the interval's ends from the plane
//! tau    := slack of the plane + rounding of a hit at the far end
//! s0, s1 both above tau: front only; both below -tau: back only
//! otherwise both, the nearer first, each as far as tau over the crossing
//! ```
//!
//! Evaluated in double precision: tau then covers what the kernel rounds, and
//! the traversal's own rounding vanishes beside it.

use std::ops::ControlFlow;

use accel_core::geometry::{Axis, rounding::UNIT_ROUNDOFF};
use accel_core::glam::{DVec3, Vec3};
use accel_core::layout::LeafStorage;
use accel_core::query::{Hit, Query};
use accel_core::ray::max_or_keep;
use accel_core::statistics::{NodeKind as StatisticsKind, TraversalStatistics};
use accel_core::structure::TraversalStack;
use accel_core::{PreparedRay, Primitive};

use crate::BspTree;
use crate::node::{NODE_BYTES, NodeKind};

/// What tau is made of. Both parts are needed: tests show that hits are lost
/// without either.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    /// How much of the slack that the build used.
    pub slack: f64,
    /// How far a hit may be off, relative to how far the ray has come: the
    /// kernel's rounding of vertices, of `t`, and the gate's clamp.
    pub rounding: f64,
}

impl Tolerance {
    pub(crate) const SAFE: Self = Self {
        slack: 1.0,
        rounding: 16.0 * UNIT_ROUNDOFF as f64,
    };
}

/// What a part of the ray knows of the planes that it lies between.
pub(crate) trait PlaneTracking: Copy {
    /// Of the whole ray inside the scene's box.
    fn of_ray(near: f64, far: f64) -> Self;

    /// In a child, if the ray passes the plane on one side.
    fn on_one_side(self) -> Self;

    /// In the nearer child and the farther one, if the plane is at this `t`.
    fn divided(self, at: f64) -> [Self; 2];

    /// What a leaf answers whose primitive covers the face that the node at
    /// `depth` has cut.
    fn leaf_answer(&self, depth: u32) -> LeafAnswer;
}

/// What is known of the primitive of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LeafAnswer {
    /// Nothing: its kernel must decide.
    AskKernel,
    /// It is hit there.
    Hit(f64),
    /// It is missed.
    Miss,
}

/// Knows nothing, for the queries that kernels answer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Untracked;

impl PlaneTracking for Untracked {
    #[inline]
    fn of_ray(_: f64, _: f64) -> Self {
        Self
    }

    #[inline]
    fn on_one_side(self) -> Self {
        self
    }

    #[inline]
    fn divided(self, _: f64) -> [Self; 2] {
        [self; 2]
    }

    #[inline]
    fn leaf_answer(&self, _: u32) -> LeafAnswer {
        LeafAnswer::AskKernel
    }
}

/// A node put off, with the part of the ray inside.
#[derive(Clone, Copy, Debug)]
struct Segment<T> {
    node: u32,
    near: f64,
    far: f64,
    planes: T,
}

pub(crate) fn traverse<P: Primitive, T: PlaneTracking, Q: Query, S: TraversalStatistics>(
    tree: &BspTree<P>,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
    tolerance: Tolerance,
) {
    let Some(bounds) = tree.bounds else { return };
    statistics.test_boxes(1);
    let whole = ray.slab(&bounds);
    let near = max_or_keep(ray.t_min(), whole.near);
    if !(near <= whole.far && near <= query.t_max()) {
        return;
    }
    let (near, far) = (f64::from(near), f64::from(whole.far.min(f32::MAX)));
    let ray_in_double = DoubleRay::new(ray, tolerance);
    let mut stack = TraversalStack::new();
    let mut segment = Segment {
        node: 0,
        near,
        far,
        planes: T::of_ray(near, far),
    };
    loop {
        let (crossing, children, kind) = match tree.nodes[segment.node as usize].kind() {
            NodeKind::AxisAligned {
                axis,
                position,
                slack,
                children,
            } => {
                let crossing = ray_in_double.axis_aligned(axis, position, slack, segment.far);
                (crossing, children, StatisticsKind::Inner)
            }
            NodeKind::General {
                normal,
                offset,
                children,
            } => {
                let crossing = ray_in_double.general(normal, offset, segment.far);
                (crossing, children, StatisticsKind::General)
            }
            leaf => {
                statistics.visit_node(StatisticsKind::Leaf, NODE_BYTES as u32);
                let leaf = match leaf {
                    NodeKind::Leaf(leaf) => Some(leaf),
                    NodeKind::PlanarLeaf {
                        normal,
                        offset,
                        leaf,
                    } => {
                        statistics.test_planes(1);
                        let crossing = ray_in_double.general(normal, offset, segment.far);
                        crossing.meets(&segment).then_some(leaf)
                    }
                    NodeKind::BoundedLeaf { depth, leaf } => {
                        match segment.planes.leaf_answer(depth) {
                            LeafAnswer::AskKernel => Some(leaf),
                            answer => {
                                statistics.test_planes(1);
                                if let LeafAnswer::Hit(t) = answer
                                    && offer_unconfirmed(tree, leaf, t, ray, query).is_break()
                                {
                                    return;
                                }
                                None
                            }
                        }
                    }
                    _ => None,
                };
                let leaves = tree.stored.leaves();
                if let Some(leaf) = leaf
                    && leaves
                        .intersect_leaf(leaf, ray, query, statistics)
                        .is_break()
                {
                    return;
                }
                match stack.pop_within(query.t_max()) {
                    Some(next) => segment = next,
                    None => return,
                }
                continue;
            }
        };
        statistics.visit_node(kind, NODE_BYTES as u32);
        statistics.test_planes(1);
        let (nearer, farther) = crossing.divide(&segment, children);
        if let Some(farther) = farther {
            // Rounding to single precision is monotone, and `t` is single, so the
            // entry rounds to at most the `t` of any hit behind it.
            stack.push(farther, farther.near as f32);
        }
        segment = nearer;
    }
}

/// Offers a hit of a leaf's one primitive that the traversal has found.
fn offer_unconfirmed<P: Primitive, Q: Query>(
    tree: &BspTree<P>,
    leaf: u32,
    t: f64,
    ray: &PreparedRay,
    query: &mut Q,
) -> ControlFlow<()> {
    let t = t as f32;
    let id = tree.stored.leaves().leaf_ids(leaf).next();
    match id {
        Some(id) if (ray.t_min()..=query.t_max()).contains(&t) => query.offer(&Hit {
            t,
            u: 0.0,
            v: 0.0,
            id,
        }),
        _ => ControlFlow::Continue(()),
    }
}

/// The ray, and its tolerance, in double precision.
struct DoubleRay {
    origin: DVec3,
    direction: DVec3,
    reciprocal: DVec3,
    /// The rounding of a hit per unit of `t`.
    rounding: DVec3,
    slack: f64,
}

/// A ray's signed distance from a plane: `start + t * slope`.
struct Crossing {
    start: f64,
    slope: f64,
    /// Where it is zero; of no meaning where the slope is.
    at: f64,
    tau: f64,
    /// How much of `t` tau is worth.
    reach: f64,
}

impl DoubleRay {
    fn new(ray: &PreparedRay, tolerance: Tolerance) -> Self {
        let direction = ray.direction().as_dvec3();
        Self {
            origin: ray.origin().as_dvec3(),
            direction,
            reciprocal: direction.recip(),
            rounding: direction.abs() * tolerance.rounding,
            slack: tolerance.slack,
        }
    }

    /// The fast path of a kd-tree: one subtraction and two multiplications.
    #[inline]
    fn axis_aligned(&self, axis: Axis, position: f32, slack: f32, far: f64) -> Crossing {
        let index = axis.index();
        let start = self.origin[index] - f64::from(position);
        let tau = f64::from(slack) * self.slack + self.rounding[index] * far;
        let reciprocal = self.reciprocal[index];
        Crossing {
            start,
            slope: self.direction[index],
            at: -start * reciprocal,
            tau,
            reach: tau * reciprocal.abs(),
        }
    }

    #[inline]
    fn general(&self, normal: Vec3, offset: f32, far: f64) -> Crossing {
        let normal = normal.as_dvec3();
        let start = normal.dot(self.origin) - f64::from(offset);
        let slope = normal.dot(self.direction);
        let tau = self.slack + normal.abs().dot(self.rounding) * far;
        let reciprocal = 1.0 / slope;
        Crossing {
            start,
            slope,
            at: -start * reciprocal,
            tau,
            reach: tau * reciprocal.abs(),
        }
    }
}

impl Crossing {
    /// Signed distances of both ends.
    #[inline]
    fn ends<T>(&self, segment: &Segment<T>) -> [f64; 2] {
        [segment.near, segment.far].map(|t| self.start + t * self.slope)
    }

    /// Whether the ray comes within tau of the plane.
    #[inline]
    fn meets<T>(&self, segment: &Segment<T>) -> bool {
        let [s0, s1] = self.ends(segment);
        !(s0 > self.tau && s1 > self.tau || s0 < -self.tau && s1 < -self.tau)
    }

    /// The child that the ray enters first, and the other one if it enters both.
    #[inline]
    fn divide<T: PlaneTracking>(
        &self,
        segment: &Segment<T>,
        back: u32,
    ) -> (Segment<T>, Option<Segment<T>>) {
        let [s0, s1] = self.ends(segment);
        let planes = segment.planes.on_one_side();
        let of = |node| Segment {
            node,
            planes,
            ..*segment
        };
        if s0 > self.tau && s1 > self.tau {
            return (of(back + 1), None);
        }
        if s0 < -self.tau && s1 < -self.tau {
            return (of(back), None);
        }
        let [mut nearer, mut farther] = if self.slope < 0.0 {
            [of(back + 1), of(back)]
        } else {
            [of(back), of(back + 1)]
        };
        [nearer.planes, farther.planes] = segment.planes.divided(self.at);
        // Where the whole segment is within tau, no division by a tiny slope.
        if (s1 - s0).abs() > self.tau {
            nearer.far = nearer.far.min(self.at + self.reach);
            farther.near = farther.near.max(self.at - self.reach);
        }
        (nearer, Some(farther))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BspBuilder, InvalidPrimitives};
    use accel_core::testing::agreement::oracle;
    use accel_core::testing::{families, rays};
    use accel_core::{AccelerationStructure, ClosestHit, Ray, RaySegment, Triangle};

    /// How many closest hits are answered differently from brute force, with
    /// this tolerance.
    fn disagreements(scene: &[Triangle], rays: &[RaySegment], tolerance: Tolerance) -> usize {
        let builder = BspBuilder {
            invalid_primitives: InvalidPrimitives::Skip,
            epsilon: 1.0 / (1 << 14) as f64,
            ..BspBuilder::default()
        };
        let tree = builder.build(scene).unwrap();
        let oracle = oracle(scene).unwrap();
        let closest = |ray: &RaySegment| {
            let ray = PreparedRay::new(ray)?;
            let mut query = ClosestHit::new(&ray);
            traverse::<_, Untracked, _, _>(&tree, &ray, &mut query, &mut (), tolerance);
            query.best()
        };
        let differs = |ray: &&RaySegment| closest(ray) != oracle.closest_hit(*ray);
        rays.iter().filter(differs).count()
    }

    /// Scenes with surfaces that are almost flat, seen from near and from far.
    fn all_disagreements(tolerance: Tolerance) -> usize {
        let names = [
            "sheet-rotated",
            "closed-icosphere",
            "layers-one-ulp-apart",
            "closed-room-of-strips",
            "straddling-book",
            "staircase-rotated",
        ];
        let count = |name| {
            let scene = families::find(name).expect(name).scene(3, 400);
            let near = rays::mixed(&scene, 5, 2000);
            let away = |ray: &RaySegment, distance: f32| {
                let (origin, direction) = (ray.origin(), ray.direction());
                RaySegment::new(origin - direction * distance, direction)
            };
            let far = near.iter().map(|ray| away(ray, 1e3));
            let very_far = near.iter().map(|ray| away(ray, 1e5));
            let rays: Vec<RaySegment> = near.iter().copied().chain(far).chain(very_far).collect();
            disagreements(&scene, &rays, tolerance)
        };
        names.into_iter().map(count).sum()
    }

    #[test]
    fn no_hit_is_lost_with_the_whole_tolerance() {
        assert_eq!(all_disagreements(Tolerance::SAFE), 0);
    }

    #[test]
    fn hits_are_lost_without_tolerance() {
        let none = Tolerance {
            slack: 0.0,
            rounding: 0.0,
        };
        assert!(all_disagreements(none) > 0);
    }

    #[test]
    fn hits_are_lost_without_the_slack_of_the_build() {
        let rounding_alone = Tolerance {
            slack: 0.0,
            ..Tolerance::SAFE
        };
        assert!(all_disagreements(rounding_alone) > 0);
    }

    #[test]
    fn hits_are_lost_without_the_rounding_of_the_hit() {
        let slack_alone = Tolerance {
            rounding: 0.0,
            ..Tolerance::SAFE
        };
        assert!(all_disagreements(slack_alone) > 0);
    }
}
