//! Counting what traversals do.

use super::{NodeKind, TraversalStatistics};

/// A quantity counted over many rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Over all finished rays together.
    pub sum: u64,
    /// The most that a single ray took.
    pub max: u64,
    current: u64,
}

impl Count {
    #[inline]
    fn add(&mut self, count: u32) {
        self.current += u64::from(count);
    }

    fn finish_ray(&mut self) {
        self.sum += self.current;
        self.max = self.max.max(self.current);
        self.current = 0;
    }

    fn merge(&mut self, other: &Self) {
        self.sum += other.sum;
        self.max = self.max.max(other.max);
    }
}

/// Sums and per-ray maxima of everything that [`TraversalStatistics`] tells.
///
/// ```
/// # use accel_core::{AccelerationStructure, BruteForce, RaySegment, Triangle, TraversalCounters};
/// # fn main() -> Result<(), accel_core::BuildError> {
/// let triangles = [Triangle::new([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])];
/// let structure = BruteForce::new(&triangles)?;
/// let mut counters = TraversalCounters::default();
/// structure.closest_hit_with(&RaySegment::new([0.2, 0.2, -1.0], [0.0, 0.0, 1.0]), &mut counters);
/// assert_eq!(counters.primitive_tests.sum, 1);
/// assert_eq!(counters.mean(&counters.primitive_tests), 1.0);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TraversalCounters {
    /// How many rays are finished.
    pub rays: u64,
    /// Nodes of all kinds that were read.
    pub nodes: Count,
    /// Of these, leaves.
    pub leaves: Count,
    /// Of these, nodes with planes that are not orthogonal to an axis.
    pub general_nodes: Count,
    /// Of these, splitting nodes.
    pub splitting_nodes: Count,
    /// Of these, carving nodes.
    pub carving_nodes: Count,
    /// Boxes tested.
    pub box_tests: Count,
    /// Planes tested; a box counts six.
    pub plane_tests: Count,
    /// Primitives tested.
    pub primitive_tests: Count,
    /// Bytes of nodes read.
    pub node_bytes: Count,
}

impl TraversalCounters {
    /// `count` per ray; 0 without rays.
    pub fn mean(&self, count: &Count) -> f64 {
        if self.rays == 0 {
            0.0
        } else {
            count.sum as f64 / self.rays as f64
        }
    }

    /// Adds what other rays did.
    pub fn merge(&mut self, other: &Self) {
        self.rays += other.rays;
        let mut others = *other;
        for (count, other) in self.counts().into_iter().zip(others.counts()) {
            count.merge(other);
        }
    }

    fn counts(&mut self) -> [&mut Count; 9] {
        [
            &mut self.nodes,
            &mut self.leaves,
            &mut self.general_nodes,
            &mut self.splitting_nodes,
            &mut self.carving_nodes,
            &mut self.box_tests,
            &mut self.plane_tests,
            &mut self.primitive_tests,
            &mut self.node_bytes,
        ]
    }
}

impl TraversalStatistics for TraversalCounters {
    #[inline]
    fn visit_node(&mut self, kind: NodeKind, bytes: u32) {
        self.nodes.add(1);
        self.node_bytes.add(bytes);
        match kind {
            NodeKind::Inner => {}
            NodeKind::General => self.general_nodes.add(1),
            NodeKind::Leaf => self.leaves.add(1),
            NodeKind::Splitting => self.splitting_nodes.add(1),
            NodeKind::Carving => self.carving_nodes.add(1),
        }
    }

    #[inline]
    fn test_boxes(&mut self, count: u32) {
        self.box_tests.add(count);
        self.plane_tests.add(6 * count);
    }

    #[inline]
    fn test_planes(&mut self, count: u32) {
        self.plane_tests.add(count);
    }

    #[inline]
    fn test_primitives(&mut self, count: u32) {
        self.primitive_tests.add(count);
    }

    fn finish_ray(&mut self) {
        self.rays += 1;
        for count in self.counts() {
            count.finish_ray();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_means_and_maxima_are_per_ray() {
        let mut counters = TraversalCounters::default();
        for boxes in [2, 4] {
            counters.visit_node(NodeKind::Inner, 52);
            counters.test_boxes(boxes);
            counters.finish_ray();
        }
        assert_eq!(
            (
                counters.rays,
                counters.box_tests.sum,
                counters.box_tests.max
            ),
            (2, 6, 4)
        );
        assert_eq!(counters.plane_tests.sum, 36);
        assert_eq!(counters.mean(&counters.box_tests), 3.0);
        let mut doubled = counters;
        doubled.merge(&counters);
        assert_eq!(
            (doubled.rays, doubled.box_tests.sum, doubled.box_tests.max),
            (4, 12, 4)
        );
    }
}
