//! The rows of accel-dualsplit, converted from the tree of `bvh-sweep`.

use accel_bvh::ObjectSplit;
use accel_core::{BuildError, BuildObserver, InvalidPrimitives, SurfaceAreaHeuristic, Triangle};
use accel_dualsplit::{
    BihConverter, DualSplitBuilder, DualSplitConverter, HTreeConverter, Partitioning,
    WideDualSplitTree,
};

use super::bvh::build_bvh;
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
    Row {
        name: "dualsplit-direct",
        is_headline: false,
        about: "dual-split tree whose partition is chosen by its own costs, 12/4-byte nodes",
        settings: "sweep, 8 candidates an axis, SahUpTo(8), C_t = C_i = 1; sigma 0.3 and 0.5",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid_primitives, observer| {
            let builder = DualSplitBuilder {
                invalid_primitives,
                ..DualSplitBuilder::default()
            };
            Ok(Box::new(builder.build_with(triangles, observer)?))
        },
    },
    Row {
        name: "dualsplit-wide",
        is_headline: false,
        about: "wide dual-split tree, 8 children a node, 4 planes a child, from bvh-sweep",
        settings: "full sweep, SahUpTo(8), C_t = C_i = 1; largest children opened first",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let bvh = build_bvh(ObjectSplit::FullSweep, triangles, invalid, observer)?;
            Ok(Box::new(WideDualSplitTree::from_bvh(&bvh)?))
        },
    },
    Row {
        name: "bih",
        is_headline: false,
        about: "bounding interval hierarchy with the boxes of bvh-sweep, 12/4-byte nodes",
        settings: "full sweep, SahUpTo(8), C_t = C_i = 1; sigma 0.3",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let bvh = build_bvh(ObjectSplit::FullSweep, triangles, invalid, observer)?;
            Ok(Box::new(BihConverter::default().convert(&bvh)?))
        },
    },
    Row {
        name: "htree",
        is_headline: false,
        about: "H-tree with the boxes of bvh-sweep, 12/20/28/4-byte nodes",
        settings: "full sweep, SahUpTo(8), C_t = C_i = 1; sigma 0.3, 0.5 and 0.7",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let bvh = build_bvh(ObjectSplit::FullSweep, triangles, invalid, observer)?;
            Ok(Box::new(HTreeConverter::default().convert(&bvh)?))
        },
    },
];

fn convert_bvh(
    partitioning: Partitioning,
    triangles: &[Triangle],
    invalid: InvalidPrimitives,
    observer: &dyn BuildObserver,
) -> Result<Structure, BuildError> {
    let converter = DualSplitConverter {
        partitioning,
        ..DualSplitConverter::default()
    };
    let bvh = build_bvh(ObjectSplit::FullSweep, triangles, invalid, observer)?;
    Ok(Box::new(converter.convert(&bvh)?))
}
