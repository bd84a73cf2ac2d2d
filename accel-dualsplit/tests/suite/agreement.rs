//! Every setting and every kind of source on every scene family, against brute
//! force.

use accel_core::BruteForce;
use accel_core::testing::agreement::Expected;
use accel_core::testing::family_check::{Checked, Effort, check_families};
use accel_core::testing::packets::{check_packets, ray_sets};
use accel_core::testing::{families, rays, strategy};
use accel_dualsplit::{
    AccelerationStructure, BihConverter, BuildError, Bvh, BvhBuilder, CarvingCosts,
    DualSplitBuilder, DualSplitConverter, DualSplitTree, HTreeConverter, InvalidPrimitives,
    LeafRule, ObjectSplit, Partitioning, Sphere, Triangle, WideDualSplitTree,
};
use accel_sbvh::SbvhBuilder;
use proptest::prelude::*;

/// Enough for a source that shares its conversion with one that is checked in
/// full.
const PART: Effort = Effort {
    seeds: 1,
    triangles: 400,
    rays: 150,
    full_size_rays: 0,
};

const BOTH: [Partitioning; 2] = [Partitioning::Identical, Partitioning::Similar];

type Trees = Result<Vec<DualSplitTree<Triangle>>, BuildError>;

/// Checks the trees that `build` makes on every family, and that each is valid.
fn check(effort: &Effort, build: &(dyn Fn(&[Triangle]) -> Trees + Sync)) -> Checked {
    let build = |triangles: &[Triangle]| {
        let trees = build(triangles)?;
        for tree in &trees {
            tree.validate().unwrap_or_else(|error| panic!("{error}"));
        }
        Ok::<_, BuildError>(trees)
    };
    check_families(effort, build).unwrap_or_else(|error| panic!("{error}"))
}

/// The trees of both partitionings.
fn convert(bvh: &Bvh<Triangle>) -> Trees {
    let trees = BOTH.iter().map(|&partitioning| {
        let converter = DualSplitConverter {
            partitioning,
            ..DualSplitConverter::default()
        };
        converter.convert(bvh)
    });
    trees.collect()
}

fn bvh_builder(object_split: ObjectSplit) -> BvhBuilder {
    BvhBuilder {
        object_split,
        invalid_primitives: InvalidPrimitives::Skip,
        ..BvhBuilder::default()
    }
}

#[test]
fn both_partitionings_agree_with_brute_force_on_every_family() {
    let effort = Effort {
        seeds: 2,
        ..Effort::default()
    };
    let builder = bvh_builder(ObjectSplit::FullSweep);
    let checked = check(&effort, &|triangles| convert(&builder.build(triangles)?));
    assert!(checked.families >= 40, "{checked:?}");
    assert!(checked.hits > 10_000, "{checked:?}");
}

#[test]
fn trees_of_binned_sources_agree_on_every_family() {
    let builder = BvhBuilder {
        leaf_rule: LeafRule::StopAt(1),
        ..bvh_builder(ObjectSplit::default())
    };
    let checked = check(&PART, &|triangles| convert(&builder.build(triangles)?));
    assert!(checked.hits > 2_000, "{checked:?}");
}

#[test]
fn trees_of_sources_with_duplicates_agree_on_every_family() {
    let builder = SbvhBuilder {
        alpha: 0.0,
        invalid_primitives: InvalidPrimitives::Skip,
        ..SbvhBuilder::default()
    };
    let checked = check(&PART, &|triangles| {
        convert(&builder.build_with(triangles, &())?.0)
    });
    assert!(checked.hits > 2_000, "{checked:?}");
}

#[test]
fn directly_built_trees_agree_on_every_family() {
    let builder = DualSplitBuilder {
        invalid_primitives: InvalidPrimitives::Skip,
        ..DualSplitBuilder::default()
    };
    let effort = Effort { seeds: 2, ..PART };
    let checked = check(&effort, &|triangles| Ok(vec![builder.build(triangles)?]));
    assert!(
        checked.families >= 40 && checked.hits > 4_000,
        "{checked:?}"
    );
}

#[test]
fn wide_trees_agree_on_every_family() {
    let effort = Effort { seeds: 2, ..PART };
    let builder = bvh_builder(ObjectSplit::FullSweep);
    let split = SbvhBuilder {
        alpha: 0.0,
        invalid_primitives: InvalidPrimitives::Skip,
        ..SbvhBuilder::default()
    };
    let build = |triangles: &[Triangle]| {
        let bvhs = [
            builder.build(triangles)?,
            split.build_with(triangles, &())?.0,
        ];
        let trees = bvhs.iter().map(WideDualSplitTree::from_bvh);
        let trees = trees.collect::<Result<Vec<_>, _>>()?;
        for tree in &trees {
            tree.validate().unwrap_or_else(|error| panic!("{error}"));
        }
        Ok::<_, BuildError>(trees)
    };
    let checked = check_families(&effort, build).unwrap_or_else(|error| panic!("{error}"));
    assert!(
        checked.families >= 40 && checked.hits > 4_000,
        "{checked:?}"
    );
}

#[test]
fn packets_of_every_width_agree_on_every_family() {
    let builder = bvh_builder(ObjectSplit::FullSweep);
    let mut hits = 0;
    for (index, family) in families::all().iter().enumerate() {
        let scene = family.scene(5, 200);
        let bvh = builder.build(&scene).unwrap();
        for (set, rays) in ray_sets(&scene, 6) {
            let expected = Expected::new(&scene, rays).unwrap();
            hits += expected.hits();
            // All kinds of nodes, in turns.
            let checked = match index % 3 {
                0 => check_packets(&BihConverter::default().convert(&bvh).unwrap(), &expected),
                1 => check_packets(&HTreeConverter::default().convert(&bvh).unwrap(), &expected),
                _ => Ok(()),
            };
            let similar = DualSplitConverter::default().convert(&bvh).unwrap();
            checked
                .and_then(|()| check_packets(&similar, &expected))
                .unwrap_or_else(|error| panic!("{}, {set}: {error}", family.name));
        }
    }
    assert!(hits > 5_000, "{hits}");
}

#[test]
fn spheres_agree_with_brute_force() {
    for seed in 0..5 {
        let boxes = families::find("soup-mixed-sizes").unwrap().scene(seed, 400);
        let spheres: Vec<Sphere> = boxes
            .iter()
            .map(|triangle| Sphere::new(triangle.a, triangle.a.distance(triangle.b)))
            .collect();
        let oracle = BruteForce::new(&spheres).unwrap();
        let bvh = BvhBuilder::default().build(&spheres).unwrap();
        let wide = WideDualSplitTree::from_bvh(&bvh).unwrap();
        for ray in rays::mixed(&boxes, seed, 400) {
            assert_eq!(wide.closest_hit(&ray), oracle.closest_hit(&ray), "{ray:?}");
        }
        for partitioning in BOTH {
            let converter = DualSplitConverter {
                partitioning,
                ..DualSplitConverter::default()
            };
            let tree = converter.convert(&bvh).unwrap();
            tree.validate().unwrap();
            for ray in rays::mixed(&boxes, seed, 400) {
                assert_eq!(tree.closest_hit(&ray), oracle.closest_hit(&ray), "{ray:?}");
                assert_eq!(tree.any_hit(&ray), oracle.any_hit(&ray), "{ray:?}");
                assert_eq!(tree.all_hits(&ray), oracle.all_hits(&ray), "{ray:?}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn any_scene_rays_and_costs_agree(
        (scene, rays) in strategy::any_case(60, 30),
        leaf_size in 1_usize..10,
        is_identical: bool,
        single_axis in prop_oneof![Just(0.3), 1e-3..10.0_f64],
        dual_axis in prop_oneof![Just(0.5), 1e-3..10.0_f64],
    ) {
        let builder = BvhBuilder {
            leaf_rule: LeafRule::SahUpTo(leaf_size),
            ..bvh_builder(ObjectSplit::FullSweep)
        };
        let bvh = builder.build(&scene.triangles).unwrap();
        let converter = DualSplitConverter {
            partitioning: if is_identical { Partitioning::Identical } else { Partitioning::Similar },
            carving_costs: CarvingCosts { single_axis, dual_axis },
            ..DualSplitConverter::default()
        };
        let tree = converter.convert(&bvh).unwrap();
        tree.validate().unwrap();
        let expected = Expected::new(&scene.triangles, rays).unwrap();
        if let Some(first) = expected.disagreements(&tree).first() {
            prop_assert!(false, "{first}");
        }
        let wide = WideDualSplitTree::from_bvh(&bvh).unwrap();
        if let Some(first) = expected.disagreements(&wide).first() {
            prop_assert!(false, "wide: {first}");
        }
    }
}
