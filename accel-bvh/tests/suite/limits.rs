//! Bad settings, bad primitives, budgets, cancelling, empty scenes.

use accel_bvh::{
    AccelerationStructure, BuildBudget, BuildError, BuildObserver, BvhBuilder, InvalidPrimitives,
    LeafRule, ObjectSplit, RaySegment, Reinsertion, SurfaceAreaHeuristic, Triangle,
};
use accel_core::glam::Vec3;

fn row(count: usize) -> Vec<Triangle> {
    (0..count)
        .map(|i| {
            let x = i as f32;
            Triangle::new([x, 0.0, 0.0], [x + 0.5, 0.0, 0.0], [x, 0.5, 0.0])
        })
        .collect()
}

#[test]
fn an_empty_scene_has_a_tree_that_nothing_hits() {
    let bvh = BvhBuilder::default().build::<Triangle>(&[]).unwrap();
    assert_eq!(bvh.bounds(), None);
    assert_eq!(
        bvh.closest_hit(&RaySegment::new([0.0; 3], [1.0, 0.0, 0.0])),
        None
    );
    assert!(bvh.node_words().is_empty());
    bvh.validate().unwrap();
}

#[test]
fn invalid_primitives_are_named_or_skipped_and_others_keep_their_ids() {
    let mut triangles = row(20);
    triangles[7].b.y = f32::NAN;
    triangles[11].c.z = f32::INFINITY;
    let error = BvhBuilder::default().build(&triangles).unwrap_err();
    assert!(
        matches!(error, BuildError::InvalidPrimitive { id: 7, .. }),
        "{error}"
    );
    assert!(error.to_string().contains("primitive 7"), "{error}");

    let builder = BvhBuilder {
        invalid_primitives: InvalidPrimitives::Skip,
        ..BvhBuilder::default()
    };
    let bvh = builder.build(&triangles).unwrap();
    assert_eq!((bvh.skipped_count(), bvh.primitive_count()), (2, 20));
    assert!(bvh.primitive(7).is_none() && bvh.primitive(8).is_some());
    let hit = bvh.closest_hit(&RaySegment::new([12.1, 0.1, -1.0], [0.0, 0.0, 1.0]));
    assert_eq!(hit.map(|hit| hit.id), Some(12));
    bvh.validate().unwrap();

    let nothing_left = builder.build(&triangles[7..8]).unwrap();
    assert_eq!(
        (nothing_left.bounds(), nothing_left.skipped_count()),
        (None, 1)
    );
}

fn improving(reinsertion: Reinsertion) -> BvhBuilder {
    BvhBuilder {
        reinsertion: Some(reinsertion),
        ..BvhBuilder::default()
    }
}

#[test]
fn settings_out_of_range_are_named() {
    let default = BvhBuilder::default();
    let cases = [
        (
            "bins",
            BvhBuilder {
                object_split: ObjectSplit::Binned { bins: 1 },
                ..default
            },
        ),
        (
            "bins",
            BvhBuilder {
                object_split: ObjectSplit::Binned { bins: 65 },
                ..default
            },
        ),
        (
            "leaf_rule",
            BvhBuilder {
                leaf_rule: LeafRule::SahUpTo(0),
                ..default
            },
        ),
        (
            "rounds",
            improving(Reinsertion {
                rounds: 0,
                share: 0.5,
            }),
        ),
        (
            "rounds",
            improving(Reinsertion {
                rounds: 1001,
                share: 0.5,
            }),
        ),
        (
            "share",
            improving(Reinsertion {
                rounds: 1,
                share: 0.0,
            }),
        ),
        (
            "share",
            improving(Reinsertion {
                rounds: 1,
                share: f64::NAN,
            }),
        ),
        (
            "traversal_cost",
            BvhBuilder {
                heuristic: SurfaceAreaHeuristic {
                    traversal_cost: f64::NAN,
                    intersection_cost: 1.0,
                },
                ..default
            },
        ),
        (
            "max_depth",
            BvhBuilder {
                budget: BuildBudget {
                    max_depth: 121,
                    ..BuildBudget::default()
                },
                ..default
            },
        ),
    ];
    for (setting, builder) in cases {
        let error = builder.build(&row(3)).unwrap_err();
        assert!(error.to_string().contains(setting), "{error}");
    }
}

#[test]
fn budgets_hold() {
    let triangles = row(1000);
    for object_split in [ObjectSplit::FullSweep, ObjectSplit::Binned { bins: 16 }] {
        let with = |budget| BvhBuilder {
            object_split,
            budget,
            ..BvhBuilder::default()
        };
        let tight = with(BuildBudget {
            max_bytes: Some(1000),
            ..BuildBudget::default()
        });
        let error = tight.build(&triangles).unwrap_err();
        assert!(
            matches!(error, BuildError::BudgetExceeded { limit: 1000, .. }),
            "{error}"
        );

        let shallow = with(BuildBudget {
            max_depth: 3,
            ..BuildBudget::default()
        });
        let bvh = shallow.build(&triangles).unwrap();
        assert!(bvh.depth() <= 3);
        bvh.validate().unwrap();
        let hit = bvh.closest_hit(&RaySegment::new([700.1, 0.1, -1.0], [0.0, 0.0, 1.0]));
        assert_eq!(hit.map(|hit| hit.id), Some(700));
    }
}

#[test]
fn a_build_can_be_cancelled() {
    struct Stop;
    impl BuildObserver for Stop {
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    let error = BvhBuilder::default()
        .build_with(&row(10_000), &Stop)
        .unwrap_err();
    assert_eq!(error, BuildError::Cancelled);
}

#[test]
fn leaf_rules_give_the_leaves_they_promise() {
    let triangles = row(1000);
    for object_split in [ObjectSplit::FullSweep, ObjectSplit::default()] {
        for (leaf_rule, largest) in [
            (LeafRule::StopAt(8), 8),
            (LeafRule::SahUpTo(4), 4),
            (LeafRule::StopAt(1), 1),
        ] {
            let builder = BvhBuilder {
                object_split,
                leaf_rule,
                ..BvhBuilder::default()
            };
            let statistics = builder
                .build(&triangles)
                .unwrap()
                .tree_statistics(&SurfaceAreaHeuristic::default());
            assert!(
                statistics.leaf_histogram.len() <= largest + 1,
                "{leaf_rule:?} {statistics:?}"
            );
            assert_eq!((statistics.references, statistics.primitives), (1000, 1000));
        }
    }
}

#[test]
fn the_next_ray_starts_off_the_surface_it_leaves() {
    // A closed box around the origin: from inside, a path never gets out and
    // never meets the face that it starts on again.
    let corner =
        |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2 & 1) as f32) * 2e3 + 1e4;
    let faces = [
        [0, 1, 3, 2],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 3, 7, 5],
    ];
    let triangles: Vec<Triangle> = faces
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .map(|corners| Triangle::from(corners.map(corner)))
        .collect();
    let bvh = BvhBuilder::default().build(&triangles).unwrap();
    let mut ray = RaySegment::new([1.1e4, 1.07e4, 1.13e4], [0.3, 0.4, -0.7]);
    for bounce in 0..10_000 {
        let hit = bvh
            .closest_hit(&ray)
            .unwrap_or_else(|| panic!("bounce {bounce} escaped: {ray:?}"));
        let surface = bvh.surface(&ray, &hit).unwrap();
        let along = 2.0 * ray.direction.dot(surface.normal);
        // A mirror whose angle drifts, so that all faces and angles occur.
        let mirrored = ray.direction - surface.normal * along;
        let direction =
            (mirrored + Vec3::new(0.01, -0.007, 0.003) * (bounce % 7) as f32).normalize();
        let inward = if direction.dot(mirrored) > 0.0 {
            direction
        } else {
            mirrored
        };
        let next = RaySegment::new(surface.origin_towards(inward), inward);
        let own = bvh.closest_hit_where(&next, |other| other.id == hit.id);
        let leaves = inward.dot(surface.normal).signum() == mirrored.dot(surface.normal).signum();
        assert!(
            !leaves || own.is_none(),
            "bounce {bounce} met its own surface: {own:?}"
        );
        ray = if leaves {
            next
        } else {
            RaySegment::new(surface.origin_towards(mirrored), mirrored)
        };
    }
}
