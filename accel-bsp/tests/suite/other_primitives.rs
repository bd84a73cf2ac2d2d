//! Primitives other than triangles, against brute force.

use accel_bsp::{
    AccelerationStructure, BspBuilder, Polygonal, Quad, RaySegment, Sphere, TraversalCounters,
    Triangle,
};
use accel_core::BruteForce;
use accel_core::testing::{families, rays};

/// Every variant over `make` of the triangles of a few scenes.
fn check<P: Polygonal>(make: impl Fn(&Triangle) -> P) -> usize {
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

/// The parallelogram that a triangle is half of: flat as far as rounding lets it.
fn parallelogram(triangle: &Triangle) -> Quad {
    let Triangle { a, b, c } = *triangle;
    Quad::new(a, b, c, a + (c - b))
}

#[test]
fn flat_quads_agree_with_brute_force() {
    let hits = check(parallelogram);
    assert!(hits > 1000, "{hits}");
}

#[test]
fn folded_and_crossed_quads_agree_with_brute_force() {
    let folded = |triangle: &Triangle| {
        let quad = parallelogram(triangle);
        let fold = triangle.normal() * triangle.a.distance(triangle.b);
        Quad {
            d: quad.d + 0.3 * fold,
            ..quad
        }
    };
    let crossed = |triangle: &Triangle| {
        let Quad { a, b, c, d } = parallelogram(triangle);
        Quad::new(a, c, b, d)
    };
    let hits = check(folded).min(check(crossed));
    assert!(hits > 1000, "{hits}");
}

#[test]
fn a_wall_of_quads_is_hit_without_tests() {
    let quads: Vec<Quad> = (0..16)
        .map(|index| {
            let [x, y] = [index % 4, index / 4].map(|index| index as f32);
            let corner = |x: f32, y: f32| [x, y, 0.3 * x + 0.2 * y];
            let [right, top] = [x + 1.0, y + 1.0];
            Quad::new(
                corner(x, y),
                corner(right, y),
                corner(right, top),
                corner(x, top),
            )
        })
        .collect();
    let tree = BspBuilder::with_bounded_leaves().build(&quads).unwrap();
    assert!(tree.shape().bounded_leaves >= 16, "{:?}", tree.shape());
    let mut counters = TraversalCounters::default();
    for index in 0..400 {
        let [x, y] = [index % 20, index / 20].map(|index| index as f32 * 0.2 + 0.1);
        let ray = RaySegment::new([x, y, -5.0], [0.0, 0.0, 1.0]);
        let hit = tree
            .closest_hit_unconfirmed_with(&ray, &mut counters)
            .unwrap();
        let expected = tree.closest_hit(&ray).unwrap();
        assert!(hit.id == expected.id && (hit.t - expected.t).abs() < 1e-4);
    }
    assert_eq!(counters.primitive_tests.sum, 0);
}
