//! Every setting on every scene family, against brute force.

use accel_core::BruteForce;
use accel_core::testing::agreement::Expected;
use accel_core::testing::family_check::{Checked, Effort, check_families};
use accel_core::testing::{families, rays, strategy};
use accel_sbvh::glam::Vec3;
use accel_sbvh::{
    AccelerationStructure, CandidateClipping, InvalidPrimitives, LeafRule, ObjectSplit,
    ReferenceLimit, Reinsertion, SbvhBuilder, Spending, Sphere, Triangle,
};
use proptest::prelude::*;

/// Enough for a setting that shares its search with one that is checked in full.
const PART: Effort = Effort {
    seeds: 3,
    triangles: 300,
    rays: 150,
    full_size_rays: 0,
};

fn base() -> SbvhBuilder {
    SbvhBuilder {
        invalid_primitives: InvalidPrimitives::Skip,
        ..SbvhBuilder::default()
    }
}

/// Checks all settings on every family: that the trees are valid, stay within
/// their limits and agree with brute force.
fn check(effort: &Effort, builders: &[SbvhBuilder]) -> Checked {
    let build = |triangles: &[Triangle]| {
        let builds = builders.iter().map(|builder| {
            let (bvh, statistics) = builder.build_with(triangles, &())?;
            bvh.validate()
                .unwrap_or_else(|error| panic!("{builder:?}: {error}"));
            let most = builder
                .limit
                .references(statistics.primitives, size_of::<Triangle>())?;
            assert!(statistics.references <= most, "{builder:?}: {statistics:?}");
            Ok(bvh)
        });
        builds.collect()
    };
    check_families(effort, build).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_paper_s_settings_agree_with_brute_force_on_every_family() {
    let builders = [SbvhBuilder {
        leaf_rule: LeafRule::StopAt(8),
        bins_per_reference: usize::MAX,
        ..base()
    }];
    let effort = Effort {
        seeds: 4,
        triangles: 800,
        ..Effort::default()
    };
    let checked = check(&effort, &builders);
    assert!(checked.families >= 40, "{checked:?}");
    assert!(checked.hits > 20_000, "{checked:?}");
}

#[test]
fn full_splitting_agrees_on_every_family() {
    let builders = [
        SbvhBuilder {
            alpha: 0.0,
            leaf_rule: LeafRule::StopAt(1),
            ..base()
        },
        SbvhBuilder {
            alpha: 0.0,
            unsplitting: false,
            spatial_bins: 7,
            reinsertion: Some(Reinsertion::default()),
            ..base()
        },
    ];
    let checked = check(&PART, &builders);
    assert!(checked.hits > 10_000, "{checked:?}");
}

#[test]
fn box_clipping_and_binning_agree_on_every_family() {
    let builders = [
        SbvhBuilder {
            clipping: CandidateClipping::Boxes,
            alpha: 0.0,
            ..base()
        },
        SbvhBuilder {
            object_split: ObjectSplit::Binned { bins: 16 },
            alpha: 1e-7,
            spatial_bins: 32,
            ..base()
        },
    ];
    let checked = check(&PART, &builders);
    assert!(checked.hits > 10_000, "{checked:?}");
}

#[test]
fn tight_limits_are_kept_and_agree_on_every_family() {
    let spendings = [
        Spending::ByBenefit,
        Spending::BreadthFirst,
        Spending::Shares,
    ];
    let builders = spendings.map(|spending| SbvhBuilder {
        alpha: 0.0,
        limit: ReferenceLimit::Factor(1.1),
        spending,
        ..base()
    });
    let checked = check(&PART, &builders);
    assert!(checked.hits > 10_000, "{checked:?}");
}

#[test]
fn spheres_agree_with_brute_force() {
    let mut splits = 0;
    for seed in 0..10 {
        let boxes = families::find("soup-mixed-sizes").unwrap().scene(seed, 400);
        let spheres: Vec<Sphere> = boxes
            .iter()
            .map(|triangle| Sphere::new(triangle.a, triangle.a.distance(triangle.b)))
            .collect();
        let oracle = BruteForce::new(&spheres).unwrap();
        let builder = SbvhBuilder {
            alpha: 0.0,
            ..base()
        };
        let (bvh, statistics) = builder.build_with(&spheres, &()).unwrap();
        bvh.validate().unwrap();
        splits += statistics.spatial_splits;
        for ray in rays::mixed(&boxes, seed, 400) {
            assert_eq!(bvh.closest_hit(&ray), oracle.closest_hit(&ray), "{ray:?}");
            assert_eq!(bvh.any_hit(&ray), oracle.any_hit(&ray), "{ray:?}");
            assert_eq!(bvh.all_hits(&ray), oracle.all_hits(&ray), "{ray:?}");
        }
    }
    assert!(splits > 0);
}

#[test]
fn a_refitted_tree_with_duplicates_agrees_with_brute_force() {
    let mut triangles = families::find("long-diagonals").unwrap().scene(3, 2000);
    let (mut bvh, statistics) = base().build_with(&triangles, &()).unwrap();
    assert!(statistics.references > triangles.len(), "{statistics:?}");
    for (i, triangle) in triangles.iter_mut().enumerate() {
        let shift = shift_of(i);
        triangle.a += shift;
        triangle.b += shift * 1.5;
        triangle.c += shift;
    }
    bvh.refit(&triangles).unwrap();
    bvh.validate().unwrap();
    let rays = rays::mixed(&triangles, 9, 3000);
    let expected = Expected::new(&triangles, rays).unwrap();
    if let Some(first) = expected.disagreements(&bvh).first() {
        panic!("{first}");
    }
}

fn shift_of(i: usize) -> Vec3 {
    let phase = i as f32;
    Vec3::new(phase.sin(), (1.3 * phase).cos(), (0.7 * phase).sin()) * 0.05
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn any_scene_and_rays_agree(
        (scene, rays) in strategy::any_case(60, 30),
        spatial_bins in 2_usize..=300,
        bins_per_reference in 1_usize..=100,
        leaf_size in 1_usize..10,
        is_swept: bool,
        unsplitting: bool,
        clips_boxes: bool,
        alpha in prop_oneof![Just(0.0), Just(1e-5), Just(1e-2), Just(1.0)],
        factor in 1.0..5.0_f64,
    ) {
        let builder = SbvhBuilder {
            object_split: if is_swept { ObjectSplit::FullSweep } else { ObjectSplit::default() },
            spatial_bins,
            bins_per_reference,
            clipping: if clips_boxes { CandidateClipping::Boxes } else { CandidateClipping::Primitives },
            unsplitting,
            alpha,
            limit: ReferenceLimit::Factor(factor),
            leaf_rule: LeafRule::SahUpTo(leaf_size),
            ..base()
        };
        let (bvh, statistics) = builder.build_with(&scene.triangles, &()).unwrap();
        bvh.validate().unwrap();
        prop_assert!(statistics.references as f64 <= factor * statistics.primitives as f64);
        let expected = Expected::new(&scene.triangles, rays).unwrap();
        if let Some(first) = expected.disagreements(&bvh).first() {
            prop_assert!(false, "{first}");
        }
    }
}
