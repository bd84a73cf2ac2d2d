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

use accel_core::geometry::{Axis, rounding::UNIT_ROUNDOFF};
use accel_core::layout::LeafStorage;
use accel_core::query::Query;
use accel_core::ray::{max_or_keep, min_or_keep};
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::TraversalStack;
use accel_core::{PreparedRay, Primitive};

use crate::KdTree;
use crate::node::{Leaf, NODE_BYTES};
use crate::part::{Slack, slack_around};

/// How far intervals are widened. Both parts are needed: tests show that hits are
/// lost without either.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tolerance {
    pub slack: Slack,
    /// Relative to how far the ray has come.
    pub relative: f32,
}

impl<P: Primitive> KdTree<P> {
    pub(crate) fn tolerance(&self) -> Tolerance {
        Tolerance {
            slack: self.slack,
            relative: 16.0 * UNIT_ROUNDOFF,
        }
    }
}

/// A node put off, and where the ray leaves it.
#[derive(Clone, Copy, Debug)]
struct Cell {
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
    let mut near = max_or_keep(ray.t_min(), whole.near);
    let mut far = min_or_keep(query.t_max(), whole.far);
    if near.is_nan() || far.is_nan() || near > far {
        return;
    }
    let crossings = Crossings::new(ray, tolerance);
    let mut stack: TraversalStack<Cell> = TraversalStack::new();
    let mut index = 0;
    loop {
        let node = tree.nodes[index as usize];
        let Some(leaf) = node.as_leaf() else {
            statistics.visit_node(NodeKind::Inner, NODE_BYTES as u32);
            statistics.test_planes(1);
            let crossing = &crossings.axes[node.axis_index()];
            let [entry, exit] = crossing.at(node.position());
            let near_child = node.index() + crossing.near_child;
            let far_child = node.index() + 1 - crossing.near_child;
            if exit < near {
                index = far_child;
            } else {
                index = near_child;
                // False for NaN, too.
                let misses_far_side = entry > far;
                if !misses_far_side {
                    let cell = Cell {
                        node: far_child,
                        far,
                    };
                    stack.push(cell, max_or_keep(near, entry));
                    far = min_or_keep(far, exit);
                }
            }
            continue;
        };
        statistics.visit_node(NodeKind::Leaf, NODE_BYTES as u32);
        if let Leaf::Of(leaf) = leaf {
            let leaves = tree.stored.leaves();
            if leaves
                .intersect_leaf(leaf, ray, query, statistics)
                .is_break()
            {
                return;
            }
        }
        let Some(next) = stack.pop_entry_within(query.t_max()) else {
            return;
        };
        index = next.node.node;
        near = next.near;
        far = min_or_keep(next.node.far, query.t_max());
    }
}

/// Where a ray crosses planes, by axis. A fourth entry, never read, spares the
/// check of two bits against three.
struct Crossings {
    axes: [Crossing; 4],
}

/// What is needed to tell where a ray crosses planes orthogonal to one axis.
#[derive(Clone, Copy)]
struct Crossing {
    /// The origin, moved so that the far side begins a slack earlier.
    entry_origin: f32,
    /// The origin, moved so that the near side ends a slack later.
    exit_origin: f32,
    entry_reciprocal: f32,
    exit_reciprocal: f32,
    /// 0 if the ray is below planes first, 1 if above.
    near_child: u32,
}

impl Crossings {
    fn new(ray: &PreparedRay, tolerance: &Tolerance) -> Self {
        let along = |axis: Axis| {
            let [low, high] = slack_around(axis.of(ray.origin()), tolerance.slack);
            let reciprocal = axis.of(ray.reciprocal());
            let is_negative = ray.is_negative(axis);
            let (entry_origin, exit_origin) = if is_negative {
                (low, high)
            } else {
                (high, low)
            };
            Crossing {
                entry_origin,
                exit_origin,
                entry_reciprocal: reciprocal * (1.0 - tolerance.relative),
                exit_reciprocal: reciprocal * (1.0 + tolerance.relative),
                near_child: u32::from(is_negative),
            }
        };
        let [x, y, z] = Axis::ALL.map(along);
        Self { axes: [x, y, z, z] }
    }
}

impl Crossing {
    /// Where the far side begins and where the near side ends.
    #[inline]
    fn at(&self, position: f32) -> [f32; 2] {
        [
            (position - self.entry_origin) * self.entry_reciprocal,
            (position - self.exit_origin) * self.exit_reciprocal,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{InvalidPrimitives, KdTreeBuilder};
    use accel_core::testing::agreement::oracle;
    use accel_core::testing::{families, rays};
    use accel_core::{AccelerationStructure, ClosestHit, Ray, RaySegment, Triangle};

    /// How many closest hits are answered differently from brute force, with
    /// this much of the tolerance.
    fn disagreements(scene: &[Triangle], rays: &[RaySegment], slack: f64, relative: f32) -> usize {
        let builder = KdTreeBuilder {
            invalid_primitives: InvalidPrimitives::Skip,
            ..KdTreeBuilder::default()
        };
        let tree = builder.build(scene).unwrap();
        let oracle = oracle(scene).unwrap();
        let whole = tree.tolerance();
        let tolerance = Tolerance {
            slack: Slack(whole.slack.0 * slack),
            relative: whole.relative * relative,
        };
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
    fn all_disagreements(slack: f64, relative: f32) -> usize {
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
            let near = rays::mixed(&scene, 5, 4000);
            let away = |ray: &RaySegment, distance: f32| {
                let (origin, direction) = (ray.origin(), ray.direction());
                RaySegment::new(origin - direction * distance, direction)
            };
            let far = near.iter().map(|ray| away(ray, 1e3));
            let very_far = near.iter().map(|ray| away(ray, 1e5));
            let rays: Vec<RaySegment> = near.iter().copied().chain(far).chain(very_far).collect();
            disagreements(&scene, &rays, slack, relative)
        };
        names.into_iter().map(count).sum()
    }

    #[test]
    fn no_hit_is_lost_with_the_whole_tolerance() {
        assert_eq!(all_disagreements(1.0, 1.0), 0);
    }

    #[test]
    fn hits_are_lost_without_the_slack() {
        assert!(all_disagreements(0.0, 1.0) > 0);
    }

    #[test]
    fn hits_are_lost_without_the_relative_part() {
        assert!(all_disagreements(1.0, 0.0) > 0);
    }
}
