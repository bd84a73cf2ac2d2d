//! A kd-tree that is tuned for the scene: the paper compares with "an optimized
//! kd-tree", and so its costs must not be to its disadvantage.

use accel_core::{BuildError, DynStructure, InvalidPrimitives, RaySegment, Triangle};
use accel_kdtree::{KdTree, KdTreeBuilder};

use super::methods::timed;
use crate::measure;
use crate::rays::{RayKind, RaySet};
use crate::report::model::Spread;

/// K_T, the cost of a node, against a K_I of 20; and the bonus of splits that cut
/// off empty space.
const SETTINGS: [(f64, f64); 6] = [
    (15.0, 0.2),
    (30.0, 0.2),
    (60.0, 0.2),
    (30.0, 0.0),
    (15.0, 0.0),
    (5.0, 0.2),
];

const ROUNDS: usize = 5;

/// Rays that are traced to choose, at most.
const RAYS: usize = 16_384;

/// What was chosen.
pub(super) struct Tuned {
    pub traversal_cost: f64,
    pub empty_bonus: f64,
    pub build_seconds: f64,
    /// Millions of rays per second, of each setting.
    pub tried: Vec<((f64, f64), f64)>,
}

/// The swept kd-tree that traces `rays` fastest.
pub(super) fn fastest(
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    rays: &[RaySegment],
) -> Result<(Tuned, KdTree<Triangle>), BuildError> {
    let mut trees = Vec::new();
    for (traversal_cost, empty_bonus) in SETTINGS {
        let mut builder = KdTreeBuilder {
            empty_bonus,
            invalid_primitives,
            ..KdTreeBuilder::default()
        };
        builder.heuristic.traversal_cost = traversal_cost;
        trees.push(timed(|| builder.build(triangles))?);
    }
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
    let tried: Vec<_> = SETTINGS.into_iter().zip(speeds).collect();
    let by_speed = |a: &usize, b: &usize| tried[*a].1.total_cmp(&tried[*b].1);
    let best = (0..tried.len()).max_by(by_speed).unwrap_or(0);
    let (traversal_cost, empty_bonus) = SETTINGS[best];
    let (build_seconds, tree) = trees.swap_remove(best);
    let tuned = Tuned {
        traversal_cost,
        empty_bonus,
        build_seconds,
        tried,
    };
    Ok((tuned, tree))
}
