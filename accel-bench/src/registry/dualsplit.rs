//! The rows of accel-dualsplit, converted from the tree of `bvh-sweep`.

use accel_bvh::{BvhBuilder, ObjectSplit};
use accel_core::{BuildError, BuildObserver, InvalidPrimitives, SurfaceAreaHeuristic, Triangle};
use accel_dualsplit::{DualSplitConverter, Partitioning};

use super::{Row, Structure};

pub(super) static ROWS: &[Row] = &[
    Row {
        name: "dualsplit-identical",
        is_headline: false,
        about: "dual-split tree with the boxes of bvh-sweep, 12/4-byte nodes",
        settings: "full sweep, SahUpTo(8), C_t = C_i = 1; identical, sigma 0.3 and 0.5",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            convert_bvh(Partitioning::Identical, triangles, invalid, observer)
        },
    },
    Row {
        name: "dualsplit-similar",
        is_headline: true,
        about: "dual-split tree that carves where it pays, 12/4-byte nodes",
        settings: "full sweep, SahUpTo(8), C_t = C_i = 1; similar, sigma 0.3 and 0.5",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            convert_bvh(Partitioning::Similar, triangles, invalid, observer)
        },
    },
];

fn convert_bvh(
    partitioning: Partitioning,
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    observer: &dyn BuildObserver,
) -> Result<Structure, BuildError> {
    let builder = BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        invalid_primitives,
        ..BvhBuilder::default()
    };
    let converter = DualSplitConverter {
        partitioning,
        ..DualSplitConverter::default()
    };
    let bvh = builder.build_with(triangles, observer)?;
    Ok(Box::new(converter.convert(&bvh)?))
}
