//! The rows of accel-bsp.

use accel_bsp::BspBuilder;
use accel_core::{BuildError, BuildObserver, InvalidPrimitives, SurfaceAreaHeuristic, Triangle};

use super::{Row, Structure};

pub(super) static ROWS: &[Row] = &[
    Row {
        name: "bsp",
        is_headline: false,
        about: "general BSP tree with a fast path for axis-aligned planes, 8-byte nodes, planes apart",
        settings: "C_i 1, C_kd 1, C_BSP 1.75, alpha 0.1, epsilon 2^-20, planes of 256 triangles, \
                   general ones where others gain less than 40 %",
        heuristic,
        build: |triangles, invalid, observer| {
            build_bsp(BspBuilder::default(), triangles, invalid, observer)
        },
    },
    Row {
        name: "bsp-orig",
        is_headline: false,
        about: "BSP tree of general nodes only, by the plain SAH",
        settings: "as bsp, no axis-aligned nodes, no alpha",
        heuristic,
        build: |triangles, invalid, observer| {
            build_bsp(BspBuilder::original(), triangles, invalid, observer)
        },
    },
    Row {
        name: "bsp-tri",
        is_headline: false,
        about: "BSP tree whose leaves of one triangle test its plane before the triangle",
        settings: "as bsp, C_i 4, no alpha, planes tangent to others by 2 for each edge, planar \
                   leaves; every hit confirmed by the kernel",
        heuristic: tri_heuristic,
        build: |triangles, invalid, observer| {
            let builder = BspBuilder::with_planar_leaves();
            build_bsp(builder, triangles, invalid, observer)
        },
    },
];

pub(super) fn heuristic() -> SurfaceAreaHeuristic {
    heuristic_of(&BspBuilder::default())
}

pub(super) fn tri_heuristic() -> SurfaceAreaHeuristic {
    heuristic_of(&BspBuilder::with_planar_leaves())
}

fn heuristic_of(builder: &BspBuilder) -> SurfaceAreaHeuristic {
    let costs = &builder.costs;
    SurfaceAreaHeuristic {
        traversal_cost: costs.axis_aligned,
        intersection_cost: costs.intersection,
    }
}

fn build_bsp(
    mut builder: BspBuilder,
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    observer: &dyn BuildObserver,
) -> Result<Structure, BuildError> {
    builder.invalid_primitives = invalid_primitives;
    Ok(Box::new(builder.build_with(triangles, observer)?))
}
