//! The one traversal of wide dual-split trees.
//!
//! ```text
//! node := root, [near, far] := the ray's part in its box
//! loop:
//!     inner:  cut [near, far] at the planes of all children at once; go to the child
//!             that is entered first, put the others off, the nearest last
//!     leaf:   offer its hits
//!     otherwise: take the child put off last that is not behind the best hit
//! ```
//!
//! Every plane is met in the reference form of [`PreparedRay::slab`].

use accel_core::geometry::Axis;
use accel_core::layout::LeafStorage;
use accel_core::query::Query;
use accel_core::ray::{max_or_keep, min_or_keep};
use accel_core::simd::{InstructionSet, Lanes, SimdLevel, SimdWork};
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::WideStack;
use accel_core::{PreparedRay, Primitive};

use super::WideDualSplitTree;
use super::node::{LANES, NO_PLANE, ROWS, Target, WideNode, WidePointer};

/// As [`traverse`](accel_core::AccelerationStructure::traverse), with the vectors of
/// `level`.
#[inline]
pub(super) fn traverse_at<P: Primitive, Q: Query, S: TraversalStatistics>(
    level: SimdLevel,
    tree: &WideDualSplitTree<P>,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) {
    level.run(Traversal {
        tree,
        ray,
        query,
        statistics,
    });
}

struct Traversal<'a, P: Primitive, Q, S> {
    tree: &'a WideDualSplitTree<P>,
    ray: &'a PreparedRay,
    query: &'a mut Q,
    statistics: &'a mut S,
}

impl<P: Primitive, Q: Query, S: TraversalStatistics> SimdWork for Traversal<'_, P, Q, S> {
    type Output = ();

    #[inline(always)]
    fn run<I: InstructionSet>(self) {
        self.trace::<I::Eight>();
    }
}

/// A node put off, and where the ray leaves it.
#[derive(Clone, Copy)]
struct PutOff {
    pointer: WidePointer,
    far: f32,
}

impl<P: Primitive, Q: Query, S: TraversalStatistics> Traversal<'_, P, Q, S> {
    #[inline(always)]
    fn trace<L: Lanes>(self) {
        let Self {
            tree,
            ray,
            query,
            statistics,
        } = self;
        let Some((mut pointer, bounds)) = tree.root else {
            return;
        };
        statistics.test_boxes(1);
        let whole = ray.slab(&bounds);
        let mut near = max_or_keep(ray.t_min(), whole.near);
        let mut far = min_or_keep(query.t_max(), whole.far);
        if near > far {
            return;
        }
        let tables = PlaneTables::new(ray);
        let mut stack = WideStack::new();
        loop {
            match pointer.target() {
                Target::Leaf(leaf) => {
                    statistics.visit_node(NodeKind::Leaf, 0);
                    let leaves = tree.stored.leaves();
                    if leaves
                        .intersect_leaf(leaf, ray, query, statistics)
                        .is_break()
                    {
                        return;
                    }
                }
                Target::Inner(position) => {
                    let node = WideNode::at(&tree.words, position);
                    statistics.visit_node(NodeKind::Inner, node.bytes());
                    statistics.test_planes(ROWS as u32 * node.children());
                    let parts = tables.cut::<L>(&node, (near, far));
                    if let Some(next) = parts.in_order(&node, &mut stack) {
                        (pointer, near, far) = next;
                        continue;
                    }
                }
            }
            let Some(entry) = stack.pop_entry_within(query.t_max()) else {
                return;
            };
            pointer = entry.node.pointer;
            near = entry.near;
            far = min_or_keep(query.t_max(), entry.node.far);
        }
    }
}

/// What meeting each of the six planes of a box takes of a ray, by
/// [`BoxPlane::index`](crate::codec::BoxPlane::index); from [`NO_PLANE`] on for no
/// plane. The reciprocal for what the ray does not do there, enter or leave, is NaN,
/// which constrains nothing.
struct PlaneTables {
    origins: [f32; LANES],
    near_reciprocals: [f32; LANES],
    far_reciprocals: [f32; LANES],
}

impl PlaneTables {
    #[inline(always)]
    fn new(ray: &PreparedRay) -> Self {
        let mut tables = Self {
            origins: [0.0; LANES],
            near_reciprocals: [f32::NAN; LANES],
            far_reciprocals: [f32::NAN; LANES],
        };
        for axis in Axis::ALL {
            let low = 2 * axis.index();
            let is_negative = usize::from(ray.is_negative(axis));
            tables.origins[low] = axis.of(ray.origin());
            tables.origins[low + 1] = axis.of(ray.origin());
            tables.near_reciprocals[low + is_negative] = axis.of(ray.near_reciprocal());
            tables.far_reciprocals[low + (is_negative ^ 1)] = axis.of(ray.far_reciprocal());
        }
        const { assert!(NO_PLANE as usize == 2 * Axis::ALL.len()) };
        tables
    }

    /// What the planes of each child leave of an interval.
    #[inline(always)]
    fn cut<L: Lanes>(&self, node: &WideNode<'_>, (near, far): (f32, f32)) -> Parts<L> {
        let (mut near, mut far) = (L::splat(near), L::splat(far));
        for row in 0..ROWS {
            let (picks, planes) = node.row(row);
            let picks = u64::from(picks);
            let distance = L::from_bits(planes) - L::pick(&self.origins, picks);
            near = near.max_or_keep(distance * L::pick(&self.near_reciprocals, picks));
            far = far.min_or_keep(distance * L::pick(&self.far_reciprocals, picks));
        }
        let held = (1 << node.children()) - 1;
        let met = near.le_mask(far) & held;
        Parts { near, far, met }
    }
}

/// The parts of a ray in the children of a node, and in which there is one.
struct Parts<L> {
    near: L,
    far: L,
    met: u32,
}

impl<L: Lanes> Parts<L> {
    /// The child that is entered first, and the ray's part in it; the others are put
    /// off.
    #[inline(always)]
    fn in_order(
        &self,
        node: &WideNode<'_>,
        stack: &mut WideStack<PutOff>,
    ) -> Option<(WidePointer, f32, f32)> {
        if self.met == 0 {
            return None;
        }
        let (nears, fars) = (self.near.lanes(), self.far.lanes());
        let mut nearest = self.met.trailing_zeros();
        let mut others = self.met & (self.met - 1);
        let bottom = stack.len();
        while others != 0 {
            let mut lane = others.trailing_zeros();
            others &= others - 1;
            if nears[lane as usize] < nears[nearest as usize] {
                std::mem::swap(&mut lane, &mut nearest);
            }
            let far = fars[lane as usize];
            let pointer = node.child(lane);
            stack.push_sorted(PutOff { pointer, far }, nears[lane as usize], bottom);
        }
        let lane = nearest as usize;
        Some((node.child(nearest), nears[lane], fars[lane]))
    }
}

#[cfg(test)]
mod tests {
    use accel_core::query::AllHits;
    use accel_core::testing::{families, rays};
    use accel_core::{AccelerationStructure, TraversalCounters};

    use super::*;
    use crate::BvhBuilder;

    #[test]
    fn every_level_visits_the_same_nodes_and_finds_the_hits_of_the_bvh() {
        let mut hits = 0;
        for family in ["soup-mixed-sizes", "axis-grid"] {
            let scene = families::find(family).unwrap().scene(3, 700);
            let bvh = BvhBuilder::default().build(&scene).unwrap();
            let tree = WideDualSplitTree::from_bvh(&bvh).unwrap();
            tree.validate().unwrap();
            for ray in rays::mixed(&scene, 5, 500) {
                let Some(prepared) = PreparedRay::new(&ray) else {
                    continue;
                };
                let expected = bvh.all_hits(&ray);
                hits += expected.len();
                let mut counts = Vec::new();
                for level in SimdLevel::available() {
                    let mut counters = TraversalCounters::default();
                    let mut query = AllHits::new(&prepared);
                    traverse_at(level, &tree, &prepared, &mut query, &mut counters);
                    assert_eq!(query.into_sorted(), expected, "{}", level.name());
                    counts.push((counters.nodes, counters.primitive_tests));
                }
                assert!(counts.iter().all(|count| *count == counts[0]), "{ray:?}");
            }
        }
        assert!(hits > 1000, "{hits}");
    }
}
