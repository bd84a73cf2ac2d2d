//! Every setting on every scene family, against brute force.

use accel_bvh::{BvhBuilder, InvalidPrimitives, LeafRule, ObjectSplit, Triangle};
use accel_core::testing::family_check::{Effort, check_families};

fn check(object_split: ObjectSplit, leaf_rule: LeafRule) {
    let builder = BvhBuilder {
        object_split,
        leaf_rule,
        invalid_primitives: InvalidPrimitives::Skip,
        ..BvhBuilder::default()
    };
    let build = |triangles: &[Triangle]| {
        let bvh = builder.build(triangles)?;
        bvh.validate().unwrap_or_else(|error| panic!("{builder:?}: {error}"));
        Ok(bvh)
    };
    let checked = check_families(&Effort::default(), build).unwrap_or_else(|error| panic!("{error}"));
    assert!(checked.families >= 40 && checked.scenes >= 40 * 25, "{checked:?}");
    assert!(checked.hits > 10_000, "{checked:?}");
}

#[test]
fn the_full_sweep_with_sah_leaves_agrees_on_every_family() {
    check(ObjectSplit::FullSweep, LeafRule::SahUpTo(8));
}

#[test]
fn the_full_sweep_with_fixed_leaves_agrees_on_every_family() {
    check(ObjectSplit::FullSweep, LeafRule::StopAt(8));
}

#[test]
fn the_binned_search_agrees_on_every_family() {
    check(ObjectSplit::Binned { bins: 32 }, LeafRule::SahUpTo(8));
}

#[test]
fn few_bins_and_single_leaves_agree_on_every_family() {
    check(ObjectSplit::Binned { bins: 2 }, LeafRule::StopAt(1));
}
