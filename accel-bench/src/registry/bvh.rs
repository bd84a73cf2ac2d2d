//! The rows of accel-bvh.

use accel_bvh::{Bvh, BvhBuilder, CompactBvh, ObjectSplit, Reinsertion, WideBvh};
use accel_core::{BuildError, BuildObserver, InvalidPrimitives, SurfaceAreaHeuristic, Triangle};

use super::Row;

pub(super) static ROWS: &[Row] = &[
    Row {
        name: "bvh-sweep",
        is_headline: true,
        about: "BVH, full-sweep SAH over three axes, 52/4-byte nodes",
        settings: "full sweep, SahUpTo(8), C_t = C_i = 1",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            Ok(Box::new(build_bvh(
                ObjectSplit::FullSweep,
                triangles,
                invalid,
                observer,
            )?))
        },
    },
    Row {
        name: "bvh-binned",
        is_headline: true,
        about: "BVH, binned SAH (32 bins), 52/4-byte nodes",
        settings: "32 bins, SahUpTo(8), C_t = C_i = 1",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            Ok(Box::new(build_bvh(
                ObjectSplit::Binned { bins: 32 },
                triangles,
                invalid,
                observer,
            )?))
        },
    },
    Row {
        name: "bvh-reinsertion",
        is_headline: true,
        about: "the BVH of bvh-sweep with nodes moved to where they cost less",
        settings: "full sweep, SahUpTo(8), C_t = C_i = 1; 8 rounds of a tenth of the nodes",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            Ok(Box::new(build_improved(triangles, invalid, observer)?))
        },
    },
    Row {
        name: "wide-bvh",
        is_headline: true,
        about: "bvh-reinsertion with eight children a node, tested together, 224-byte nodes",
        settings: "as bvh-reinsertion; the largest box opened until there are eight",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let bvh = build_improved(triangles, invalid, observer)?;
            Ok(Box::new(WideBvh::from_bvh(&bvh)?))
        },
    },
    Row {
        name: "compact-bvh",
        is_headline: false,
        about: "the BVH of bvh-sweep with shared planes, 32-byte nodes",
        settings: "full sweep, SahUpTo(8), C_t = C_i = 1",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let bvh = build_bvh(ObjectSplit::FullSweep, triangles, invalid, observer)?;
            Ok(Box::new(CompactBvh::from_bvh(&bvh)?))
        },
    },
];

pub(super) fn build_bvh(
    object_split: ObjectSplit,
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    observer: &dyn BuildObserver,
) -> Result<Bvh<Triangle>, BuildError> {
    let builder = BvhBuilder {
        object_split,
        invalid_primitives,
        ..BvhBuilder::default()
    };
    builder.build_with(triangles, observer)
}

fn build_improved(
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    observer: &dyn BuildObserver,
) -> Result<Bvh<Triangle>, BuildError> {
    let builder = BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        reinsertion: Some(Reinsertion::default()),
        invalid_primitives,
        ..BvhBuilder::default()
    };
    builder.build_with(triangles, observer)
}
