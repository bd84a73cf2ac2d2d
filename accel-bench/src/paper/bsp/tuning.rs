//! Trees that are tuned for the scene: the paper compares with "an optimized kd-tree",
//! and so its costs must not be to its disadvantage, nor those of the BSP tree.

use std::fmt;

use accel_bsp::{BspBuilder, BspCosts, BspTree, CandidatePlanes};
use accel_core::{BuildError, DynStructure, InvalidPrimitives, RaySegment, Triangle};
use accel_kdtree::{KdTree, KdTreeBuilder};

use super::methods::timed;
use crate::measure;
use crate::rays::{RayKind, RaySet};
use crate::report::model::Spread;

/// K_T, the cost of a node, against a K_I of 20; and the bonus of splits that cut
/// off empty space.
pub(super) type KdTreeCosts = (f64, f64);

const OF_KD_TREES: [KdTreeCosts; 7] = [
    (15.0, 0.2),
    (30.0, 0.2),
    (60.0, 0.2),
    (120.0, 0.2),
    (30.0, 0.0),
    (15.0, 0.0),
    (5.0, 0.2),
];

/// What a BSP tree is tuned by.
#[derive(Clone, Copy, Debug)]
pub(super) struct BspTuning {
    costs: BspCosts,
    /// How many other corners each edge makes planes with (section 6.1).
    tangents: usize,
}

/// With the paper's costs and planes, and with those that curved surfaces gain by: C_BSP
/// as it is measured here, and planes tangent to many triangles.
fn of_bsp_trees() -> [BspTuning; 6] {
    let of_the_paper = |intersection| BspTuning {
        costs: BspCosts {
            intersection,
            ..BspCosts::default()
        },
        tangents: 0,
    };
    let of_curves = |intersection| BspTuning {
        costs: BspCosts {
            intersection,
            general: 1.1,
            alpha: None,
            ..BspCosts::default()
        },
        tangents: 2,
    };
    [
        of_the_paper(0.5),
        of_the_paper(1.0),
        of_the_paper(4.0),
        of_curves(0.5),
        of_curves(1.0),
        of_curves(2.0),
    ]
}

impl BspTuning {
    /// That of a builder.
    pub(super) fn of(builder: &BspBuilder) -> Self {
        Self {
            costs: builder.costs,
            tangents: builder.candidate_planes.tangents,
        }
    }
}

impl fmt::Display for BspTuning {
    /// C_i/C_BSP/alpha/tangents.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let costs = &self.costs;
        let alpha = costs.alpha.map_or("none".into(), |alpha| alpha.to_string());
        let (intersection, general) = (costs.intersection, costs.general);
        write!(
            formatter,
            "{intersection}/{general}/{alpha}/{}",
            self.tangents
        )
    }
}

const ROUNDS: usize = 5;

/// Rays that are traced to choose, at most.
const RAYS: usize = 16_384;

/// What was chosen.
pub(super) struct Tuned<S> {
    pub setting: S,
    pub build_seconds: f64,
    /// Millions of rays per second, of each setting.
    pub tried: Vec<(S, f64)>,
}

/// The swept kd-tree that traces `rays` fastest.
pub(super) fn kd_tree(
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    rays: &[RaySegment],
) -> Result<(Tuned<KdTreeCosts>, KdTree<Triangle>), BuildError> {
    fastest(&OF_KD_TREES, rays, |(traversal_cost, empty_bonus)| {
        let mut builder = KdTreeBuilder {
            empty_bonus,
            invalid_primitives,
            ..KdTreeBuilder::default()
        };
        builder.heuristic.traversal_cost = traversal_cost;
        builder.build(triangles)
    })
}

/// BSP-tri, as it traces `rays` fastest.
pub(super) fn bsp_tri(
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    rays: &[RaySegment],
) -> Result<(Tuned<BspTuning>, BspTree<Triangle>), BuildError> {
    fastest(&of_bsp_trees(), rays, |tuning| {
        let builder = BspBuilder {
            costs: tuning.costs,
            candidate_planes: CandidatePlanes {
                tangents: tuning.tangents,
                ..CandidatePlanes::default()
            },
            invalid_primitives,
            ..BspBuilder::with_planar_leaves()
        };
        builder.build(triangles)
    })
}

/// Builds a tree with every setting, and keeps the fastest.
fn fastest<S: Copy, T: DynStructure>(
    settings: &[S],
    rays: &[RaySegment],
    build: impl Fn(S) -> Result<T, BuildError>,
) -> Result<(Tuned<S>, T), BuildError> {
    let built = settings
        .iter()
        .map(|&setting| timed(|| build(setting)))
        .collect::<Result<Vec<(f64, T)>, BuildError>>();
    let mut trees = built?;
    let structures: Vec<&dyn DynStructure> = trees
        .iter()
        .map(|(_, tree)| tree as &dyn DynStructure)
        .collect();
    let stride = rays.len().div_ceil(RAYS).max(1);
    let set = RaySet {
        kind: RayKind::Primary,
        rays: rays.iter().step_by(stride).copied().collect(),
        note: None,
    };
    let timings = measure::time_rounds(&structures, &[set], ROUNDS, |_, _| true, || ());
    let speeds = timings
        .iter()
        .map(|sets| Spread::of(&sets[0].mrays_per_second).median);
    let tried: Vec<(S, f64)> = settings.iter().copied().zip(speeds).collect();
    let by_speed = |a: &usize, b: &usize| tried[*a].1.total_cmp(&tried[*b].1);
    let best = (0..tried.len()).max_by(by_speed).unwrap_or(0);
    let (build_seconds, tree) = trees.swap_remove(best);
    let tuned = Tuned {
        setting: tried[best].0,
        build_seconds,
        tried,
    };
    Ok((tuned, tree))
}
