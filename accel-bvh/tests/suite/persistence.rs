//! Saved trees come back the same, and damaged ones are refused.

use accel_bvh::{
    AccelerationStructure, Archive, Bvh, BvhBuilder, InvalidPrimitives, LeafRule, LoadError,
    Sphere, TraversalCounters, Triangle,
};
use accel_core::testing::archives::{check_round_trip, load_damaged};
use accel_core::testing::{families, rays};

fn scene(family: &str, count: usize) -> Vec<Triangle> {
    families::find(family).expect(family).scene(3, count)
}

fn builder() -> BvhBuilder {
    BvhBuilder {
        invalid_primitives: InvalidPrimitives::Skip,
        ..BvhBuilder::default()
    }
}

#[test]
fn a_loaded_tree_has_the_same_bytes_and_answers() {
    for family in ["soup-uniform", "nan-mixed", "one-point", "non-finite-all"] {
        let triangles = scene(family, 500);
        let bvh = builder().build(&triangles).unwrap();
        let rays = rays::mixed(&triangles, 4, 500);
        let loaded = check_round_trip(&bvh, &triangles, &rays);
        assert_eq!(loaded.node_words(), bvh.node_words(), "{family}");
        assert_eq!(loaded.depth(), bvh.depth());
    }
}

#[test]
fn trees_of_one_leaf_and_of_other_primitives_are_saved_too() {
    for count in [0, 1, 3] {
        let spheres = vec![Sphere::new([1.0; 3], 2.0); count];
        let bvh = builder().build(&spheres).unwrap();
        let loaded = Bvh::from_bytes(&bvh.to_bytes(), &spheres).unwrap();
        assert_eq!(loaded.bounds(), bvh.bounds());
    }
}

#[test]
fn a_tree_of_another_scene_is_refused() {
    let triangles = scene("soup-uniform", 100);
    let bytes = builder().build(&triangles).unwrap().to_bytes();
    let error = Bvh::from_bytes(&bytes, &triangles[1..]).unwrap_err();
    assert!(matches!(error, LoadError::WrongScene { .. }), "{error}");
}

/// What is loaded is validated, so it has the answers of a sound tree.
#[test]
fn random_damage_is_a_typed_error_or_a_tree_with_the_same_hits() {
    let triangles = scene("soup-uniform", 24);
    let builder = BvhBuilder {
        leaf_rule: LeafRule::StopAt(2),
        ..builder()
    };
    let bvh = builder.build(&triangles).unwrap();
    let rays = rays::mixed(&triangles, 4, 4);
    let hits: Vec<_> = rays.iter().map(|ray| bvh.closest_hit(ray)).collect();
    let [refused, loaded] = load_damaged(&bvh, &triangles, 100_000, |tree| {
        let mut counters = TraversalCounters::default();
        for (ray, hit) in rays.iter().zip(&hits) {
            assert_eq!(tree.closest_hit_with(ray, &mut counters), *hit);
        }
        assert!(counters.nodes.max as usize <= tree.node_words().len());
    });
    assert!(refused > 50_000 && loaded > 1_000, "{refused} {loaded}");
}
