//! The rows of accel-bvh.

use accel_bvh::{Bvh, BvhBuilder, CompactBvh, ObjectSplit, Reinsertion, WideBvh};
use accel_core::layout::TriangleBlocks;
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
            let heuristic = SurfaceAreaHeuristic::default();
            Ok(Box::new(build_improved(
                heuristic, triangles, invalid, observer,
            )?))
        },
    },
    Row {
        name: "wide-bvh",
        is_headline: true,
        about: "BVH of eight children a node, tested together, 224-byte nodes",
        settings: "as bvh-reinsertion but C_t = 2; the largest box opened until there are eight; \
                   leaves in blocks of four",
        heuristic: wide_heuristic,
        build: |triangles, invalid, observer| {
            let bvh = build_improved(wide_heuristic(), triangles, invalid, observer)?;
            Ok(Box::new(WideTriangles::with_storage(&bvh)?))
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

/// A wide BVH with its triangles in blocks that are tested together.
pub(super) type WideTriangles = WideBvh<Triangle, TriangleBlocks<4>>;

/// A node of eight children costs more than a triangle in a block of four.
pub(super) fn wide_heuristic() -> SurfaceAreaHeuristic {
    SurfaceAreaHeuristic {
        traversal_cost: 2.0,
        ..SurfaceAreaHeuristic::default()
    }
}

fn build_improved(
    heuristic: SurfaceAreaHeuristic,
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    observer: &dyn BuildObserver,
) -> Result<Bvh<Triangle>, BuildError> {
    let builder = BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        reinsertion: Some(Reinsertion::default()),
        heuristic,
        invalid_primitives,
        ..BvhBuilder::default()
    };
    builder.build_with(triangles, observer)
}
