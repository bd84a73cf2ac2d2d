//! Saved trees come back the same, and damaged ones are refused.

use accel_core::archive::{ArchiveWriter, bounds_of_scene, scene_of_slice};
use accel_core::testing::archives::{check_round_trip, load_damaged};
use accel_core::testing::{families, rays};
use accel_kdtree::{
    AccelerationStructure, Archive, InvalidPrimitives, KdTree, KdTreeBuilder, LoadError, Sphere,
    TraversalCounters, Triangle,
};

fn scene(family: &str, count: usize) -> Vec<Triangle> {
    families::find(family).expect(family).scene(3, count)
}

fn builder() -> KdTreeBuilder {
    KdTreeBuilder {
        invalid_primitives: InvalidPrimitives::Skip,
        ..KdTreeBuilder::default()
    }
}

#[test]
fn a_loaded_tree_has_the_same_bytes_and_answers() {
    for family in [
        "soup-uniform",
        "nan-mixed",
        "one-point",
        "figure-in-stadium",
        "anisotropic",
        "non-finite-all",
    ] {
        let triangles = scene(family, 500);
        let tree = builder().build(&triangles).unwrap();
        let rays = rays::mixed_near_and_far(&triangles, 4, 500);
        let loaded = check_round_trip(&tree, &triangles, &rays);
        assert_eq!(loaded.node_words(), tree.node_words(), "{family}");
        assert_eq!(loaded.depth(), tree.depth());
    }
    let spheres = [Sphere::new([1.0; 3], 2.0), Sphere::new([4.0; 3], 1.0)];
    let tree = builder().build(&spheres).unwrap();
    check_round_trip(&tree, &spheres, &[]);
}

#[test]
fn a_tree_of_another_scene_is_refused() {
    let triangles = scene("soup-uniform", 100);
    let bytes = builder().build(&triangles).unwrap().to_bytes();
    let error = KdTree::from_bytes(&bytes, &triangles[1..]).unwrap_err();
    assert!(matches!(error, LoadError::WrongScene { .. }), "{error}");
}

#[test]
fn nodes_over_nothing_are_refused() {
    let scene = scene_of_slice::<Triangle, _>(&[], bounds_of_scene);
    let mut archive = ArchiveWriter::new(*b"accelkdt", 1, scene);
    archive.push(0);
    let empty_leaf = u32::MAX - 3;
    [1, empty_leaf, 0]
        .into_iter()
        .for_each(|word| archive.push(word));
    let error = KdTree::<Triangle>::from_bytes(&archive.finish(), &[]).unwrap_err();
    assert!(error.to_string().contains("nodes over nothing"), "{error}");
}

#[test]
fn random_damage_is_a_typed_error_or_a_tree_that_still_answers() {
    let triangles = scene("soup-uniform", 24);
    let tree = builder().build(&triangles).unwrap();
    let rays = rays::mixed(&triangles, 4, 4);
    let [refused, loaded] = load_damaged(&tree, &triangles, 100_000, |loaded| {
        assert_eq!(loaded.bounds(), tree.bounds());
        let mut counters = TraversalCounters::default();
        for ray in &rays {
            loaded.closest_hit_with(ray, &mut counters);
            loaded.all_hits(ray);
        }
        assert!(counters.nodes.max as usize <= loaded.node_words().len());
    });
    assert!(refused > 25_000 && loaded > 1_000, "{refused} {loaded}");
}
