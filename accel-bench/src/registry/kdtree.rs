//! The rows of accel-kdtree.

use accel_core::{BuildError, BuildObserver, InvalidPrimitives, SurfaceAreaHeuristic, Triangle};
use accel_kdtree::{KdTreeBuilder, PlaneSearch};

use super::{Row, Structure};

pub(super) static ROWS: &[Row] = &[
    Row {
        name: "kdtree-sweep",
        is_headline: true,
        about: "kd-tree, O(n log n) event sweep with perfect splits, 8-byte nodes",
        settings: "K_T 15, K_I 20, empty-space bonus 20 %, automatic termination",
        heuristic,
        build: |triangles, invalid, observer| {
            build_kdtree(PlaneSearch::Sweep, triangles, invalid, observer)
        },
    },
    Row {
        name: "kdtree-binned",
        is_headline: false,
        about: "kd-tree, min-max binning near the root and the sweep below, 8-byte nodes",
        settings: "as kdtree-sweep, 64 bins down to 1,024 references",
        heuristic,
        build: |triangles, invalid, observer| {
            build_kdtree(PlaneSearch::binned(), triangles, invalid, observer)
        },
    },
];

fn heuristic() -> SurfaceAreaHeuristic {
    KdTreeBuilder::default().heuristic
}

fn build_kdtree(
    search: PlaneSearch,
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    observer: &dyn BuildObserver,
) -> Result<Structure, BuildError> {
    let builder = KdTreeBuilder {
        search,
        invalid_primitives,
        ..KdTreeBuilder::default()
    };
    Ok(Box::new(builder.build_with(triangles, observer)?))
}
