//! Primitives other than triangles, against brute force.

use accel_bsp::{AccelerationStructure, BspBuilder, Polygonal, Sphere};
use accel_core::BruteForce;
use accel_core::testing::{families, rays};

/// Every variant over `make` of the triangles of a few scenes.
fn check<P: Polygonal>(make: impl Fn(&accel_bsp::Triangle) -> P) -> usize {
    let variants = [
        BspBuilder::default(),
        BspBuilder::original(),
        BspBuilder::with_planar_leaves(),
        BspBuilder::with_bounded_leaves(),
    ];
    let mut hits = 0;
    for (family, seed) in [
        ("soup-mixed-sizes", 1),
        ("soup-uniform", 2),
        ("staircase-rotated", 3),
    ] {
        let triangles = families::find(family).expect(family).scene(seed, 200);
        let primitives: Vec<P> = triangles.iter().map(&make).collect();
        let oracle = BruteForce::new(&primitives).unwrap();
        let rays = rays::mixed(&triangles, seed, 400);
        for builder in variants {
            let tree = builder.build(&primitives).unwrap();
            for ray in &rays {
                let expected = oracle.all_hits(ray);
                assert_eq!(tree.all_hits(ray), expected, "{family} {ray:?}");
                assert_eq!(tree.closest_hit(ray), expected.first().copied());
                assert_eq!(tree.any_hit(ray), !expected.is_empty());
                hits += usize::from(!expected.is_empty());
            }
        }
    }
    hits
}

#[test]
fn spheres_agree_with_brute_force() {
    let hits = check(|triangle| Sphere::new(triangle.a, 0.5 * triangle.a.distance(triangle.b)));
    assert!(hits > 1000, "{hits}");
}
