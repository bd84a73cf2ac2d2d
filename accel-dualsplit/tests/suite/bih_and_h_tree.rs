//! BIH and H-tree from every kind of source on every scene family, against brute
//! force; what nodes they are made of; the limits of their settings.

use accel_core::testing::agreement::Expected;
use accel_core::testing::family_check::{Checked, Effort, check_families};
use accel_core::testing::{families, strategy};
use accel_dualsplit::{
    AccelerationStructure, Bih, BihConverter, BoundingCosts, BuildError, Bvh, BvhBuilder,
    DualSplitConverter, HTree, HTreeConverter, InvalidPrimitives, LeafRule, ObjectSplit,
    Partitioning, Triangle,
};
use accel_sbvh::SbvhBuilder;
use proptest::prelude::*;

const PART: Effort = Effort {
    seeds: 1,
    triangles: 300,
    rays: 120,
    full_size_rays: 0,
};

fn bvh_builder(object_split: ObjectSplit) -> BvhBuilder {
    BvhBuilder {
        object_split,
        invalid_primitives: InvalidPrimitives::Skip,
        ..BvhBuilder::default()
    }
}

fn bih(bvh: &Bvh<Triangle>) -> Result<Bih<Triangle>, BuildError> {
    let tree = BihConverter::default().convert(bvh)?;
    tree.validate().unwrap_or_else(|error| panic!("{error}"));
    Ok(tree)
}

fn h_tree(bvh: &Bvh<Triangle>) -> Result<HTree<Triangle>, BuildError> {
    let tree = HTreeConverter::default().convert(bvh)?;
    tree.validate().unwrap_or_else(|error| panic!("{error}"));
    Ok(tree)
}

/// Checks both trees of what `source` builds.
fn check(
    effort: &Effort,
    source: impl Fn(&[Triangle]) -> Result<Bvh<Triangle>, BuildError> + Sync,
) {
    let is_checked = |checked: Checked| {
        assert!(
            checked.families >= 40 && checked.hits > 1_500,
            "{checked:?}"
        );
    };
    let of_bih = |triangles: &[Triangle]| Ok(vec![bih(&source(triangles)?)?]);
    is_checked(check_families(effort, of_bih).unwrap_or_else(|error| panic!("BIH: {error}")));
    let of_h_tree = |triangles: &[Triangle]| Ok(vec![h_tree(&source(triangles)?)?]);
    is_checked(check_families(effort, of_h_tree).unwrap_or_else(|error| panic!("H-tree: {error}")));
}

#[test]
fn trees_of_swept_sources_agree_on_every_family() {
    let effort = Effort {
        seeds: 2,
        full_size_rays: 0,
        ..PART
    };
    check(&effort, |triangles| {
        bvh_builder(ObjectSplit::FullSweep).build(triangles)
    });
}

#[test]
fn trees_of_binned_sources_agree_on_every_family() {
    let builder = BvhBuilder {
        leaf_rule: LeafRule::StopAt(1),
        ..bvh_builder(ObjectSplit::default())
    };
    check(&PART, |triangles| builder.build(triangles));
}

#[test]
fn trees_of_sources_with_duplicates_agree_on_every_family() {
    let builder = SbvhBuilder {
        alpha: 0.0,
        invalid_primitives: InvalidPrimitives::Skip,
        ..SbvhBuilder::default()
    };
    check(&PART, |triangles| Ok(builder.build_with(triangles, &())?.0));
}

#[test]
fn a_bih_carves_on_one_axis_and_an_h_tree_on_up_to_three_at_once() {
    let scene = families::find("hairball").unwrap().scene(1, 3000);
    let bvh = BvhBuilder::default().build(&scene).unwrap();
    let (of_bih, of_h_tree) = (
        bih(&bvh).unwrap().node_statistics(),
        h_tree(&bvh).unwrap().node_statistics(),
    );
    assert_eq!((of_bih.dual_axis_carving, of_bih.bounding), (0, 0));
    assert!(of_h_tree.bounding > 0 && of_h_tree.dual_axis_carving == 0);
    assert!(of_h_tree.nodes() < of_bih.nodes());
    assert_eq!(of_h_tree.splitting, of_bih.splitting);
    let identical = DualSplitConverter {
        partitioning: Partitioning::Identical,
        ..DualSplitConverter::default()
    };
    // Every dual-split tree could be written as a BIH, with more nodes.
    let of_dual_split = identical.convert(&bvh).unwrap().node_statistics();
    assert!(of_dual_split.nodes() < of_bih.nodes());
}

#[test]
fn costs_out_of_range_are_typed_errors() {
    let bvh = BvhBuilder::default().build::<Triangle>(&[]).unwrap();
    let is_setting = |error: BuildError, name: &str| matches!(error, BuildError::InvalidSetting { setting, .. } if setting == name);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let converter = BihConverter {
            carving_cost: bad,
            ..BihConverter::default()
        };
        assert!(is_setting(
            converter.convert(&bvh).unwrap_err(),
            "carving_cost"
        ));
        let converter = HTreeConverter {
            bounding_costs: BoundingCosts {
                two_axes: bad,
                ..BoundingCosts::default()
            },
            ..HTreeConverter::default()
        };
        let error = converter.convert(&bvh).unwrap_err();
        assert!(is_setting(error, "bounding_costs.two_axes"));
    }
    assert_eq!(bih(&bvh).unwrap().bounds(), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn any_scene_rays_and_costs_agree(
        (scene, rays) in strategy::any_case(60, 30),
        leaf_size in 1_usize..10,
        carving_cost in prop_oneof![Just(0.3), 1e-3..10.0_f64],
        two_axes in prop_oneof![Just(0.5), 1e-3..10.0_f64],
        three_axes in prop_oneof![Just(0.7), 1e-3..10.0_f64],
    ) {
        let builder = BvhBuilder {
            leaf_rule: LeafRule::SahUpTo(leaf_size),
            ..bvh_builder(ObjectSplit::FullSweep)
        };
        let bvh = builder.build(&scene.triangles).unwrap();
        let bih = BihConverter { carving_cost, ..BihConverter::default() }.convert(&bvh).unwrap();
        bih.validate().unwrap();
        let bounding_costs = BoundingCosts { one_axis: carving_cost, two_axes, three_axes };
        let converter = HTreeConverter { bounding_costs, ..HTreeConverter::default() };
        let h_tree = converter.convert(&bvh).unwrap();
        h_tree.validate().unwrap();
        let expected = Expected::new(&scene.triangles, rays).unwrap();
        if let Some(first) = expected.disagreements(&bih).first() {
            prop_assert!(false, "BIH: {first}");
        }
        if let Some(first) = expected.disagreements(&h_tree).first() {
            prop_assert!(false, "H-tree: {first}");
        }
    }
}
