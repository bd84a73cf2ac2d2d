//! Trees that are tuned for the scene: the paper compares with "an optimized kd-tree",
//! and so its costs must not be to its disadvantage, nor those of the BSP tree.

use accel_bsp::{BspBuilder, BspCosts, BspTree};
use accel_core::{BuildError, DynStructure, InvalidPrimitives, RaySegment, Triangle};
use accel_kdtree::{KdTree, KdTreeBuilder};

use super::methods::timed;
use crate::measure;
use crate::rays::{RayKind, RaySet};
use crate::report::model::Spread;

/// K_T, the cost of a node, against a K_I of 20; and the bonus of splits that cut
/// off empty space.
pub(super) type KdTreeCosts = (f64, f64);

const OF_KD_TREES: [KdTreeCosts; 6] = [
    (15.0, 0.2),
    (30.0, 0.2),
    (60.0, 0.2),
    (30.0, 0.0),
    (15.0, 0.0),
    (5.0, 0.2),
];

/// C_i, the cost of testing a triangle, in costs of an axis-aligned node.
const OF_BSP_TREES: [f64; 4] = [0.5, 1.0, 2.0, 4.0];

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
) -> Result<(Tuned<f64>, BspTree<Triangle>), BuildError> {
    fastest(&OF_BSP_TREES, rays, |intersection| {
        let builder = BspBuilder {
            costs: BspCosts {
                intersection,
                ..BspCosts::default()
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
