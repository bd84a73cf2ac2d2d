//! Settings, budgets, cancelling, empty scenes, primitives of all kinds.

use accel_core::testing::families;
use accel_kdtree::{
    AccelerationStructure, BuildBudget, BuildError, BuildObserver, InvalidPrimitives,
    KdTreeBuilder, PlaneSearch, RaySegment, Sphere, SurfaceAreaHeuristic, Termination, Triangle,
    Work,
};

fn scene(count: usize) -> Vec<Triangle> {
    let family = families::find("soup-mixed-sizes").expect("the family is there");
    family.scene(7, count)
}

fn searches() -> [KdTreeBuilder; 2] {
    let binned = PlaneSearch::Binned {
        bins: 32,
        exact_below: 100,
    };
    [PlaneSearch::Sweep, binned].map(|search| KdTreeBuilder {
        search,
        ..KdTreeBuilder::default()
    })
}

#[test]
fn an_empty_scene_has_a_tree_that_nothing_hits() {
    let tree = KdTreeBuilder::default().build::<Triangle>(&[]).unwrap();
    let ray = RaySegment::new([0.0; 3], [1.0, 0.0, 0.0]);
    assert_eq!((tree.bounds(), tree.closest_hit(&ray)), (None, None));
    assert_eq!((tree.depth(), tree.node_bytes()), (0, 0));
    tree.validate().unwrap();
}

#[test]
fn invalid_primitives_are_named_or_skipped() {
    let mut triangles = scene(300);
    triangles[7].b.y = f32::NAN;
    for builder in searches() {
        let error = builder.build(&triangles).unwrap_err();
        assert!(matches!(error, BuildError::InvalidPrimitive { id: 7, .. }));
        let builder = KdTreeBuilder {
            invalid_primitives: InvalidPrimitives::Skip,
            ..builder
        };
        let tree = builder.build(&triangles).unwrap();
        assert_eq!(tree.skipped_count(), 1);
        assert!(tree.primitive(7).is_none() && tree.primitive(8).is_some());
        tree.validate().unwrap();
    }
}

#[test]
fn settings_out_of_range_are_named() {
    let default = KdTreeBuilder::default();
    let binned = |bins| KdTreeBuilder {
        search: PlaneSearch::Binned {
            bins,
            exact_below: 0,
        },
        ..default
    };
    let bonus = |empty_bonus| KdTreeBuilder {
        empty_bonus,
        ..default
    };
    let duplication = |max_duplication| KdTreeBuilder {
        max_duplication,
        ..default
    };
    let costs = |traversal_cost, intersection_cost| KdTreeBuilder {
        heuristic: SurfaceAreaHeuristic {
            traversal_cost,
            intersection_cost,
        },
        ..default
    };
    let refines = KdTreeBuilder {
        termination: Termination::BadRefines { allowed: 0 },
        ..default
    };
    let deep = KdTreeBuilder {
        budget: BuildBudget {
            max_depth: 121,
            ..BuildBudget::default()
        },
        ..default
    };
    let cases = [
        ("bins", binned(1)),
        ("bins", binned(257)),
        ("empty_bonus", bonus(1.0)),
        ("empty_bonus", bonus(f64::NAN)),
        ("max_duplication", duplication(-0.1)),
        ("max_duplication", duplication(f64::INFINITY)),
        ("traversal_cost", costs(f64::NAN, 1.0)),
        ("intersection_cost", costs(1.0, 0.0)),
        ("allowed", refines),
        ("max_depth", deep),
    ];
    for (name, builder) in cases {
        let message = builder.build(&scene(10)).unwrap_err().to_string();
        assert!(message.contains(&format!("`{name}`")), "{message}");
    }
}

#[test]
fn budgets_on_bytes_depth_and_references_hold() {
    let triangles = scene(2000);
    for builder in searches() {
        let with_budget = |max_bytes, max_depth| KdTreeBuilder {
            budget: BuildBudget {
                max_bytes,
                max_depth,
            },
            ..builder
        };
        let error = with_budget(Some(1000), 120).build(&triangles).unwrap_err();
        assert!(matches!(
            error,
            BuildError::BudgetExceeded { limit: 1000, .. }
        ));
        let shallow = with_budget(None, 5).build(&triangles).unwrap();
        assert_eq!(shallow.depth(), 5);
        shallow.validate().unwrap();
        // Bytes for half as many references again make a tree of no more.
        let bytes = builder.working_bytes(3000);
        let tree = with_budget(Some(bytes), 120).build(&triangles).unwrap();
        assert!((2001..=3000).contains(&tree.outline().ids.len()));
        for max_duplication in [0.0, 0.5, 2.0] {
            let builder = KdTreeBuilder {
                max_duplication,
                ..builder
            };
            let tree = builder.build(&triangles).unwrap();
            let references = tree.outline().ids.len();
            let limit = 2000 + (2000.0 * max_duplication) as usize;
            assert!((2000..=limit).contains(&references), "{references}");
            tree.validate().unwrap();
        }
    }
}

#[test]
fn references_created_are_those_that_the_tree_holds() {
    for builder in searches() {
        let (tree, work) = builder.build_counting(&scene(2000), &()).unwrap();
        let references = tree.outline().ids.len() as u64;
        assert_eq!(work.references_created, references - 2000);
        assert!(work.comparisons > references, "{work:?}");
        assert_ne!(work, Work::default());
    }
}

#[test]
fn manual_termination_goes_down_to_the_leaf_size_it_names() {
    // Apart from each other, so that planes can tell all of them apart.
    let triangles: Vec<Triangle> = (0..500)
        .map(|i| {
            let x = 3.0 * i as f32;
            Triangle::new([x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 0.0])
        })
        .collect();
    for max_leaf_size in [1, 3] {
        let builder = KdTreeBuilder {
            termination: Termination::Manual { max_leaf_size },
            ..KdTreeBuilder::default()
        };
        let tree = builder.build(&triangles).unwrap();
        let histogram = tree.tree_statistics(&builder.heuristic).leaf_histogram;
        assert!(histogram.len() <= max_leaf_size + 1, "{histogram:?}");
    }
}

#[test]
fn a_build_can_be_cancelled() {
    struct Cancel;
    impl BuildObserver for Cancel {
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    for builder in searches() {
        let result = builder.build_with(&scene(100), &Cancel);
        assert_eq!(result.unwrap_err(), BuildError::Cancelled);
    }
}

#[test]
fn primitives_that_only_have_boxes_are_split_by_them() {
    let spheres: Vec<Sphere> = (0..200)
        .map(|i| {
            let place = [(i % 7) as f32, (i % 11) as f32, (i % 13) as f32];
            Sphere::new(place, 0.4 + (i % 5) as f32 * 0.2)
        })
        .collect();
    let oracle = accel_core::BruteForce::new(&spheres).unwrap();
    for builder in searches() {
        let tree = builder.build(&spheres).unwrap();
        tree.validate().unwrap();
        for i in 0..2000 {
            let direction = [(i % 17) as f32 - 8.0, (i % 19) as f32 - 9.0, 7.3];
            let ray = RaySegment::new([3.0, 5.0, -9.0], direction);
            assert_eq!(tree.all_hits(&ray), oracle.all_hits(&ray));
        }
    }
}

#[test]
fn clipping_makes_trees_cheaper() {
    let triangles = families::find("hairball").unwrap().scene(1, 5000);
    let costs = [true, false].map(|clips_primitives| {
        let builder = KdTreeBuilder {
            clips_primitives,
            ..KdTreeBuilder::default()
        };
        let tree = builder.build(&triangles).unwrap();
        tree.tree_statistics(&builder.heuristic).sah_cost
    });
    assert!(costs[0] < 0.95 * costs[1], "{costs:?}");
}
