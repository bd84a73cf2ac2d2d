//! Planes that split cells, and what they cost.

use accel_core::geometry::Axis;
use accel_core::split::NodeCost;
use accel_core::{Aabb, SurfaceAreaHeuristic};

/// A plane orthogonal to an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plane {
    pub axis: Axis,
    pub position: f32,
    /// Whether flat parts in the plane belong to the cell below it.
    pub planar_below: bool,
}

/// Where a part lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Below,
    Above,
    Straddling,
}

impl Plane {
    /// Where a part with these bounds lies. Parts that end at the plane lie
    /// below it, parts that begin there above it.
    #[inline]
    pub(crate) fn side(&self, bounds: &Aabb) -> Side {
        let (low, high) = (self.axis.of(bounds.min), self.axis.of(bounds.max));
        let is_planar = low == self.position && high == self.position;
        if (is_planar && self.planar_below) || (!is_planar && high <= self.position) {
            Side::Below
        } else if low >= self.position {
            Side::Above
        } else {
            Side::Straddling
        }
    }

    /// Both parts of `cell`, below and above.
    pub(crate) fn halves(&self, cell: &Aabb) -> [Aabb; 2] {
        let (low, high) = (self.axis.of(cell.min), self.axis.of(cell.max));
        [
            cell.with_range(self.axis, low, self.position),
            cell.with_range(self.axis, self.position, high),
        ]
    }
}

/// How many parts lie below a plane, in it, and above it; straddling ones both
/// below and above.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Counts {
    pub below: usize,
    pub planar: usize,
    pub above: usize,
}

/// A plane, and what it costs to split by it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Candidate {
    pub plane: Plane,
    pub cost: f64,
}

/// Keeps the cheapest of the planes of a node.
pub(crate) struct Cheapest {
    cell: Aabb,
    count: usize,
    node_cost: NodeCost,
    /// What the cost is multiplied by where one side is empty.
    empty_factor: f64,
    max_duplicates: usize,
    best: Option<Candidate>,
}

/// Half areas of the two parts of a cell, linear in the plane's position.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Areas {
    axis: Axis,
    low: f64,
    high: f64,
    /// Half area of a cross section, which is a flat cell's whole half area.
    section: f64,
    /// What each unit of width adds.
    per_width: f64,
}

impl Areas {
    /// Whether both parts have a width.
    #[inline]
    fn are_divided_at(&self, position: f32) -> bool {
        let s = f64::from(position);
        s > self.low && s < self.high
    }
}

impl Cheapest {
    /// For a node of `count` parts in `cell`, whose split may add up to
    /// `max_duplicates` references.
    pub(crate) fn new(
        heuristic: &SurfaceAreaHeuristic,
        empty_bonus: f64,
        cell: &Aabb,
        count: usize,
        max_duplicates: usize,
    ) -> Self {
        Self {
            cell: *cell,
            count,
            node_cost: heuristic.of_node(cell.half_area(), count),
            empty_factor: 1.0 - empty_bonus,
            max_duplicates,
            best: None,
        }
    }

    /// The areas of both sides of planes along `axis`.
    pub(crate) fn areas(&self, axis: Axis) -> Areas {
        let extent = self.cell.extent();
        let (width, height) = match axis {
            Axis::X => (extent.y, extent.z),
            Axis::Y => (extent.z, extent.x),
            Axis::Z => (extent.x, extent.y),
        };
        Areas {
            axis,
            low: f64::from(axis.of(self.cell.min)),
            high: f64::from(axis.of(self.cell.max)),
            section: width * height,
            per_width: width + height,
        }
    }

    /// Weighs a plane at `position`, flat parts in it on the cheaper side.
    #[inline]
    pub(crate) fn weigh(&mut self, areas: &Areas, position: f32, counts: Counts) {
        let s = f64::from(position);
        let Counts {
            below,
            planar,
            above,
        } = counts;
        if areas.are_divided_at(position) {
            self.keep(areas, position, true, [below + planar, above]);
            if planar > 0 {
                self.keep(areas, position, false, [below, planar + above]);
            }
        } else if planar > 0 && areas.low < areas.high {
            // A flat cell of its own, for what lies in the cell's face.
            let planar_below = s <= areas.low;
            let counts = if planar_below {
                [planar, above]
            } else {
                [below, planar]
            };
            self.keep(areas, position, planar_below, counts);
        }
    }

    /// Weighs a plane at `position` inside the cell, where it is known already on
    /// which side flat parts go.
    #[inline]
    pub(crate) fn weigh_placed(
        &mut self,
        areas: &Areas,
        position: f32,
        planar_below: bool,
        counts: [usize; 2],
    ) {
        if areas.are_divided_at(position) {
            self.keep(areas, position, planar_below, counts);
        }
    }

    /// Keeps the plane if it is the cheapest so far: the first of equals, so
    /// that nothing depends on chance.
    #[inline]
    fn keep(&mut self, areas: &Areas, position: f32, planar_below: bool, counts: [usize; 2]) {
        let s = f64::from(position);
        let half_areas = [
            areas.section + areas.per_width * (s - areas.low),
            areas.section + areas.per_width * (areas.high - s),
        ];
        let mut cost = self.node_cost.split(half_areas, counts);
        if counts[0] == 0 || counts[1] == 0 {
            cost *= self.empty_factor;
        }
        if self.best.is_none_or(|best| cost < best.cost) {
            let duplicates = (counts[0] + counts[1]).saturating_sub(self.count);
            let divides_nothing = counts == [self.count; 2];
            if duplicates <= self.max_duplicates && !divides_nothing {
                let plane = Plane {
                    axis: areas.axis,
                    position,
                    planar_below,
                };
                self.best = Some(Candidate { plane, cost });
            }
        }
    }

    pub(crate) fn best(self) -> Option<Candidate> {
        self.best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cheapest(empty_bonus: f64) -> Cheapest {
        let heuristic = SurfaceAreaHeuristic {
            traversal_cost: 1.0,
            intersection_cost: 2.0,
        };
        let cell = Aabb::new([0.0; 3], [4.0, 1.0, 2.0]);
        Cheapest::new(&heuristic, empty_bonus, &cell, 3, 10)
    }

    fn counts(below: usize, planar: usize, above: usize) -> Counts {
        Counts {
            below,
            planar,
            above,
        }
    }

    #[test]
    fn costs_are_those_worked_out_by_hand() {
        // Half areas: 14 of the cell, 5 below x = 1 and 11 above it.
        let mut plain = cheapest(0.0);
        let areas = plain.areas(Axis::X);
        plain.weigh(&areas, 1.0, counts(1, 1, 1));
        let best = plain.best().unwrap();
        assert!(best.plane.planar_below);
        let expected = 1.0 + 2.0 * (5.0 * 2.0 + 11.0 * 1.0) / 14.0;
        assert!((best.cost - expected).abs() < 1e-12);

        let mut with_bonus = cheapest(0.2);
        with_bonus.weigh(&areas, 1.0, counts(0, 0, 3));
        let expected = 0.8 * (1.0 + 2.0 * 11.0 * 3.0 / 14.0);
        assert!((with_bonus.best().unwrap().cost - expected).abs() < 1e-12);
    }

    #[test]
    fn the_cells_faces_split_off_flat_parts_only() {
        for (position, planar_below) in [(0.0, true), (4.0, false)] {
            let mut search = cheapest(0.0);
            let areas = search.areas(Axis::X);
            search.weigh(&areas, position, counts(1, 0, 2));
            assert_eq!(search.best, None);
            search.weigh(&areas, position, counts(0, 1, 2));
            assert_eq!(search.best.unwrap().plane.planar_below, planar_below);
        }
    }

    #[test]
    fn planes_that_divide_nothing_or_duplicate_too_much_are_dropped() {
        let mut search = cheapest(0.0);
        search.max_duplicates = 1;
        let areas = search.areas(Axis::X);
        search.weigh(&areas, 2.0, counts(3, 0, 3));
        search.weigh(&areas, 2.0, counts(3, 0, 2));
        assert_eq!(search.best, None);
        search.weigh(&areas, 2.0, counts(2, 0, 2));
        assert!(search.best.is_some());
    }

    #[test]
    fn parts_that_touch_a_plane_lie_on_one_side() {
        let plane = |planar_below| Plane {
            axis: Axis::Y,
            position: 1.0,
            planar_below,
        };
        let side = |low, high, planar_below| {
            plane(planar_below).side(&Aabb::new([0.0, low, 0.0], [9.0, high, 9.0]))
        };
        for planar_below in [false, true] {
            assert_eq!(side(0.0, 1.0, planar_below), Side::Below);
            assert_eq!(side(1.0, 2.0, planar_below), Side::Above);
            assert_eq!(side(0.0, 2.0, planar_below), Side::Straddling);
        }
        assert_eq!(side(1.0, 1.0, true), Side::Below);
        assert_eq!(side(1.0, 1.0, false), Side::Above);
    }
}
