//! Early split clipping and the edge volume heuristic against brute force.

use accel_core::testing::families;
use accel_core::testing::family_check::{Effort, check_families};
use accel_sbvh::presplit::{EarlySplitClipping, EdgeVolumeHeuristic, Threshold};
use accel_sbvh::{
    AccelerationStructure, BuildError, BvhBuilder, InvalidPrimitives, LeafRule, ObjectSplit,
    ReferenceLimit, Sphere, SurfaceAreaHeuristic, Triangle,
};

const EFFORT: Effort = Effort {
    seeds: 3,
    triangles: 500,
    rays: 150,
    full_size_rays: 0,
};

fn bvh() -> BvhBuilder {
    BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        leaf_rule: LeafRule::StopAt(8),
        invalid_primitives: InvalidPrimitives::Skip,
        ..BvhBuilder::default()
    }
}

fn scene() -> Vec<Triangle> {
    families::find("hairball").unwrap().scene(5, 4000)
}

#[test]
fn both_agree_with_brute_force_on_every_family() {
    let build = |triangles: &[Triangle]| {
        let clipping = EarlySplitClipping {
            threshold: Threshold::Factor(1.6),
            bvh: bvh(),
            ..EarlySplitClipping::default()
        };
        let edges = EdgeVolumeHeuristic {
            threshold: Threshold::Factor(1.6),
            bvh: bvh(),
            ..EdgeVolumeHeuristic::default()
        };
        let built = vec![clipping.build(triangles)?, edges.build(triangles)?];
        for tree in &built {
            tree.validate().unwrap();
        }
        Ok(built)
    };
    let checked = check_families(&EFFORT, build).unwrap_or_else(|error| panic!("{error}"));
    assert!(checked.hits > 10_000, "{checked:?}");
}

#[test]
fn a_threshold_is_found_within_half_a_percent() {
    let triangles = scene();
    for factor in [1.0, 1.1, 1.5, 2.0, 3.0] {
        let threshold = Threshold::Factor(factor);
        let target = triangles.len() as f64 * factor;
        let is_close = |references: usize| (references as f64 - target).abs() <= 0.005 * target;
        let clipping = EarlySplitClipping {
            threshold,
            ..EarlySplitClipping::default()
        };
        let (_, statistics) = clipping.build_with(&triangles, &()).unwrap();
        assert!(is_close(statistics.references), "{factor}: {statistics:?}");
        let edges = EdgeVolumeHeuristic {
            threshold,
            ..EdgeVolumeHeuristic::default()
        };
        let (_, statistics) = edges.build_with(&triangles, &()).unwrap();
        assert!(is_close(statistics.references), "{factor}: {statistics:?}");
        assert!(statistics.references_in_leaves <= statistics.references);
        let again = EdgeVolumeHeuristic {
            threshold: Threshold::Size(statistics.threshold),
            ..EdgeVolumeHeuristic::default()
        };
        assert_eq!(again.build_with(&triangles, &()).unwrap().1, statistics);
    }
}

#[test]
fn a_given_threshold_that_makes_too_many_references_is_refused() {
    let clipping = EarlySplitClipping {
        threshold: Threshold::Size(0.0),
        limit: ReferenceLimit::Factor(2.0),
        ..EarlySplitClipping::default()
    };
    let error = clipping.build(&scene()).unwrap_err();
    assert!(
        matches!(
            error,
            BuildError::BudgetExceeded {
                what: "references",
                limit: 8000,
                ..
            }
        ),
        "{error}"
    );
    let edges = EdgeVolumeHeuristic {
        threshold: Threshold::Factor(f64::NAN),
        ..EdgeVolumeHeuristic::default()
    };
    let error = edges.build(&scene()).unwrap_err();
    assert!(error.to_string().contains("threshold"), "{error}");
}

#[test]
fn duplicates_leave_leaves_only_where_asked() {
    let triangles = families::find("long-diagonals").unwrap().scene(1, 500);
    let bvh = BvhBuilder {
        leaf_rule: LeafRule::StopAt(200),
        ..bvh()
    };
    let references = |remove_duplicates| {
        let clipping = EarlySplitClipping {
            threshold: Threshold::Factor(3.0),
            remove_duplicates,
            bvh,
            ..EarlySplitClipping::default()
        };
        let (tree, statistics) = clipping.build_with(&triangles, &()).unwrap();
        let in_tree = tree
            .tree_statistics(&SurfaceAreaHeuristic::default())
            .references;
        assert_eq!(in_tree, statistics.references_in_leaves);
        (statistics.references, in_tree)
    };
    let (made, kept) = references(false);
    assert_eq!(made, kept);
    let (made, kept) = references(true);
    assert!(kept < made);
}

#[test]
fn empty_scenes_and_spheres_build() {
    let clipping = EarlySplitClipping::default();
    assert_eq!(clipping.build::<Triangle>(&[]).unwrap().bounds(), None);
    let edges = EdgeVolumeHeuristic::default();
    assert_eq!(edges.build::<Triangle>(&[]).unwrap().bounds(), None);
    let spheres = [1.0, 5.0, 0.1].map(|radius| Sphere::new([radius, 0.0, 0.0], radius));
    clipping.build(&spheres).unwrap().validate().unwrap();
}
