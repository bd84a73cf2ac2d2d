//! Saved trees of every kind come back the same, and damaged ones are refused.

use accel_core::testing::archives::{check_round_trip, load_damaged};
use accel_core::testing::{families, rays};
use accel_dualsplit::{
    AccelerationStructure, Archive, Bih, BihConverter, Bvh, BvhBuilder, DualSplitConverter,
    DualSplitTree, HTree, HTreeConverter, InvalidPrimitives, LeafRule, LoadError, NodeSet,
    Partitioning, PlaneTree, PlaneTreeLoadError, RaySegment, Sphere, TraversalCounters, Triangle,
};

fn scene(family: &str, count: usize) -> Vec<Triangle> {
    families::find(family).expect(family).scene(3, count)
}

fn source(triangles: &[Triangle]) -> Bvh<Triangle> {
    let builder = BvhBuilder {
        invalid_primitives: InvalidPrimitives::Skip,
        leaf_rule: LeafRule::StopAt(2),
        ..BvhBuilder::default()
    };
    builder.build(triangles).unwrap()
}

fn identical(bvh: &Bvh<Triangle>) -> DualSplitTree<Triangle> {
    let converter = DualSplitConverter {
        partitioning: Partitioning::Identical,
        ..DualSplitConverter::default()
    };
    converter.convert(bvh).unwrap()
}

fn check<N: NodeSet>(tree: &PlaneTree<Triangle, N>, triangles: &[Triangle], rays: &[RaySegment]) {
    let loaded = check_round_trip(tree, triangles, rays);
    assert_eq!(loaded.node_words(), tree.node_words());
    assert_eq!(loaded.depth(), tree.depth());
}

#[test]
fn loaded_trees_have_the_same_bytes_and_answers() {
    for family in ["soup-uniform", "nan-mixed", "one-point", "non-finite-all"] {
        let triangles = scene(family, 400);
        let rays = rays::mixed(&triangles, 4, 300);
        let bvh = source(&triangles);
        check(&identical(&bvh), &triangles, &rays);
        let similar = DualSplitConverter::default().convert(&bvh).unwrap();
        check(&similar, &triangles, &rays);
        let bih = BihConverter::default().convert(&bvh).unwrap();
        check(&bih, &triangles, &rays);
        let h_tree = HTreeConverter::default().convert(&bvh).unwrap();
        check(&h_tree, &triangles, &rays);
    }
}

#[test]
fn a_tree_of_another_scene_or_another_kind_is_refused() {
    let triangles = scene("soup-uniform", 100);
    let bytes = identical(&source(&triangles)).to_bytes();
    let error = DualSplitTree::from_bytes(&bytes, &triangles[1..]).unwrap_err();
    let is_scene = |error: &PlaneTreeLoadError| {
        matches!(
            error,
            PlaneTreeLoadError::Archive(LoadError::WrongScene { .. })
        )
    };
    assert!(is_scene(&error), "{error}");
    let error = Bih::<Triangle>::from_bytes(&bytes, &triangles).unwrap_err();
    let is_kind = matches!(
        error,
        PlaneTreeLoadError::Archive(LoadError::WrongKind { .. })
    );
    assert!(is_kind, "{error}");
    let spheres = [Sphere::new([1.0; 3], 2.0)];
    let bvh = BvhBuilder::default().build(&spheres).unwrap();
    let bytes = DualSplitConverter::default()
        .convert(&bvh)
        .unwrap()
        .to_bytes();
    assert!(DualSplitTree::from_bytes(&bytes, &spheres).is_ok());
}

/// What is loaded is validated, so it has the answers of a sound tree.
fn check_damage<N: NodeSet>(tree: &PlaneTree<Triangle, N>, triangles: &[Triangle], count: usize) {
    let rays = rays::mixed(triangles, 4, 4);
    let hits: Vec<_> = rays.iter().map(|ray| tree.closest_hit(ray)).collect();
    let [refused, loaded] = load_damaged(tree, triangles, count, |tree| {
        let mut counters = TraversalCounters::default();
        for (ray, hit) in rays.iter().zip(&hits) {
            assert_eq!(tree.closest_hit_with(ray, &mut counters), *hit);
        }
        assert!(counters.nodes.max as usize <= tree.node_words().len());
    });
    assert!(refused > count / 2 && loaded > 0, "{refused} {loaded}");
}

#[test]
fn random_damage_is_a_typed_error_or_a_tree_with_the_same_hits() {
    let triangles = scene("soup-uniform", 24);
    let bvh = source(&triangles);
    check_damage(&identical(&bvh), &triangles, 100_000);
    let bih = BihConverter::default().convert(&bvh).unwrap();
    check_damage(&bih, &triangles, 100_000);
    let h_tree: HTree<Triangle> = HTreeConverter::default().convert(&bvh).unwrap();
    check_damage(&h_tree, &triangles, 100_000);
}
