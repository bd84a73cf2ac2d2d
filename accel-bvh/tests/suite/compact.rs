//! The Compact BVH answers as brute force does, and visits what its source visits.

use accel_bvh::{
    AccelerationStructure, BvhBuilder, CompactBvh, InvalidPrimitives, LeafRule, ObjectSplit,
    Sphere, TraversalCounters, Triangle,
};
use accel_core::testing::agreement::Expected;
use accel_core::testing::family_check::{Checked, Effort, check_families};
use accel_core::testing::{families, rays, strategy};
use proptest::prelude::*;

fn builder(object_split: ObjectSplit, leaf_rule: LeafRule) -> BvhBuilder {
    BvhBuilder {
        object_split,
        leaf_rule,
        invalid_primitives: InvalidPrimitives::Skip,
        ..BvhBuilder::default()
    }
}

fn check(effort: &Effort, settings: &[(ObjectSplit, LeafRule)]) -> Checked {
    let build = |triangles: &[Triangle]| {
        let compact = settings.iter().map(|&(object_split, leaf_rule)| {
            let bvh = builder(object_split, leaf_rule).build(triangles)?;
            let compact = CompactBvh::from_bvh(&bvh)?;
            compact
                .validate()
                .unwrap_or_else(|error| panic!("{object_split:?}: {error}"));
            Ok(compact)
        });
        compact.collect()
    };
    check_families(effort, build).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn compact_trees_agree_with_brute_force_on_every_family() {
    let effort = Effort {
        seeds: 1,
        triangles: 500,
        rays: 150,
        full_size_rays: 0,
    };
    let settings = [
        (ObjectSplit::FullSweep, LeafRule::SahUpTo(8)),
        (ObjectSplit::default(), LeafRule::StopAt(1)),
    ];
    let checked = check(&effort, &settings);
    assert!(
        checked.families >= 40 && checked.hits > 3_000,
        "{checked:?}"
    );
}

/// Boxes, intervals and the order of children are the same bit for bit, so every
/// count is, but for the planes: six instead of twelve.
#[test]
fn nodes_leaves_and_primitives_visited_are_those_of_the_source() {
    let mut planes = [0; 2];
    for family in families::all() {
        let scene = family.scene(2, 1000.min(family.full_size));
        let bvh = builder(ObjectSplit::FullSweep, LeafRule::SahUpTo(8))
            .build(&scene)
            .unwrap();
        let compact = CompactBvh::from_bvh(&bvh).unwrap();
        let (mut of_bvh, mut of_compact) =
            (TraversalCounters::default(), TraversalCounters::default());
        for ray in rays::mixed(&scene, 3, 300) {
            let hit = bvh.closest_hit_with(&ray, &mut of_bvh);
            assert_eq!(compact.closest_hit_with(&ray, &mut of_compact), hit);
            let found = bvh.any_hit_with(&ray, &mut of_bvh);
            assert_eq!(compact.any_hit_with(&ray, &mut of_compact), found);
            let hits = bvh.all_hits_with(&ray, &mut of_bvh);
            assert_eq!(compact.all_hits_with(&ray, &mut of_compact), hits);
        }
        let name = family.name;
        assert_eq!(of_compact.nodes, of_bvh.nodes, "{name}");
        assert_eq!(of_compact.leaves, of_bvh.leaves, "{name}");
        assert_eq!(of_compact.primitive_tests, of_bvh.primitive_tests, "{name}");
        planes[0] += of_bvh.plane_tests.sum;
        planes[1] += of_compact.plane_tests.sum;
    }
    let share = planes[1] as f64 / planes[0] as f64;
    assert!((0.5..0.7).contains(&share), "{planes:?}");
}

#[test]
fn an_inner_node_takes_32_bytes_and_its_leaves_none() {
    let scene = families::find("hairball").unwrap().scene(1, 2000);
    let bvh = BvhBuilder::default().build(&scene).unwrap();
    let compact = CompactBvh::from_bvh(&bvh).unwrap();
    // 52 n + 4 (n + 1) bytes of n inner nodes.
    let inner_nodes = (bvh.node_bytes() - 4) / 56;
    assert_eq!(compact.node_bytes(), 32 * inner_nodes);
    assert_eq!(compact.depth(), bvh.depth());
}

#[test]
fn scenes_of_none_and_one_have_no_nodes() {
    for count in [0, 1] {
        let spheres = vec![Sphere::new([1.0; 3], 2.0); count];
        let bvh = BvhBuilder::default().build(&spheres).unwrap();
        let compact = CompactBvh::from_bvh(&bvh).unwrap();
        compact.validate().unwrap();
        assert_eq!(compact.node_bytes(), 0);
        assert_eq!(compact.bounds(), bvh.bounds());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(50))]

    #[test]
    fn any_scene_and_rays_agree(
        (scene, rays) in strategy::any_case(60, 30),
        leaf_size in 1_usize..10,
        is_swept: bool,
    ) {
        let object_split = if is_swept { ObjectSplit::FullSweep } else { ObjectSplit::default() };
        let bvh = builder(object_split, LeafRule::SahUpTo(leaf_size)).build(&scene.triangles).unwrap();
        let compact = CompactBvh::from_bvh(&bvh).unwrap();
        compact.validate().unwrap();
        let expected = Expected::new(&scene.triangles, rays).unwrap();
        if let Some(first) = expected.disagreements(&compact).first() {
            prop_assert!(false, "{first}");
        }
    }
}
