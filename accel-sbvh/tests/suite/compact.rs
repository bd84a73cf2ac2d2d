//! Trees with duplicates in compact form: inner boxes that clipping made larger
//! than their children are fitted, and no hit is lost.

use accel_bvh::CompactBvh;
use accel_core::testing::family_check::{Effort, check_families};
use accel_sbvh::{BuildError, InvalidPrimitives, SbvhBuilder, Triangle};

#[test]
fn compact_trees_with_duplicates_agree_on_every_family() {
    let effort = Effort {
        seeds: 2,
        triangles: 500,
        rays: 150,
        full_size_rays: 0,
    };
    let builder = SbvhBuilder {
        alpha: 0.0,
        invalid_primitives: InvalidPrimitives::Skip,
        ..SbvhBuilder::default()
    };
    let build = |triangles: &[Triangle]| -> Result<Vec<CompactBvh<Triangle>>, BuildError> {
        let compact = CompactBvh::from_bvh(&builder.build_with(triangles, &())?.0)?;
        compact.validate().unwrap_or_else(|error| panic!("{error}"));
        Ok(vec![compact])
    };
    let checked = check_families(&effort, build).unwrap_or_else(|error| panic!("{error}"));
    assert!(checked.hits > 5_000, "{checked:?}");
}
