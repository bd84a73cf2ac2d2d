//! What the strategies draw, and how far they shrink.

use std::collections::HashSet;

use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use super::super::families;
use super::subset::Subset;
use super::*;

/// Shrinks as proptest does, and returns what is left.
fn shrunk<V: ValueTree>(mut tree: V, fails: impl Fn(&V::Value) -> bool) -> V::Value {
    assert!(fails(&tree.current()));
    while tree.simplify() {
        while !fails(&tree.current()) {
            assert!(tree.complicate());
        }
    }
    tree.current()
}

fn first_failing<S: Strategy>(strategy: &S, fails: impl Fn(&S::Value) -> bool) -> S::Tree {
    let mut runner = TestRunner::deterministic();
    std::iter::repeat_with(|| strategy.new_tree(&mut runner).unwrap())
        .take(10_000)
        .find(|tree| fails(&tree.current()))
        .unwrap()
}

#[test]
fn a_subset_shrinks_to_the_items_that_matter() {
    let mut subset = Subset::of((0..1000).collect());
    let fails = |items: &[i32]| [3, 500, 501, 999].iter().all(|item| items.contains(item));
    while subset.leave_out_more() {
        if !fails(subset.current()) {
            assert!(subset.put_back());
        }
    }
    assert_eq!(subset.current(), [3, 500, 501, 999]);
    assert!(!subset.put_back());
}

#[test]
fn failures_shrink_to_one_ray_and_few_triangles() {
    let strategy = any_case(300, 40);
    let shallow = |ray: &RaySegment| ray.direction.x == 0.0;
    let low = |triangle: &Triangle| triangle.a.z < 0.0;
    let fails = |(scene, rays): &(Scene, Vec<RaySegment>)| {
        let low = scene.triangles.iter().filter(|t| low(t)).count();
        low >= 2 && rays.iter().any(shallow)
    };
    let (scene, rays) = shrunk(first_failing(&strategy, fails), fails);
    assert_eq!((scene.triangles.len(), rays.len()), (2, 1));
    assert!(scene.triangles.iter().all(low) && shallow(&rays[0]));
}

#[test]
fn every_family_is_drawn() {
    let mut runner = TestRunner::deterministic();
    let strategy = any_scene(20);
    let mut drawn = HashSet::new();
    for _ in 0..3000 {
        let scene = strategy.new_tree(&mut runner).unwrap().current();
        assert!(scene.triangles.len() <= 20);
        drawn.insert(scene.family);
    }
    assert_eq!(drawn.len(), families::all().len() + 1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn invalid_triangles_come_from_families_that_say_so(scene in any_scene(50)) {
        let family = families::find(scene.family);
        let may_be_invalid = family.is_some_and(|family| family.has_invalid);
        prop_assert!(may_be_invalid || !scene.has_invalid());
    }

    #[test]
    fn rays_are_finite(
        ray in any_scene(50).prop_flat_map(|scene| any_ray(scene.triangles)),
    ) {
        prop_assert!(ray.origin.is_finite() && ray.direction.is_finite());
    }
}
