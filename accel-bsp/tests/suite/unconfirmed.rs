//! BSP-tri as in the paper: hits that the traversal finds.

use accel_bsp::glam::Vec3;
use accel_bsp::{
    AccelerationStructure, BspBuilder, BspTree, Hit, RaySegment, TraversalCounters, Triangle,
    UnconfirmedHit,
};
use accel_core::testing::families;

fn scene(family: &str, count: usize) -> Vec<Triangle> {
    families::find(family).expect(family).scene(3, count)
}

#[test]
fn a_lone_triangle_is_hit_without_a_test() {
    let triangle = Triangle::new([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let tree = BspBuilder::with_bounded_leaves()
        .build(&[triangle])
        .unwrap();
    assert!(tree.shape().bounded_leaves > 0, "{:?}", tree.shape());
    let mut counters = TraversalCounters::default();
    for (x, y) in [(0.25, 0.25), (0.1, 0.7), (0.6, 0.1), (0.9, 0.9), (0.6, 0.6)] {
        let ray = RaySegment::new([x, y, -3.0], [0.0, 0.0, 1.0]);
        let unconfirmed = tree.closest_hit_unconfirmed_with(&ray, &mut counters);
        let expected = tree.closest_hit(&ray);
        assert_eq!(unconfirmed.is_some(), expected.is_some(), "{ray:?}");
        if let (Some(unconfirmed), Some(expected)) = (unconfirmed, expected) {
            assert!((unconfirmed.t - expected.t).abs() < 1e-5);
        }
    }
    assert_eq!(counters.primitive_tests.sum, 0);
}

/// Rays of a camera on a sphere around the scene, in a grid.
fn camera_rays(tree: &BspTree<Triangle>, side: usize) -> Vec<RaySegment> {
    let bounds = tree.bounds().expect("the scene is not empty");
    let (center, extent) = (bounds.center(), bounds.largest_extent() as f32);
    let eye = center + Vec3::new(1.1, 0.7, 0.9).normalize() * 2.0 * extent;
    let right = (center - eye).cross(Vec3::Y).normalize();
    let up = right.cross(center - eye).normalize();
    let offset = |index: usize| (index as f32 + 0.37) / side as f32 - 0.5;
    let pixels = (0..side * side).map(|pixel| [pixel % side, pixel / side].map(offset));
    let towards = |[x, y]: [f32; 2]| center + extent * (x * right + y * up) - eye;
    pixels
        .map(|pixel| RaySegment::new(eye, towards(pixel)))
        .collect()
}

/// Whether both name the same primitive at the same place.
fn is_same(hit: Option<UnconfirmedHit>, expected: Option<Hit>) -> bool {
    match (hit, expected) {
        (Some(hit), Some(expected)) => {
            hit.id == expected.id && (hit.t - expected.t).abs() <= 1e-5 * expected.t
        }
        (hit, expected) => hit.is_none() && expected.is_none(),
    }
}

#[test]
fn most_tests_are_saved_and_no_answer_of_a_camera_differs() {
    // Of the tests that the kernel makes, how many percent may be left.
    for (family, left) in [("closed-icosphere", 20), ("closed-torus", 25)] {
        let triangles = scene(family, 1000);
        let tree = BspBuilder::with_bounded_leaves().build(&triangles).unwrap();
        let [mut confirmed, mut unconfirmed] = [TraversalCounters::default(); 2];
        let mut hits = 0;
        for ray in camera_rays(&tree, 100) {
            let expected = tree.closest_hit_with(&ray, &mut confirmed);
            let hit = tree.closest_hit_unconfirmed_with(&ray, &mut unconfirmed);
            assert!(is_same(hit, expected), "{family}: {hit:?} {expected:?}");
            hits += usize::from(expected.is_some());
        }
        let tests = [confirmed, unconfirmed].map(|counters| counters.primitive_tests.sum);
        assert!(
            hits > 5000 && 100 * tests[1] < left * tests[0],
            "{family}: {hits} {tests:?}"
        );
    }
}

#[test]
fn without_marked_leaves_every_hit_is_the_kernels() {
    let triangles = scene("hairball", 1000);
    let tree = BspBuilder::default().build(&triangles).unwrap();
    for ray in camera_rays(&tree, 60) {
        let hit = tree.closest_hit_unconfirmed(&ray);
        let expected = tree.closest_hit(&ray);
        let pair = |hit: Hit| (hit.t, hit.id);
        assert_eq!(hit.map(|hit| (hit.t, hit.id)), expected.map(pair));
    }
}
