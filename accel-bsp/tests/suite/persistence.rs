//! Saved trees come back the same, and damaged ones are refused.

use accel_bsp::{
    AccelerationStructure, Archive, BspBuilder, BspTree, InvalidPrimitives, LoadError, Primitive,
    Triangle,
};
use accel_core::testing::archives::{check_round_trip, load_damaged};
use accel_core::testing::{families, rays};

fn scene(family: &str, count: usize) -> Vec<Triangle> {
    families::find(family).expect(family).scene(3, count)
}

fn builder() -> BspBuilder {
    BspBuilder {
        invalid_primitives: InvalidPrimitives::Skip,
        ..BspBuilder::with_planar_leaves()
    }
}

#[test]
fn a_loaded_tree_has_the_same_bytes_and_answers() {
    for family in ["soup-uniform", "nan-mixed", "one-point", "non-finite-all"] {
        let triangles = scene(family, 300);
        let tree = builder().build(&triangles).unwrap();
        let rays = rays::mixed(&triangles, 4, 500);
        let loaded = check_round_trip(&tree, &triangles, &rays);
        assert_eq!(loaded.depth(), tree.depth(), "{family}");
    }
}

#[test]
fn marked_leaves_are_saved_too() {
    let triangles = scene("closed-icosphere", 300);
    let tree = BspBuilder::with_bounded_leaves().build(&triangles).unwrap();
    assert!(tree.shape().bounded_leaves > 0);
    let rays = rays::mixed(&triangles, 4, 500);
    let loaded = check_round_trip(&tree, &triangles, &rays);
    for ray in &rays {
        let hit = tree.closest_hit_unconfirmed(ray);
        assert_eq!(loaded.closest_hit_unconfirmed(ray), hit, "{ray:?}");
    }
}

#[test]
fn a_tree_of_another_scene_is_refused() {
    let triangles = scene("soup-uniform", 100);
    let bytes = builder().build(&triangles).unwrap().to_bytes();
    let error = BspTree::from_bytes(&bytes, &triangles[1..]).unwrap_err();
    assert!(matches!(error, LoadError::WrongScene { .. }), "{error}");
}

#[test]
fn random_damage_is_a_typed_error_or_a_tree_that_still_answers() {
    let triangles = scene("soup-uniform", 24);
    let tree = builder().build(&triangles).unwrap();
    let rays = rays::mixed(&triangles, 4, 4);
    let [refused, loaded] = load_damaged(&tree, &triangles, 100_000, |tree| {
        let bounds = tree.bounds().expect("no primitive is lost");
        let mut boxes = triangles.iter().map(Triangle::bounds);
        assert!(
            boxes.all(|triangle| bounds.contains(&triangle)),
            "{bounds:?}"
        );
        for ray in &rays {
            tree.closest_hit(ray);
            tree.all_hits(ray);
        }
    });
    assert!(refused > 25_000 && loaded > 0, "{refused} {loaded}");
}
