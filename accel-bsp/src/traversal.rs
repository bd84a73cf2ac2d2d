//! The one traversal, for every query and with or without statistics (Ize 2008,
//! section 4.1).
//!
//! ```text
//! s0, s1 := signed distances of the interval's ends from the plane
//! tau    := slack of the plane + rounding of the farthest hit in the scene's box
//! s0, s1 both above tau: front only; both below -tau: back only
//! otherwise both, the nearer first, each as far as tau over the crossing
//! ```
//!
//! Of an axis-aligned plane, the same in terms of `t`: where the ray leaves the one
//! side and enters the other.

use std::ops::ControlFlow;

use accel_core::layout::LeafStorage;
use accel_core::query::{Hit, Query};
use accel_core::ray::{max_or_keep, min_or_keep};
use accel_core::statistics::{NodeKind as StatisticsKind, TraversalStatistics};
use accel_core::structure::{RayPart, TraversalStack};
use accel_core::{PreparedRay, Primitive};

use crate::BspTree;
use crate::crossing::{Crossings, Interval, Sides, Tolerance};
use crate::node::{Node, NodeKind};
use crate::nodes::{Nodes, bytes_of};
use crate::plane_tracking::{LeafAnswer, PlaneTracking};

/// A node, and the part of the ray inside.
#[derive(Clone, Copy)]
struct Segment<T> {
    node: u32,
    interval: Interval,
    planes: T,
}

/// A node put off, and where the ray leaves it.
#[derive(Clone, Copy)]
struct PutOff<T> {
    node: u32,
    far: f32,
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
    let part = RayPart {
        node: 0,
        near: max_or_keep(ray.t_min(), whole.near),
        far: min_or_keep(query.t_max(), whole.far),
    };
    if part.near <= part.far {
        let crossings = Crossings::new(ray, part.far, tree.plane_limits(), tolerance);
        let _ = traverse_below::<P, T, Q, S>(tree, part, &crossings, query, statistics);
    }
}

/// Traverses the part of the tree below a node; breaks when the query does.
#[inline]
pub(crate) fn traverse_below<P: Primitive, T: PlaneTracking, Q: Query, S: TraversalStatistics>(
    tree: &BspTree<P>,
    part: RayPart,
    crossings: &Crossings<'_>,
    query: &mut Q,
    statistics: &mut S,
) -> ControlFlow<()> {
    let interval = Interval {
        near: part.near,
        far: part.far.min(f32::MAX),
    };
    let mut segment = Segment {
        node: part.node,
        interval,
        planes: T::of_ray(interval.near.into(), interval.far.into()),
    };
    let mut stack: TraversalStack<PutOff<T>> = TraversalStack::new();
    loop {
        let node = tree.nodes.node(segment.node);
        let below = if node.is_leaf() {
            statistics.visit_node(StatisticsKind::Leaf, bytes_of(node));
            test_leaf(tree, node, &segment, crossings, query, statistics)?;
            None
        } else {
            descend(
                &tree.nodes,
                node,
                &segment,
                crossings,
                &mut stack,
                statistics,
            )
        };
        if let Some(below) = below {
            segment = below;
            continue;
        }
        let Some(next) = stack.pop_entry_within(query.t_max()) else {
            return ControlFlow::Continue(());
        };
        segment = Segment {
            node: next.node.node,
            interval: Interval {
                near: next.near,
                far: min_or_keep(next.node.far, query.t_max()),
            },
            planes: next.node.planes,
        };
    }
}

/// The child to go on with, the other one put off; `None` where nothing is left of
/// the ray, or of what the node holds.
#[inline(always)]
fn descend<T: PlaneTracking, S: TraversalStatistics>(
    nodes: &Nodes,
    node: &Node,
    segment: &Segment<T>,
    crossings: &Crossings<'_>,
    stack: &mut TraversalStack<PutOff<T>>,
    statistics: &mut S,
) -> Option<Segment<T>> {
    let interval = segment.interval;
    statistics.test_planes(1);
    let sides = if node.is_general() {
        statistics.visit_node(StatisticsKind::General, bytes_of(node));
        let crossing = crossings.general(nodes.plane(node.plane_number()));
        crossing.sides(interval)
    } else {
        statistics.visit_node(StatisticsKind::Inner, bytes_of(node));
        crossings.axis_aligned(node, interval)
    };
    match sides {
        Sides::One(side) => Some(Segment {
            node: node.child(side)?,
            interval,
            planes: segment.planes.on_one_side(),
        }),
        Sides::Both {
            nearer,
            exit,
            entry,
        } => {
            let [planes, beyond] = segment
                .planes
                .divided(|| exact_crossing(nodes, node, crossings));
            let farther = node.child(1 - nearer).map(|node| Segment {
                node,
                interval: interval.after(entry),
                planes: beyond,
            });
            let Some(nearer) = node.child(nearer) else {
                return farther;
            };
            if let Some(farther) = farther {
                let put_off = PutOff {
                    node: farther.node,
                    far: interval.far,
                    planes: beyond,
                };
                stack.push(put_off, farther.interval.near);
            }
            Some(Segment {
                node: nearer,
                interval: interval.until(exit),
                planes,
            })
        }
    }
}

/// Where the ray crosses the plane of an inner node, for those who remember it.
fn exact_crossing(nodes: &Nodes, node: &Node, crossings: &Crossings<'_>) -> f64 {
    if node.is_general() {
        crossings.general_at(nodes.plane(node.plane_number()))
    } else {
        crossings.axis_aligned_at(node)
    }
}

/// Offers the hits in a leaf, without asking the kernel where the traversal knows
/// better.
#[inline]
fn test_leaf<P: Primitive, T: PlaneTracking, Q: Query, S: TraversalStatistics>(
    tree: &BspTree<P>,
    node: &Node,
    segment: &Segment<T>,
    crossings: &Crossings<'_>,
    query: &mut Q,
    statistics: &mut S,
) -> ControlFlow<()> {
    let leaf = match node.kind() {
        NodeKind::PlanarLeaf { plane, leaf } => {
            statistics.test_planes(1);
            let crossing = crossings.general(tree.nodes.plane(plane));
            if !crossing.meets(segment.interval) {
                return ControlFlow::Continue(());
            }
            leaf
        }
        NodeKind::BoundedLeaf { depth, leaf } => match segment.planes.leaf_answer(depth) {
            LeafAnswer::AskKernel => leaf,
            LeafAnswer::Hit(t) => {
                statistics.test_planes(1);
                return offer_unconfirmed(tree, leaf, t, crossings.ray, query);
            }
            LeafAnswer::Miss => {
                statistics.test_planes(1);
                return ControlFlow::Continue(());
            }
        },
        NodeKind::Leaf(leaf) => leaf,
        NodeKind::AxisAligned { .. } | NodeKind::General { .. } => {
            return ControlFlow::Continue(());
        }
    };
    let leaves = tree.stored.leaves();
    leaves.intersect_leaf(leaf, crossings.ray, query, statistics)
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
    use accel_core::{AccelerationStructure, ClosestHit, RaySegment, Triangle};

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
            let rays = rays::mixed_near_and_far(&scene, 5, 2000);
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
