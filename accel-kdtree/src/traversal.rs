//! The one traversal, for every query and with or without statistics.
//!
//! ```text
//! interval := the ray inside the root's cell
//! loop:
//!     inner:  entry, exit := where the ray may cross the plane, widened
//!             leaves the near side before the interval:  go to the far child
//!             reaches the far side after it:             go to the near child
//!             otherwise: put off the far child from entry on,
//!                        go to the near child up to exit
//!     leaf:   offer its hits
//!             take the child put off last that is not behind the best hit
//! ```
//!
//! Intervals are closed and widened twice: by a share of the distance, for what
//! the kernel rounds along far rays, and by the tree's slack, for what it rounds
//! at the primitives ([`crate::part`] tells why this loses no hit). A hit outside
//! a leaf's interval counts like any other. A ray that runs inside a plane, or
//! whose direction is too small to divide by, gives NaN, which constrains
//! nothing: it visits both sides.

use std::ops::ControlFlow;

use accel_core::layout::LeafStorage;
use accel_core::query::Query;
use accel_core::ray::{max_or_keep, min_or_keep};
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::{RayPart, TraversalStack};
use accel_core::{PreparedRay, Primitive};

use crate::KdTree;
use crate::crossing::{Crossings, Tolerance};
use crate::node::{Leaf, NODE_BYTES};

/// A node put off, and where the ray leaves it.
#[derive(Clone, Copy, Debug)]
struct PutOff {
    node: u32,
    far: f32,
}

pub(crate) fn traverse<P: Primitive, Q: Query, S: TraversalStatistics>(
    tree: &KdTree<P>,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
    tolerance: &Tolerance,
) {
    let Some(bounds) = tree.bounds else { return };
    statistics.test_boxes(1);
    let whole = ray.slab(&bounds);
    let root = RayPart {
        node: 0,
        near: max_or_keep(ray.t_min(), whole.near),
        far: min_or_keep(query.t_max(), whole.far),
    };
    if root.near <= root.far {
        let crossings = Crossings::new(ray, tolerance);
        let _ = traverse_below(tree, root, &crossings, ray, query, statistics);
    }
}

/// Traverses the part of the tree below a node; breaks when the query does.
#[inline]
pub(crate) fn traverse_below<P: Primitive, Q: Query, S: TraversalStatistics>(
    tree: &KdTree<P>,
    mut segment: RayPart,
    crossings: &Crossings,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) -> ControlFlow<()> {
    let mut stack: TraversalStack<PutOff> = TraversalStack::new();
    loop {
        let node = tree.nodes[segment.node as usize];
        let Some(leaf) = node.as_leaf() else {
            statistics.visit_node(NodeKind::Inner, NODE_BYTES as u32);
            statistics.test_planes(1);
            let axis = node.axis_index();
            let [entry, exit] = crossings.axes[axis].at(node.position());
            let [near_child, far_child] = crossings.near_children.of(axis, node.index());
            if exit < segment.near {
                segment.node = far_child;
                continue;
            }
            segment.node = near_child;
            // False for NaN, too.
            let misses_far_side = entry > segment.far;
            if !misses_far_side {
                let put_off = PutOff {
                    node: far_child,
                    far: segment.far,
                };
                stack.push(put_off, max_or_keep(segment.near, entry));
                segment.far = min_or_keep(segment.far, exit);
            }
            continue;
        };
        statistics.visit_node(NodeKind::Leaf, NODE_BYTES as u32);
        if let Leaf::Of(leaf) = leaf {
            let leaves = tree.stored.leaves();
            leaves.intersect_leaf(leaf, ray, query, statistics)?;
        }
        let Some(next) = stack.pop_entry_within(query.t_max()) else {
            return ControlFlow::Continue(());
        };
        segment = RayPart {
            node: next.node.node,
            near: next.near,
            far: min_or_keep(next.node.far, query.t_max()),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::part::Slack;
    use crate::{InvalidPrimitives, KdTreeBuilder};
    use accel_core::geometry::rounding::gamma;
    use accel_core::testing::agreement::oracle;
    use accel_core::testing::{families, rays};
    use accel_core::{AccelerationStructure, ClosestHit, RaySegment, Triangle};

    /// Takes a part of the tolerance away.
    type Without = fn(&mut Tolerance);

    /// How many closest hits are answered differently from brute force.
    fn disagreements(scene: &[Triangle], rays: &[RaySegment], without: Without) -> usize {
        let builder = KdTreeBuilder {
            invalid_primitives: InvalidPrimitives::Skip,
            ..KdTreeBuilder::default()
        };
        let tree = builder.build(scene).unwrap();
        let oracle = oracle(scene).unwrap();
        let mut tolerance = tree.tolerance();
        without(&mut tolerance);
        let closest = |ray: &RaySegment| {
            let ray = PreparedRay::new(ray)?;
            let mut query = ClosestHit::new(&ray);
            traverse(&tree, &ray, &mut query, &mut (), &tolerance);
            query.best()
        };
        let differs = |ray: &&RaySegment| closest(ray) != oracle.closest_hit(*ray);
        rays.iter().filter(differs).count()
    }

    /// Scenes with primitives in planes and at points, seen from near and from far.
    fn all_disagreements(without: Without) -> usize {
        let names = [
            "closed-icosphere",
            "layers-one-ulp-apart",
            "closed-room-of-strips",
            "integer-soup",
            "anisotropic",
            "one-point-neighbours",
        ];
        let count = |name| {
            let scene = families::find(name).expect(name).scene(3, 400);
            let rays = rays::mixed_near_and_far(&scene, 5, 4000);
            disagreements(&scene, &rays, without)
        };
        names.into_iter().map(count).sum()
    }

    #[test]
    fn no_hit_is_lost_with_the_whole_tolerance() {
        assert_eq!(all_disagreements(|_| ()), 0);
    }

    #[test]
    fn hits_are_lost_without_the_slack() {
        assert!(all_disagreements(|tolerance| tolerance.slack = Slack(0.0)) > 0);
    }

    #[test]
    fn hits_are_lost_without_the_relative_part() {
        // Also without that of the ray's own reciprocals.
        let without = |tolerance: &mut Tolerance| {
            tolerance.entry_factor = 1.0 + gamma(6);
            tolerance.exit_factor = 1.0 - gamma(6);
        };
        assert!(all_disagreements(without) > 0);
    }
}
