//! What trees are like.

use accel_bsp::glam::Vec3;
use accel_bsp::{
    AccelerationStructure, BspBuilder, BspCosts, BspShape, RaySegment, TraversalCounters,
};
use accel_core::testing::families;

fn shape(family: &str, builder: &BspBuilder) -> BspShape {
    let family = families::find(family).expect(family);
    builder.build(&family.scene(1, 5000)).unwrap().shape()
}

/// Table 3 of the paper: triangles of scans are told apart almost all.
#[test]
fn leaves_of_a_scan_hold_one_triangle_and_never_more_than_four() {
    for builder in [
        BspBuilder::with_planar_leaves(),
        BspBuilder::with_bounded_leaves(),
    ] {
        let leaves = shape("closed-bumpy-sphere", &builder).leaves_by_size;
        let filled: usize = leaves[1..].iter().sum();
        assert!(100 * leaves[1] >= 98 * filled, "{leaves:?}");
        assert!(leaves.len() <= 5, "{leaves:?}");
    }
}

/// Planes of triangles in one sheet differ by rounding alone, and what lies between two
/// of them is next to nothing, but rays find the whole sheet there. Leaves of such
/// parts held hundreds of triangles.
#[test]
fn leaves_of_sheets_in_any_direction_hold_few_triangles() {
    let builders = [
        BspBuilder::default(),
        BspBuilder::original(),
        BspBuilder::with_planar_leaves(),
    ];
    for family in [
        "sheet-rotated",
        "sheet-rotated-45",
        "circle-rotated-45",
        "closed-room-of-strips",
        "staircase-rotated",
    ] {
        let triangles = families::find(family).expect(family).scene(3, 2000);
        for builder in builders {
            let tree = builder.build(&triangles).unwrap();
            let leaves = tree.shape().leaves_by_size;
            assert!(leaves.len() <= 9, "{family} {builder:?} {leaves:?}");
            let mut counters = TraversalCounters::default();
            for triangle in &triangles {
                let centroid = (triangle.a + triangle.b + triangle.c) / 3.0;
                let towards = Vec3::new(0.3, -0.8, 0.5);
                let ray = RaySegment::new(centroid - towards, towards);
                tree.closest_hit_with(&ray, &mut counters);
            }
            let tests = counters.mean(&counters.primitive_tests);
            assert!(tests < 6.0, "{family} {builder:?} {tests} tests a ray");
        }
    }
}

#[test]
fn the_cost_of_a_lone_leaf_and_of_a_split_are_those_worked_out_by_hand() {
    let triangle = |x: f32| {
        let corners = [[x, 0.0, 0.0], [x + 1.0, 1.0, 0.0], [x, 0.0, 1.0]];
        accel_bsp::Triangle::new(corners[0], corners[1], corners[2])
    };
    let costs = BspCosts {
        intersection: 4.0,
        ..BspCosts::default()
    };
    let lone = BspBuilder {
        costs,
        max_duplication: 0.0,
        ..BspBuilder::default()
    };
    let cost = |count: usize, depth: u32| {
        let triangles: Vec<_> = (0..count)
            .map(|index| triangle(3.0 * index as f32))
            .collect();
        let mut builder = lone;
        builder.budget.max_depth = depth;
        let tree = builder.build(&triangles).unwrap();
        tree.surface_area_cost(&costs).unwrap()
    };
    assert_eq!(cost(1, 0), costs.intersection);
    // The box is 4 by 1 by 1 and the plane at 1 or 3 leaves an empty part, or cuts
    // one triangle off.
    let split = cost(2, 1);
    let cut_off = [1.0_f64, 3.0].map(|x| {
        let area = |length: f64| 2.0 * (2.0 * length + 1.0);
        costs.axis_aligned + costs.intersection * (area(x) + area(4.0 - x)) / area(4.0)
    });
    assert!(
        cut_off.iter().any(|cost| (cost - split).abs() < 1e-4),
        "{split} {cut_off:?}"
    );
}
