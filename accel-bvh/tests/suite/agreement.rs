//! Every setting on every scene family, against brute force.

use accel_bvh::{
    AccelerationStructure, BvhBuilder, Hit, InvalidPrimitives, LeafRule, ObjectSplit, Reinsertion,
    Sphere, TraversalCounters, Triangle,
};
use accel_core::BruteForce;
use accel_core::testing::agreement::{Expected, oracle};
use accel_core::testing::family_check::{Checked, Effort, check_families};
use accel_core::testing::rays::RayKind;
use accel_core::testing::{families, rays, strategy};
use proptest::prelude::*;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// Enough for a setting that shares its search with one that is checked in full.
const PART: Effort = Effort {
    seeds: 2,
    triangles: 400,
    rays: 120,
    full_size_rays: 0,
};

/// Checks all settings on every family, and that each tree is valid.
fn check(
    effort: &Effort,
    settings: &[(ObjectSplit, LeafRule)],
    reinsertion: Option<Reinsertion>,
) -> Checked {
    let build = |triangles: &[Triangle]| {
        let builds = settings.iter().map(|&(object_split, leaf_rule)| {
            let builder = BvhBuilder {
                object_split,
                leaf_rule,
                reinsertion,
                invalid_primitives: InvalidPrimitives::Skip,
                ..BvhBuilder::default()
            };
            let bvh = builder.build(triangles)?;
            bvh.validate()
                .unwrap_or_else(|error| panic!("{builder:?}: {error}"));
            Ok(bvh)
        });
        builds.collect()
    };
    check_families(effort, build).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn both_searches_agree_with_brute_force_on_every_family() {
    let settings = [
        (ObjectSplit::FullSweep, LeafRule::SahUpTo(8)),
        (ObjectSplit::Binned { bins: 32 }, LeafRule::SahUpTo(8)),
    ];
    let checked = check(&Effort::default(), &settings, None);
    assert!(
        checked.families >= 40 && checked.scenes >= 40 * 25,
        "{checked:?}"
    );
    assert!(checked.hits > 100_000, "{checked:?}");
}

#[test]
fn other_leaf_rules_and_bins_agree_on_every_family() {
    let settings = [
        (ObjectSplit::FullSweep, LeafRule::StopAt(8)),
        (ObjectSplit::FullSweep, LeafRule::SahUpTo(1)),
        (ObjectSplit::Binned { bins: 64 }, LeafRule::StopAt(8)),
        (ObjectSplit::Binned { bins: 2 }, LeafRule::StopAt(1)),
    ];
    let checked = check(&PART, &settings, None);
    assert!(checked.hits > 4_000, "{checked:?}");
}

#[test]
fn improved_trees_agree_on_every_family() {
    let settings = [
        (ObjectSplit::FullSweep, LeafRule::SahUpTo(8)),
        (ObjectSplit::Binned { bins: 32 }, LeafRule::StopAt(4)),
    ];
    let everything = Reinsertion {
        rounds: 30,
        share: 1.0,
    };
    for reinsertion in [Reinsertion::default(), everything] {
        let checked = check(&PART, &settings, Some(reinsertion));
        assert!(checked.hits > 2_000, "{checked:?}");
    }
}

#[test]
fn rays_without_an_answer_miss_and_visit_nothing() {
    let scene = families::find("overlapping-big").unwrap().scene(1, 500);
    let bvh = BvhBuilder::default().build(&scene).unwrap();
    let mut counters = TraversalCounters::default();
    let mut random = Pcg64Mcg::seed_from_u64(4);
    for ray in rays::rays(RayKind::NonFinite, &scene, &mut random, 2000) {
        assert_eq!(bvh.closest_hit_with(&ray, &mut counters), None);
        assert!(!bvh.any_hit_with(&ray, &mut counters));
        assert!(bvh.all_hits_with(&ray, &mut counters).is_empty());
    }
    assert_eq!((counters.nodes.sum, counters.box_tests.sum), (0, 0));
}

#[test]
fn spheres_agree_with_brute_force() {
    for seed in 0..20 {
        let boxes = families::find("soup-mixed-sizes").unwrap().scene(seed, 400);
        let spheres: Vec<Sphere> = boxes
            .iter()
            .map(|triangle| Sphere::new(triangle.a, triangle.a.distance(triangle.b)))
            .collect();
        let oracle = BruteForce::new(&spheres).unwrap();
        for object_split in [ObjectSplit::FullSweep, ObjectSplit::default()] {
            let builder = BvhBuilder {
                object_split,
                ..BvhBuilder::default()
            };
            let bvh = builder.build(&spheres).unwrap();
            bvh.validate().unwrap();
            for ray in rays::mixed(&boxes, seed, 400) {
                assert_eq!(bvh.closest_hit(&ray), oracle.closest_hit(&ray), "{ray:?}");
                assert_eq!(bvh.any_hit(&ray), oracle.any_hit(&ray), "{ray:?}");
                assert_eq!(bvh.all_hits(&ray), oracle.all_hits(&ray), "{ray:?}");
            }
        }
    }
}

#[test]
fn filtered_and_batched_queries_agree_with_brute_force() {
    let scene = families::find("overlapping-big").unwrap().scene(5, 300);
    let (bvh, oracle) = (
        BvhBuilder::default().build(&scene).unwrap(),
        oracle(&scene).unwrap(),
    );
    let rays = rays::mixed(&scene, 6, 2000);
    let odd = |hit: &Hit| hit.id % 2 == 1;
    for ray in &rays {
        assert_eq!(
            bvh.closest_hit_where(ray, odd),
            oracle.closest_hit_where(ray, odd)
        );
        assert_eq!(bvh.any_hit_where(ray, odd), oracle.any_hit_where(ray, odd));
        assert_eq!(
            bvh.all_hits_where(ray, odd),
            oracle.all_hits_where(ray, odd)
        );
    }
    let single: Vec<_> = rays.iter().map(|ray| oracle.closest_hit(ray)).collect();
    assert_eq!(bvh.closest_hits(&rays), single);
    let single: Vec<_> = rays.iter().map(|ray| oracle.any_hit(ray)).collect();
    assert_eq!(bvh.any_hits(&rays), single);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn any_scene_and_rays_agree(
        (scene, rays) in strategy::any_case(60, 30),
        bins in 2_usize..=64,
        leaf_size in 1_usize..10,
        is_swept: bool,
    ) {
        let builder = BvhBuilder {
            object_split: if is_swept { ObjectSplit::FullSweep } else { ObjectSplit::Binned { bins } },
            leaf_rule: LeafRule::SahUpTo(leaf_size),
            invalid_primitives: InvalidPrimitives::Skip,
            ..BvhBuilder::default()
        };
        let bvh = builder.build(&scene.triangles).unwrap();
        bvh.validate().unwrap();
        let expected = Expected::new(&scene.triangles, rays).unwrap();
        if let Some(first) = expected.disagreements(&bvh).first() {
            prop_assert!(false, "{first}");
        }
    }
}
