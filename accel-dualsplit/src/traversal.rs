//! The one traversal, for every query and with or without statistics (Lin 2019,
//! section 3.4 and Algorithm 1).
//!
//! ```text
//! node := root, [near, far] := the ray's part in its box
//! loop:
//!     plain leaf:  offer its hits
//!     splitting:   the child that the ray comes to first ends at the plane that
//!                  the ray leaves through; the other begins where it enters
//!                  through the other plane. Both not empty: put the farther off,
//!                  go to the closer; one not empty: go there
//!     carving:     cut [near, far] at both planes; if it is not empty, go to the
//!                  child, or offer the hits of the leaf
//!     otherwise:   take the child put off last that is not behind the best hit
//! ```
//!
//! Which child comes first follows from the sign of the direction, as in a
//! kd-tree. No hit ends the traversal: children may overlap.
//!
//! Every plane is met in the reference form of [`PreparedRay::slab`], and
//! maximum and minimum are exact: after the planes of a whole box, inherited or
//! carved, `near` and `far` are bit for bit those of that box's slab test.

use accel_core::geometry::Axis;
use accel_core::layout::LeafStorage;
use accel_core::query::Query;
use accel_core::ray::{max_or_keep, min_or_keep};
use accel_core::statistics::{NodeKind, TraversalStatistics};
use accel_core::structure::TraversalStack;
use accel_core::{PreparedRay, Primitive};

use crate::codec::{FirstWord, LEAF_BYTES, NODE_BYTES, NODE_WORDS};
use crate::node_set::NodeSet;
use crate::tree::PlaneTree;

/// A node put off, and where the ray leaves it.
#[derive(Clone, Copy)]
struct PutOff {
    position: u32,
    far: f32,
}

pub(crate) fn traverse<P: Primitive, N: NodeSet, Q: Query, S: TraversalStatistics>(
    tree: &PlaneTree<P, N>,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) {
    let Some(bounds) = tree.bounds else { return };
    statistics.test_boxes(1);
    let whole = ray.slab(&bounds);
    let mut near = max_or_keep(ray.t_min(), whole.near);
    let mut far = min_or_keep(query.t_max(), whole.far);
    // Neither is NaN: both began as numbers and kept them.
    if near > far {
        return;
    }
    let words = tree.words.as_slice();
    let planes = PlaneTest::new(ray);
    let mut stack: TraversalStack<PutOff> = TraversalStack::new();
    let mut position = 0_u32;
    loop {
        let node = FirstWord(words[position as usize]);
        let mut leaf = None;
        if N::CARVES_SEVERAL_AXES && node.is_on_several_axes() {
            let own = &words[position as usize..];
            (near, far) = N::carve_several_axes(&planes, node, own, (near, far), statistics);
            if near <= far {
                if !node.is_leaf() {
                    position += node.offset();
                    continue;
                }
                leaf = Some(node.offset());
            }
        } else if node.is_plain_leaf() {
            statistics.visit_node(NodeKind::Leaf, LEAF_BYTES as u32);
            leaf = Some(node.offset());
        } else {
            let axis = &planes.axes[node.axis_index()];
            let [exit, entry] = axis.exit_and_entry(first_planes(&words[position as usize..]));
            let (nearer_far, farther_near) = (min_or_keep(far, exit), max_or_keep(near, entry));
            if node.is_splitting() {
                visit(statistics, NodeKind::Splitting);
                let first = position + node.offset();
                let second = first + N::first_child_words(node);
                let (closer, farther) = if axis.is_negative {
                    (second, first)
                } else {
                    (first, second)
                };
                let meets_farther = farther_near <= far;
                if near <= nearer_far {
                    if meets_farther {
                        let put_off = PutOff {
                            position: farther,
                            far,
                        };
                        stack.push(put_off, farther_near);
                    }
                    (position, far) = (closer, nearer_far);
                    continue;
                }
                if meets_farther {
                    (position, near) = (farther, farther_near);
                    continue;
                }
            } else {
                visit(statistics, NodeKind::Carving);
                if farther_near <= nearer_far {
                    if !node.is_leaf() {
                        position += node.offset();
                        (near, far) = (farther_near, nearer_far);
                        continue;
                    }
                    leaf = Some(node.offset());
                }
            }
        }
        if let Some(leaf) = leaf {
            let leaves = tree.stored.leaves();
            if leaves
                .intersect_leaf(leaf, ray, query, statistics)
                .is_break()
            {
                return;
            }
        }
        let Some(entry) = stack.pop_entry_within(query.t_max()) else {
            return;
        };
        position = entry.node.position;
        near = entry.near;
        far = min_or_keep(query.t_max(), entry.node.far);
    }
}

#[inline(always)]
fn visit<S: TraversalStatistics>(statistics: &mut S, kind: NodeKind) {
    statistics.visit_node(kind, NODE_BYTES as u32);
    statistics.test_planes(2);
}

/// The first two planes of the node at the start of `words`.
#[inline(always)]
fn first_planes(words: &[u32]) -> [f32; 2] {
    let node = &words[..NODE_WORDS];
    [f32::from_bits(node[1]), f32::from_bits(node[2])]
}

/// What meeting planes takes of a ray.
pub struct PlaneTest {
    /// By [`FirstWord::axis_index`]; one more, so that no index is out of range.
    pub(crate) axes: [AxisTest; 4],
    /// By [`BoxPlane::index`](crate::codec::BoxPlane::index); two more.
    sides: [SideTest; 8],
}

#[derive(Clone, Copy)]
pub(crate) struct AxisTest {
    origin: f32,
    near_reciprocal: f32,
    far_reciprocal: f32,
    is_negative: bool,
}

/// One plane of a box: a ray enters through it or leaves through it. The
/// reciprocal for what it does not do is NaN, which constrains nothing.
#[derive(Clone, Copy)]
struct SideTest {
    origin: f32,
    near_reciprocal: f32,
    far_reciprocal: f32,
}

impl PlaneTest {
    #[inline]
    fn new(ray: &PreparedRay) -> Self {
        let test = |axis: Axis| AxisTest {
            origin: axis.of(ray.origin()),
            near_reciprocal: axis.of(ray.near_reciprocal()),
            far_reciprocal: axis.of(ray.far_reciprocal()),
            is_negative: ray.is_negative(axis),
        };
        let [x, y, z] = Axis::ALL.map(test);
        let ([lx, hx], [ly, hy], [lz, hz]) = (x.sides(), y.sides(), z.sides());
        Self {
            axes: [x, y, z, z],
            sides: [lx, hx, ly, hy, lz, hz, lz, hz],
        }
    }

    /// What a dual-axis node, at the start of `words`, leaves of an interval.
    #[inline(always)]
    pub(crate) fn carve_two_axes<S: TraversalStatistics>(
        &self,
        node: FirstWord,
        words: &[u32],
        (near, far): (f32, f32),
        statistics: &mut S,
    ) -> (f32, f32) {
        visit(statistics, NodeKind::Carving);
        let planes = first_planes(words);
        let [a, b] = node
            .dual_plane_indices()
            .map(|index| &self.sides[index & 7]);
        let (to_a, to_b) = (planes[0] - a.origin, planes[1] - b.origin);
        let near = max_or_keep(near, to_a * a.near_reciprocal);
        let near = max_or_keep(near, to_b * b.near_reciprocal);
        let far = min_or_keep(far, to_a * a.far_reciprocal);
        let far = min_or_keep(far, to_b * b.far_reciprocal);
        (near, far)
    }
}

impl AxisTest {
    /// Where the ray leaves through one of two planes and enters through the
    /// other. The first plane bounds a box from above, the second one another
    /// (or the same) from below.
    #[inline(always)]
    pub(crate) fn exit_and_entry(&self, [high, low]: [f32; 2]) -> [f32; 2] {
        let (exit, entry) = if self.is_negative {
            (low, high)
        } else {
            (high, low)
        };
        [
            (exit - self.origin) * self.far_reciprocal,
            (entry - self.origin) * self.near_reciprocal,
        ]
    }

    fn sides(&self) -> [SideTest; 2] {
        let entry = SideTest {
            origin: self.origin,
            near_reciprocal: self.near_reciprocal,
            far_reciprocal: f32::NAN,
        };
        let exit = SideTest {
            near_reciprocal: f32::NAN,
            far_reciprocal: self.far_reciprocal,
            ..entry
        };
        if self.is_negative {
            [exit, entry]
        } else {
            [entry, exit]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codec::{BoxPlane, CarvingPlanes, Header};
    use accel_core::{Aabb, RaySegment};

    /// Directions into all 27 octants, zero components included.
    fn directions() -> impl Iterator<Item = [f32; 3]> {
        let signs = [-1.0_f32, 0.0, 1.0];
        let all = signs.into_iter().flat_map(move |x| {
            signs
                .into_iter()
                .flat_map(move |y| signs.map(|z| [x, y, z]))
        });
        let scale = [0.7, 1.3, 0.9];
        all.filter(|direction| *direction != [0.0; 3])
            .map(move |direction| [0, 1, 2].map(|axis| direction[axis] * scale[axis]))
    }

    fn origins() -> impl Iterator<Item = [f32; 3]> {
        // On the planes, inside, outside.
        let steps = [-1.0_f32, 0.0, 0.25, 0.5, 1.0, 2.0];
        steps.into_iter().flat_map(move |x| {
            steps
                .into_iter()
                .flat_map(move |y| steps.map(|z| [x, y, z]))
        })
    }

    /// Whole boxes by way of two planes: the planes that are carved come from
    /// `inner`, all others are those of the unit box, already met.
    #[test]
    fn all_12_corners_cut_the_interval_to_that_of_the_carved_box() {
        let unit = Aabb::new([0.0; 3], [1.0; 3]);
        let inner = Aabb::new([0.25; 3], [0.5; 3]);
        let (mut met, mut missed) = (0, 0);
        for [first, second] in [[Axis::X, Axis::Y], [Axis::X, Axis::Z], [Axis::Y, Axis::Z]] {
            for corner in 0..4 {
                let plane = |axis, is_high| BoxPlane { axis, is_high };
                let pair = [
                    plane(first, corner & 2 != 0),
                    plane(second, corner & 1 != 0),
                ];
                let at = |plane: BoxPlane| {
                    plane
                        .axis
                        .of(if plane.is_high { inner.max } else { inner.min })
                };
                let header = Header::Carving {
                    planes: CarvingPlanes::Dual(pair[0], pair[1]),
                    is_leaf: false,
                };
                let carved = pair[0].carve(pair[1].carve(unit, at(pair[1])), at(pair[0]));
                for (origin, direction) in
                    origins().flat_map(|origin| directions().map(move |d| (origin, d)))
                {
                    let ray = PreparedRay::new(&RaySegment::new(origin, direction)).unwrap();
                    let (whole, part) = (ray.slab(&unit), ray.slab(&carved));
                    let [first, second] = pair.map(|plane| at(plane).to_bits());
                    let words = [header.encode(3), first, second];
                    let cut = PlaneTest::new(&ray).carve_two_axes(
                        FirstWord(words[0]),
                        &words,
                        (whole.near, whole.far),
                        &mut (),
                    );
                    assert_eq!(
                        cut,
                        (part.near, part.far),
                        "{pair:?} {origin:?} {direction:?}"
                    );
                    let count = if part.is_empty() {
                        &mut missed
                    } else {
                        &mut met
                    };
                    *count += 1;
                }
            }
        }
        assert!(met > 10_000 && missed > 10_000, "{met} {missed}");
    }

    #[test]
    fn both_planes_of_an_axis_cut_the_interval_to_that_of_the_carved_box() {
        let unit = Aabb::new([0.0; 3], [1.0; 3]);
        for axis in Axis::ALL {
            let carved = unit.with_range(axis, 0.25, 0.5);
            for (origin, direction) in
                origins().flat_map(|origin| directions().map(move |d| (origin, d)))
            {
                let ray = PreparedRay::new(&RaySegment::new(origin, direction)).unwrap();
                let (whole, part) = (ray.slab(&unit), ray.slab(&carved));
                let test = PlaneTest::new(&ray);
                let [exit, entry] = test.axes[axis.index()].exit_and_entry([0.5, 0.25]);
                let near = max_or_keep(whole.near, entry);
                let far = min_or_keep(whole.far, exit);
                assert_eq!(
                    (near, far),
                    (part.near, part.far),
                    "{axis:?} {origin:?} {direction:?}"
                );
            }
        }
    }
}
