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

use accel_core::layout::LeafStorage;
use accel_core::query::{Hit, Query};
use accel_core::ray::max_or_keep;
use accel_core::statistics::{NodeKind as StatisticsKind, TraversalStatistics};
use accel_core::structure::{RayPart, TraversalStack};
use accel_core::{PreparedRay, Primitive};

use crate::BspTree;
use crate::crossing::{DoubleRay, Segment, Tolerance};
use crate::node::{NODE_BYTES, NodeKind};
use crate::plane_tracking::{LeafAnswer, PlaneTracking};

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
    let part = RayPart {
        node: 0,
        near,
        far: whole.far,
    };
    let ray_in_double = DoubleRay::new(ray, tolerance);
    let _ = traverse_below::<P, T, Q, S>(tree, part, &ray_in_double, query, statistics);
}

/// Traverses the part of the tree below a node; breaks when the query does.
#[inline]
pub(crate) fn traverse_below<P: Primitive, T: PlaneTracking, Q: Query, S: TraversalStatistics>(
    tree: &BspTree<P>,
    part: RayPart,
    ray_in_double: &DoubleRay<'_>,
    query: &mut Q,
    statistics: &mut S,
) -> ControlFlow<()> {
    let (near, far) = (f64::from(part.near), f64::from(part.far.min(f32::MAX)));
    let mut stack = TraversalStack::new();
    let mut segment = Segment {
        node: part.node,
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
                test_leaf(tree, leaf, &segment, ray_in_double, query, statistics)?;
                match stack.pop_within(query.t_max()) {
                    Some(next) => segment = next,
                    None => return ControlFlow::Continue(()),
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

/// Offers the hits in a leaf, without asking the kernel where the traversal knows
/// better.
#[inline]
fn test_leaf<P: Primitive, T: PlaneTracking, Q: Query, S: TraversalStatistics>(
    tree: &BspTree<P>,
    leaf: NodeKind,
    segment: &Segment<T>,
    ray_in_double: &DoubleRay<'_>,
    query: &mut Q,
    statistics: &mut S,
) -> ControlFlow<()> {
    let ray = ray_in_double.ray;
    let leaf = match leaf {
        NodeKind::Leaf(leaf) => leaf,
        NodeKind::PlanarLeaf {
            normal,
            offset,
            leaf,
        } => {
            statistics.test_planes(1);
            let crossing = ray_in_double.general(normal, offset, segment.far);
            if !crossing.meets(segment) {
                return ControlFlow::Continue(());
            }
            leaf
        }
        NodeKind::BoundedLeaf { depth, leaf } => match segment.planes.leaf_answer(depth) {
            LeafAnswer::AskKernel => leaf,
            LeafAnswer::Hit(t) => {
                statistics.test_planes(1);
                return offer_unconfirmed(tree, leaf, t, ray, query);
            }
            LeafAnswer::Miss => {
                statistics.test_planes(1);
                return ControlFlow::Continue(());
            }
        },
        _ => return ControlFlow::Continue(()),
    };
    let leaves = tree.stored.leaves();
    leaves.intersect_leaf(leaf, ray, query, statistics)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane_tracking::Untracked;
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
