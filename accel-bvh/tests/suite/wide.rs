//! The wide BVH answers as brute force does, with the vectors of every level.

use accel_bvh::{
    AccelerationStructure, BvhBuilder, InvalidPrimitives, LeafRule, ObjectSplit, Reinsertion,
    Sphere, TraversalCounters, Triangle, WIDE_NODE_BYTES, WideBvh,
};
use accel_core::PreparedRay;
use accel_core::layout::TriangleBlocks;
use accel_core::query::{AllHits, ClosestHit};
use accel_core::simd::SimdLevel;
use accel_core::testing::agreement::Expected;
use accel_core::testing::family_check::{Effort, check_families};
use accel_core::testing::{families, rays, strategy};
use proptest::prelude::*;

fn builder(leaf_rule: LeafRule) -> BvhBuilder {
    BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        leaf_rule,
        invalid_primitives: InvalidPrimitives::Skip,
        ..BvhBuilder::default()
    }
}

#[test]
fn wide_trees_agree_with_brute_force_on_every_family() {
    let effort = Effort {
        seeds: 2,
        triangles: 500,
        rays: 150,
        full_size_rays: 0,
    };
    let build = |triangles: &[Triangle]| {
        let builders = [
            builder(LeafRule::StopAt(1)),
            BvhBuilder {
                reinsertion: Some(Reinsertion::default()),
                ..builder(LeafRule::default())
            },
        ];
        let wide = builders.iter().map(|builder| {
            let wide = WideBvh::from_bvh(&builder.build(triangles)?)?;
            wide.validate()
                .unwrap_or_else(|error| panic!("{builder:?}: {error}"));
            Ok(wide)
        });
        wide.collect()
    };
    let checked = check_families(&effort, build).unwrap_or_else(|error| panic!("{error}"));
    assert!(
        checked.families >= 40 && checked.hits > 6_000,
        "{checked:?}"
    );
}

#[test]
fn leaves_of_blocks_agree_with_brute_force_on_every_family() {
    let effort = Effort {
        seeds: 2,
        triangles: 400,
        rays: 150,
        full_size_rays: 0,
    };
    let build = |triangles: &[Triangle]| {
        let bvh = builder(LeafRule::StopAt(6)).build(triangles)?;
        let wide = WideBvh::<Triangle, TriangleBlocks<4>>::with_storage(&bvh)?;
        wide.validate().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(wide.skipped_count(), bvh.skipped_count());
        Ok(vec![wide])
    };
    let checked = check_families(&effort, build).unwrap_or_else(|error| panic!("{error}"));
    assert!(checked.hits > 3_000, "{checked:?}");
}

#[test]
fn every_level_of_vectors_gives_the_same_bits_and_counts() {
    for family in families::all() {
        let scene = family.scene(2, 300.min(family.full_size));
        let bvh = builder(LeafRule::default()).build(&scene).unwrap();
        let wide = WideBvh::from_bvh(&bvh).unwrap();
        for ray in rays::mixed(&scene, 5, 200) {
            let Some(ray) = PreparedRay::new(&ray) else {
                continue;
            };
            let answers = SimdLevel::available().map(|level| {
                let mut counters = TraversalCounters::default();
                let (mut closest, mut all) = (ClosestHit::new(&ray), AllHits::new(&ray));
                wide.traverse_at(level, &ray, &mut closest, &mut counters);
                wide.traverse_at(level, &ray, &mut all, &mut counters);
                (closest.best(), all.into_sorted(), counters.nodes.sum)
            });
            let answers: Vec<_> = answers.collect();
            let mut expected = AllHits::new(&ray);
            bvh.traverse(&ray, &mut expected, &mut ());
            assert_eq!(answers[0].1, expected.into_sorted(), "{}", family.name);
            for answer in &answers {
                assert_eq!(answer, &answers[0], "{}", family.name);
            }
        }
    }
}

#[test]
fn nodes_are_full_unless_all_their_children_are_leaves() {
    let scene = families::find("hairball").unwrap().scene(1, 3000);
    let bvh = builder(LeafRule::StopAt(1)).build(&scene).unwrap();
    let wide = WideBvh::from_bvh(&bvh).unwrap();
    let outline = wide.outline();
    let mut inner = 0;
    for children in outline
        .children()
        .iter()
        .filter(|children| !children.is_empty())
    {
        inner += 1;
        let is_leaf = |child: &u32| !outline.nodes[*child as usize].references.is_empty();
        assert!(children.len() == 8 || children.iter().all(is_leaf));
    }
    assert_eq!(wide.node_bytes(), inner * WIDE_NODE_BYTES);
    assert!(wide.depth() < bvh.depth());
}

#[test]
fn scenes_of_none_and_one_have_no_nodes() {
    for count in [0, 1] {
        let spheres = vec![Sphere::new([1.0; 3], 2.0); count];
        let bvh = BvhBuilder::default().build(&spheres).unwrap();
        let wide = WideBvh::from_bvh(&bvh).unwrap();
        wide.validate().unwrap();
        assert_eq!(wide.node_bytes(), 0);
        assert_eq!(wide.bounds(), bvh.bounds());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(50))]

    #[test]
    fn any_scene_and_rays_agree(
        (scene, rays) in strategy::any_case(60, 30),
        leaf_size in 1_usize..10,
    ) {
        let bvh = builder(LeafRule::SahUpTo(leaf_size)).build(&scene.triangles).unwrap();
        let wide = WideBvh::from_bvh(&bvh).unwrap();
        wide.validate().unwrap();
        let expected = Expected::new(&scene.triangles, rays).unwrap();
        if let Some(first) = expected.disagreements(&wide).first() {
            prop_assert!(false, "{first}");
        }
    }
}
