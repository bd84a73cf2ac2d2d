//! The cheapest nested carving nodes (Lin 2019, section 4.2, equation 1).

use accel_core::Aabb;
use accel_core::geometry::Axis;

use super::{CarvingRules, NodeCosts, Partitioning};
use crate::codec::{BoundedAxes, BoxPlane, CarvingPlanes, MOST_PLANES};

/// The most carving nodes between two splitting nodes: three on one axis each
/// carve any box.
const MAX_LEVELS: usize = 3;

/// A carving node to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Carving {
    pub planes: CarvingPlanes,
    /// As many as there are planes, then zeros.
    pub positions: [f32; MOST_PLANES],
}

/// Nested carving nodes, and what is left when they have carved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CarvingPlan {
    levels: [Option<Carving>; MAX_LEVELS],
    pub region: Aabb,
    /// Equation 1, times the area of the parent: areas times costs.
    pub cost: f64,
}

impl CarvingPlan {
    /// No carving nodes: all of `region` is left.
    pub(super) fn uncarved(region: Aabb) -> Self {
        Self {
            levels: [None; MAX_LEVELS],
            region,
            cost: 0.0,
        }
    }

    /// The nodes, outermost first.
    pub(super) fn carvings(&self) -> impl Iterator<Item = Carving> + '_ {
        self.levels.iter().flatten().copied()
    }

    /// The cheapest way to carve `region` towards `target`, the box of
    /// `references` references; `None` where none costs less than `limit`.
    pub(super) fn cheapest(
        choices: &CarvingChoices,
        region: Aabb,
        target: Aabb,
        references: u32,
        limit: f64,
    ) -> Option<Self> {
        let uncarved = Self::uncarved(region);
        let loose = LoosePlanes::between(&region, &target);
        let area = region.half_area();
        let target = region.intersection(&target);
        let references = f64::from(references);
        let mut search = Search {
            choices,
            target,
            references,
            least_tests: references * target.half_area(),
            limit,
            best: None,
        };
        search.visit(&uncarved, area, loose, 0);
        search.best
    }
}

/// What may carve, by what there is to carve: worked out once a conversion, since
/// every node asks.
pub(crate) struct CarvingChoices {
    is_similar: bool,
    /// For every set of loose planes.
    by_loose: Vec<Vec<Choice>>,
}

/// A carving node that is worth a try.
#[derive(Clone, Copy)]
struct Choice {
    planes: CarvingPlanes,
    /// What visiting it costs.
    sigma: f64,
    /// The planes that it leaves loose, and the fewest nodes that carve those.
    rest: LoosePlanes,
    levels_for_rest: usize,
}

impl CarvingChoices {
    pub(crate) fn new(rules: &CarvingRules) -> Self {
        let costs = &rules.costs;
        let choices = |loose: LoosePlanes| {
            let choice = |planes| {
                let rest = loose.without(planes);
                Choice {
                    planes,
                    sigma: costs.sigma(planes),
                    rest,
                    levels_for_rest: rest.fewest_levels(costs),
                }
            };
            loose.carving_nodes(costs).map(choice).collect()
        };
        Self {
            is_similar: rules.partitioning == Partitioning::Similar,
            by_loose: (0..LoosePlanes::SETS)
                .map(LoosePlanes)
                .map(choices)
                .collect(),
        }
    }

    fn of(&self, loose: LoosePlanes) -> &[Choice] {
        &self.by_loose[usize::from(loose.0)]
    }
}

/// The planes of a region that lie outside a target: a bit each, by
/// [`BoxPlane::index`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct LoosePlanes(u8);

impl LoosePlanes {
    /// How many sets there are.
    const SETS: u8 = 1 << 6;

    fn between(region: &Aabb, target: &Aabb) -> Self {
        let mut bits = 0;
        for axis in Axis::ALL {
            let low = axis.of(target.min) > axis.of(region.min);
            let high = axis.of(target.max) < axis.of(region.max);
            bits |= (u8::from(low) | u8::from(high) << 1) << (2 * axis.index());
        }
        Self(bits)
    }

    fn is_empty(self) -> bool {
        self.0 == 0
    }

    fn holds(self, plane: BoxPlane) -> bool {
        self.0 & 1 << plane.index() != 0
    }

    fn on_axis(self, axis: Axis) -> bool {
        self.0 >> (2 * axis.index()) & 0b11 != 0
    }

    /// The fewest carving nodes that carve them all.
    fn fewest_levels(self, costs: &NodeCosts) -> usize {
        if costs.bounding.is_some() {
            return usize::from(!self.is_empty());
        }
        let axes = Axis::ALL.into_iter().filter(|&axis| self.on_axis(axis));
        let pairs = self.0.count_ones().div_ceil(2) as usize;
        match costs.dual_axis {
            Some(_) => axes.count().min(pairs),
            None => axes.count(),
        }
    }

    fn without(self, planes: CarvingPlanes) -> Self {
        let bit = |plane: BoxPlane| 1 << plane.index();
        let on_axis = |axis: &Axis| 0b11 << (2 * axis.index());
        let carved = match planes {
            CarvingPlanes::Single(axis) => on_axis(&axis),
            CarvingPlanes::Dual(a, b) => bit(a) | bit(b),
            CarvingPlanes::Bounding(bounded) => bounded
                .axes()
                .iter()
                .map(on_axis)
                .fold(0, |all, axis| all | axis),
        };
        Self(self.0 & !carved)
    }

    /// Every carving node that carves some of them, but those that another one
    /// beats whatever comes after: a plane on one of two axes and nothing on the
    /// other is no cheaper than both planes of that axis, unless dual-axis nodes
    /// are cheaper; a bounding node on an axis without loose planes is none.
    fn carving_nodes(self, costs: &NodeCosts) -> impl Iterator<Item = CarvingPlanes> {
        let single = Axis::ALL
            .into_iter()
            .filter(move |&axis| self.on_axis(axis))
            .map(CarvingPlanes::Single);
        let bounding = BoundedAxes::ALL
            .into_iter()
            .filter(move |bounded| bounded.axes().iter().all(|&axis| self.on_axis(axis)))
            .map(CarvingPlanes::Bounding);
        let lone_dual = costs.dual_axis.is_some_and(|cost| cost < costs.single_axis);
        let dual = costs.dual_axis.map(|_| self.dual_axis_nodes(lone_dual));
        let bounding = costs.bounding.map(|_| bounding);
        single
            .chain(dual.into_iter().flatten())
            .chain(bounding.into_iter().flatten())
    }

    /// Dual-axis nodes both of whose planes are loose; one of them is enough if
    /// `lone_dual`.
    fn dual_axis_nodes(self, lone_dual: bool) -> impl Iterator<Item = CarvingPlanes> {
        let pairs = [[Axis::X, Axis::Y], [Axis::X, Axis::Z], [Axis::Y, Axis::Z]];
        pairs.into_iter().flat_map(move |[first, second]| {
            (0..4).filter_map(move |corner: u8| {
                let plane = |axis, is_high| BoxPlane { axis, is_high };
                let first = plane(first, corner & 2 != 0);
                let second = plane(second, corner & 1 != 0);
                let (a, b) = (self.holds(first), self.holds(second));
                let carves = (a && b) || (lone_dual && (a || b));
                carves.then_some(CarvingPlanes::Dual(first, second))
            })
        })
    }
}

/// Walks all configurations of up to three nested carving nodes, leaving out
/// those that can't cost less than the best.
struct Search<'a> {
    choices: &'a CarvingChoices,
    /// Inside the region.
    target: Aabb,
    references: f64,
    /// What testing the references costs at least: in the target itself.
    least_tests: f64,
    /// What a plan must cost less than.
    limit: f64,
    best: Option<CarvingPlan>,
}

impl Search<'_> {
    /// `plan` has carved down to its region, of half area `area`, for its cost,
    /// and left `loose`.
    fn visit(&mut self, plan: &CarvingPlan, area: f64, loose: LoosePlanes, level: usize) {
        let choices = self.choices;
        let is_similar = choices.is_similar;
        if loose.is_empty() || is_similar {
            let cost = plan.cost + area * self.references;
            if cost < self.limit {
                self.limit = cost;
                self.best = Some(CarvingPlan { cost, ..*plan });
            }
        }
        let levels_left = MAX_LEVELS - level;
        if loose.is_empty() || levels_left == 0 {
            return;
        }
        for choice in choices.of(loose) {
            let cost = plan.cost + area * choice.sigma;
            if cost + self.least_tests >= self.limit {
                continue;
            }
            if !is_similar && choice.levels_for_rest >= levels_left {
                continue;
            }
            let carving = Carving::towards(&self.target, choice.planes);
            let mut carved = CarvingPlan {
                region: carving.carve(plan.region),
                cost,
                ..*plan
            };
            carved.levels[level] = Some(carving);
            let area = carved.region.half_area();
            self.visit(&carved, area, choice.rest, level + 1);
        }
    }
}

impl Carving {
    /// The node that carves to `target` with these planes.
    fn towards(target: &Aabb, planes: CarvingPlanes) -> Self {
        Self {
            planes,
            positions: planes.around(target),
        }
    }

    /// The positions that the node stores.
    pub(super) fn stored_positions(&self) -> &[f32] {
        &self.positions[..self.planes.count()]
    }

    fn carve(&self, region: Aabb) -> Aabb {
        self.planes.carve(region, &self.positions)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CarvingCosts;

    fn plan(
        partitioning: Partitioning,
        region: Aabb,
        target: Aabb,
        references: u32,
    ) -> CarvingPlan {
        let rules = CarvingRules {
            partitioning,
            costs: NodeCosts::from(CarvingCosts::default()),
        };
        CarvingPlan::cheapest(
            &CarvingChoices::new(&rules),
            region,
            target,
            references,
            f64::INFINITY,
        )
        .expect("some plan is finite")
    }

    #[test]
    fn costs_are_those_of_equation_1() {
        // Half areas: 3 of the cube, 2 of its half.
        let cube = Aabb::new([0.0; 3], [1.0; 3]);
        let half = Aabb::new([0.0; 3], [1.0, 1.0, 0.5]);
        let carved = plan(Partitioning::Identical, cube, half, 4);
        let planes = CarvingPlanes::Single(Axis::Z);
        let carvings: Vec<_> = carved.carvings().map(|carving| carving.planes).collect();
        assert_eq!((carvings, carved.region), (vec![planes], half));
        assert!((carved.cost - (0.3 * 3.0 + 4.0 * 2.0)).abs() < 1e-12);
        let whole = plan(Partitioning::Identical, cube, cube, 4);
        assert!(whole.carvings().count() == 0 && whole.cost == 4.0 * 3.0);
    }

    #[test]
    fn similar_carves_only_where_it_pays() {
        let cube = Aabb::new([0.0; 3], [1.0; 3]);
        // Saves 0.2 of 3 a reference and costs 0.9: pays from five references on.
        let slightly_smaller = Aabb::new([0.0; 3], [1.0, 1.0, 0.9]);
        for (references, is_empty) in [(4, true), (5, false)] {
            let plan = plan(Partitioning::Similar, cube, slightly_smaller, references);
            assert_eq!(plan.carvings().count() == 0, is_empty, "{references}");
        }
    }

    #[test]
    fn two_planes_on_two_axes_take_one_node_and_five_planes_three() {
        let cube = Aabb::new([0.0; 3], [1.0; 3]);
        let corner = Aabb::new([0.1, 0.0, 0.0], [1.0, 0.9, 1.0]);
        let plane = |axis, is_high| BoxPlane { axis, is_high };
        let dual = CarvingPlanes::Dual(plane(Axis::X, false), plane(Axis::Y, true));
        let carved = plan(Partitioning::Identical, cube, corner, 1);
        let carvings: Vec<_> = carved.carvings().map(|carving| carving.planes).collect();
        assert_eq!((carvings, carved.region), (vec![dual], corner));
        let inside = Aabb::new([0.1, 0.1, 0.1], [0.9, 0.9, 1.0]);
        let carved = plan(Partitioning::Identical, cube, inside, 1);
        assert_eq!((carved.carvings().count(), carved.region), (3, inside));
    }
}
