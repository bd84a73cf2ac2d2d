//! What settings promise: limits, alpha, errors, cancelling, empty scenes.

use accel_core::testing::families;
use accel_sbvh::{
    AccelerationStructure, BuildBudget, BuildError, BuildObserver, BvhBuilder, InvalidPrimitives,
    LeafRule, ObjectSplit, RaySegment, ReferenceLimit, SbvhBuilder, Spending, SurfaceAreaHeuristic,
    Triangle,
};

fn scene(family: &str, count: usize) -> Vec<Triangle> {
    families::find(family).expect(family).scene(3, count)
}

fn sah_cost(builder: &SbvhBuilder, triangles: &[Triangle]) -> f64 {
    let bvh = builder.build(triangles).unwrap();
    bvh.tree_statistics(&SurfaceAreaHeuristic::default())
        .sah_cost
}

#[test]
fn alpha_1_builds_the_plain_bvh_word_for_word() {
    let triangles = scene("long-diagonals", 3000);
    for object_split in [ObjectSplit::FullSweep, ObjectSplit::default()] {
        let plain = BvhBuilder {
            object_split,
            ..BvhBuilder::default()
        };
        let split = SbvhBuilder {
            object_split,
            alpha: 1.0,
            ..SbvhBuilder::default()
        };
        let (bvh, statistics) = split.build_with(&triangles, &()).unwrap();
        assert_eq!(
            bvh.node_words(),
            plain.build(&triangles).unwrap().node_words()
        );
        assert_eq!(statistics.spatial_split_attempts, 0);
        assert_eq!(statistics.reference_percentage(), 100.0);
    }
}

#[test]
fn a_smaller_alpha_attempts_more_and_costs_less() {
    let triangles = scene("long-diagonals", 3000);
    let built = [1e-1, 1e-3, 1e-5, 0.0].map(|alpha| {
        let builder = SbvhBuilder {
            alpha,
            leaf_rule: LeafRule::StopAt(8),
            ..SbvhBuilder::default()
        };
        let (_, statistics) = builder.build_with(&triangles, &()).unwrap();
        (
            statistics.spatial_split_attempts,
            sah_cost(&builder, &triangles),
        )
    });
    for pair in built.windows(2) {
        assert!(pair[0].0 <= pair[1].0, "{built:?}");
        assert!(pair[1].1 < pair[0].1 * 1.01, "{built:?}");
    }
}

#[test]
fn more_references_never_cost_more() {
    for family in ["long-diagonals", "hairball", "skinny-cylinder-rotated"] {
        let triangles = scene(family, 2000);
        let mut last = f64::INFINITY;
        for factor in [1.0, 1.05, 1.1, 1.25, 1.5, 2.0] {
            let builder = SbvhBuilder {
                limit: ReferenceLimit::Factor(factor),
                ..SbvhBuilder::default()
            };
            let cost = sah_cost(&builder, &triangles);
            assert!(
                cost <= last * 1.01,
                "{family} {factor}: {cost} after {last}"
            );
            last = cost;
        }
    }
}

#[test]
fn every_spending_keeps_every_limit_and_gains_by_it() {
    let triangles = scene("skinny-cylinder-rotated", 2000);
    let plain = sah_cost(
        &SbvhBuilder {
            alpha: 1.0,
            ..SbvhBuilder::default()
        },
        &triangles,
    );
    for spending in [
        Spending::ByBenefit,
        Spending::BreadthFirst,
        Spending::Shares,
    ] {
        for factor in [1.05, 1.1, 1.25, 1.5, 2.0] {
            let builder = SbvhBuilder {
                limit: ReferenceLimit::Factor(factor),
                spending,
                ..SbvhBuilder::default()
            };
            let (_, statistics) = builder.build_with(&triangles, &()).unwrap();
            let most = (triangles.len() as f64 * factor) as usize;
            assert!(statistics.references <= most, "{statistics:?}");
            let cost = sah_cost(&builder, &triangles);
            assert!(cost <= plain * 1.001, "{builder:?}: {cost} against {plain}");
            assert!(
                factor < 2.0 || cost < 0.95 * plain,
                "{builder:?}: {cost} against {plain}"
            );
        }
    }
}

#[test]
fn a_limit_in_bytes_bounds_the_tree() {
    let triangles = scene("long-diagonals", 2000);
    for bytes in [200_000, 250_000, 300_000] {
        let builder = SbvhBuilder {
            alpha: 0.0,
            limit: ReferenceLimit::TreeBytes(bytes),
            ..SbvhBuilder::default()
        };
        let bvh = builder.build(&triangles).unwrap();
        let total = bvh
            .tree_statistics(&SurfaceAreaHeuristic::default())
            .references;
        assert!(total > 2000 || bytes == 200_000);
        assert!(
            bvh.bytes().total() <= bytes,
            "{} > {bytes}",
            bvh.bytes().total()
        );
    }
    let builder = SbvhBuilder {
        limit: ReferenceLimit::TreeBytes(199_999),
        ..SbvhBuilder::default()
    };
    let error = builder.build(&triangles).unwrap_err();
    assert!(
        matches!(error, BuildError::BudgetExceeded { limit: 199_999, .. }),
        "{error}"
    );
}

#[test]
fn memory_for_the_build_limits_references_or_refuses() {
    let triangles = scene("long-diagonals", 2000);
    let with = |max_bytes| SbvhBuilder {
        alpha: 0.0,
        budget: BuildBudget {
            max_bytes: Some(max_bytes),
            ..BuildBudget::default()
        },
        ..SbvhBuilder::default()
    };
    let error = with(100_000).build(&triangles).unwrap_err();
    assert!(
        matches!(error, BuildError::BudgetExceeded { limit: 100_000, .. }),
        "{error}"
    );
    let (_, tight) = with(1_000_000).build_with(&triangles, &()).unwrap();
    let (_, ample) = with(100_000_000).build_with(&triangles, &()).unwrap();
    assert!(tight.references < ample.references, "{tight:?} {ample:?}");
}

#[test]
fn settings_out_of_range_are_named() {
    let default = SbvhBuilder::default();
    let cases = [
        (
            "spatial_bins",
            SbvhBuilder {
                spatial_bins: 1,
                ..default
            },
        ),
        (
            "spatial_bins",
            SbvhBuilder {
                spatial_bins: usize::MAX,
                ..default
            },
        ),
        (
            "bins_per_reference",
            SbvhBuilder {
                bins_per_reference: 0,
                ..default
            },
        ),
        (
            "alpha",
            SbvhBuilder {
                alpha: -1e-9,
                ..default
            },
        ),
        (
            "alpha",
            SbvhBuilder {
                alpha: f64::NAN,
                ..default
            },
        ),
        (
            "limit",
            SbvhBuilder {
                limit: ReferenceLimit::Factor(0.5),
                ..default
            },
        ),
        (
            "leaf_rule",
            SbvhBuilder {
                leaf_rule: LeafRule::StopAt(0),
                ..default
            },
        ),
        (
            "bins",
            SbvhBuilder {
                object_split: ObjectSplit::Binned { bins: 65 },
                ..default
            },
        ),
    ];
    for (setting, builder) in cases {
        let error = builder.build(&scene("hairball", 10)).unwrap_err();
        assert!(error.to_string().contains(setting), "{error}");
    }
}

#[test]
fn an_empty_scene_has_a_tree_that_nothing_hits() {
    let (bvh, statistics) = SbvhBuilder::default()
        .build_with::<Triangle>(&[], &())
        .unwrap();
    assert_eq!(bvh.bounds(), None);
    assert_eq!(
        bvh.closest_hit(&RaySegment::new([0.0; 3], [1.0, 0.0, 0.0])),
        None
    );
    assert_eq!(statistics.reference_percentage(), 100.0);
}

#[test]
fn invalid_primitives_are_named_or_skipped() {
    let mut triangles = scene("hairball", 20);
    triangles[7].b.y = f32::NAN;
    let error = SbvhBuilder::default().build(&triangles).unwrap_err();
    assert!(
        matches!(error, BuildError::InvalidPrimitive { id: 7, .. }),
        "{error}"
    );
    let builder = SbvhBuilder {
        invalid_primitives: InvalidPrimitives::Skip,
        ..SbvhBuilder::default()
    };
    let (bvh, statistics) = builder.build_with(&triangles, &()).unwrap();
    assert_eq!((bvh.skipped_count(), bvh.primitive_count()), (1, 20));
    assert_eq!(statistics.primitives, 19);
    assert!(bvh.primitive(7).is_none());
    bvh.validate().unwrap();
}

#[test]
fn depth_is_kept_within_its_limit() {
    let builder = SbvhBuilder {
        alpha: 0.0,
        budget: BuildBudget {
            max_depth: 5,
            ..BuildBudget::default()
        },
        ..SbvhBuilder::default()
    };
    let bvh = builder.build(&scene("hairball", 2000)).unwrap();
    assert!(bvh.depth() <= 5);
    bvh.validate().unwrap();
}

#[test]
fn a_build_can_be_cancelled() {
    struct Stop;
    impl BuildObserver for Stop {
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    let error = SbvhBuilder::default()
        .build_with(&scene("hairball", 1000), &Stop)
        .unwrap_err();
    assert_eq!(error, BuildError::Cancelled);
}

#[test]
fn what_everything_straddles_ends_within_the_limit() {
    // Sheets through one line, boxes that nothing can tell apart, needles.
    for family in ["straddling-book", "straddling-umbrella", "duplicates"] {
        let triangles = scene(family, 20_000);
        for spending in [
            Spending::ByBenefit,
            Spending::BreadthFirst,
            Spending::Shares,
        ] {
            let builder = SbvhBuilder {
                alpha: 0.0,
                spending,
                ..SbvhBuilder::default()
            };
            let (bvh, statistics) = builder.build_with(&triangles, &()).unwrap();
            assert!(
                statistics.references <= 2 * triangles.len(),
                "{statistics:?}"
            );
            bvh.validate().unwrap();
        }
    }
}
