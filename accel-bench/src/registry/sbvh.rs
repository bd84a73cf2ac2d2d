//! The rows of accel-sbvh.

use accel_core::{BuildError, BuildObserver, InvalidPrimitives, SurfaceAreaHeuristic, Triangle};
use accel_sbvh::presplit::{EarlySplitClipping, EdgeVolumeHeuristic};
use accel_sbvh::{CandidateClipping, ReferenceLimit, Reinsertion, SbvhBuilder};

use super::bvh::{WideTriangles, wide_heuristic};
use super::{Row, Structure};

pub(super) static ROWS: &[Row] = &[
    Row {
        name: "esc",
        is_headline: false,
        about: "early split clipping, then full-sweep SAH, 52/4-byte nodes",
        settings: "1.25 references a triangle, full sweep, SahUpTo(8), C_t = C_i = 1",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let mut builder = EarlySplitClipping::default();
            builder.bvh.invalid_primitives = invalid;
            Ok(Box::new(builder.build_with(triangles, observer)?.0))
        },
    },
    Row {
        name: "evh",
        is_headline: false,
        about: "edge volume heuristic, then full-sweep SAH, 52/4-byte nodes",
        settings: "1.25 references a triangle, full sweep, SahUpTo(8), C_t = C_i = 1",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let mut builder = EdgeVolumeHeuristic::default();
            builder.bvh.invalid_primitives = invalid;
            Ok(Box::new(builder.build_with(triangles, observer)?.0))
        },
    },
    Row {
        name: "sbvh",
        is_headline: true,
        about: "SBVH: object and spatial splits, 52/4-byte nodes",
        settings: "alpha 1e-5, 256 bins but at most 8 a reference, at most 2 references a triangle, \
                   SahUpTo(8), C_t = C_i = 1",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            build_sbvh(SbvhBuilder::default(), triangles, invalid, observer)
        },
    },
    Row {
        name: "sbvh-reinsertion",
        is_headline: false,
        about: "the SBVH with nodes moved to where they cost less",
        settings: "as sbvh; 8 rounds of a tenth of the nodes",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let builder = SbvhBuilder {
                reinsertion: Some(Reinsertion::default()),
                ..SbvhBuilder::default()
            };
            build_sbvh(builder, triangles, invalid, observer)
        },
    },
    Row {
        name: "wide-sbvh",
        is_headline: false,
        about: "SBVH of eight children a node, tested together, 224-byte nodes",
        settings: "as sbvh-reinsertion but C_t = 2; the largest box opened until there are eight; \
                   leaves in blocks of four",
        heuristic: wide_heuristic,
        build: |triangles, invalid_primitives, observer| {
            let builder = SbvhBuilder {
                reinsertion: Some(Reinsertion::default()),
                heuristic: wide_heuristic(),
                invalid_primitives,
                ..SbvhBuilder::default()
            };
            let (bvh, _) = builder.build_with(triangles, observer)?;
            Ok(Box::new(WideTriangles::with_storage(&bvh)?))
        },
    },
    Row {
        name: "sbvh-box-clip",
        is_headline: false,
        about: "SBVH whose candidates clip boxes, not triangles",
        settings: "as sbvh, CandidateClipping::Boxes",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let builder = SbvhBuilder {
                clipping: CandidateClipping::Boxes,
                ..SbvhBuilder::default()
            };
            build_sbvh(builder, triangles, invalid, observer)
        },
    },
    Row {
        name: "sbvh-no-unsplit",
        is_headline: false,
        about: "SBVH without reference unsplitting",
        settings: "as sbvh, unsplitting off",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let builder = SbvhBuilder {
                unsplitting: false,
                ..SbvhBuilder::default()
            };
            build_sbvh(builder, triangles, invalid, observer)
        },
    },
    Row {
        name: "sbvh-full",
        is_headline: false,
        about: "SBVH that attempts a spatial split wherever boxes overlap",
        settings: "as sbvh, alpha 0",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let builder = SbvhBuilder {
                alpha: 0.0,
                ..SbvhBuilder::default()
            };
            build_sbvh(builder, triangles, invalid, observer)
        },
    },
    Row {
        name: "sbvh-limit-110",
        is_headline: false,
        about: "SBVH with at most 1.1 references a triangle",
        settings: "as sbvh, ReferenceLimit::Factor(1.1)",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let builder = SbvhBuilder {
                limit: ReferenceLimit::Factor(1.1),
                ..SbvhBuilder::default()
            };
            build_sbvh(builder, triangles, invalid, observer)
        },
    },
];

fn build_sbvh(
    mut builder: SbvhBuilder,
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    observer: &dyn BuildObserver,
) -> Result<Structure, BuildError> {
    builder.invalid_primitives = invalid_primitives;
    Ok(Box::new(builder.build_with(triangles, observer)?.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_settings_named_are_those_of_the_builder() {
        let builder = SbvhBuilder::default();
        let ReferenceLimit::Factor(references) = builder.limit else {
            panic!("{:?} is no factor", builder.limit);
        };
        let expected = format!(
            "alpha {:e}, {} bins but at most {} a reference, at most {references} references a \
             triangle, {:?}, C_t = C_i = 1",
            builder.alpha, builder.spatial_bins, builder.bins_per_reference, builder.leaf_rule
        );
        let row = ROWS.iter().find(|row| row.name == "sbvh").unwrap();
        assert_eq!(row.settings, expected);
    }
}
