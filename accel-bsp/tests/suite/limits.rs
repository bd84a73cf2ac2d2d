//! Settings, budgets, cancelling, empty scenes, determinism.

use std::sync::atomic::{AtomicUsize, Ordering};

use accel_bsp::{
    AccelerationStructure, BspBuilder, BspCosts, BspTree, BuildBudget, BuildError, BuildObserver,
    CandidatePlanes, GeneralPlanes, InvalidPrimitives, RaySegment, Triangle,
};
use accel_core::testing::agreement::oracle;
use accel_core::testing::{families, rays};

fn scene(count: usize) -> Vec<Triangle> {
    let family = families::find("soup-mixed-sizes").expect("the family is there");
    family.scene(7, count)
}

fn node_count(tree: &BspTree<Triangle>) -> usize {
    let shape = tree.shape();
    let leaves: usize = shape.leaves_by_size.iter().skip(1).sum();
    shape.axis_aligned + shape.general + leaves
}

#[test]
fn an_empty_scene_has_a_tree_that_nothing_hits() {
    let tree = BspBuilder::default().build::<Triangle>(&[]).unwrap();
    let ray = RaySegment::new([0.0; 3], [1.0, 0.0, 0.0]);
    assert_eq!((tree.bounds(), tree.closest_hit(&ray)), (None, None));
}

#[test]
fn invalid_primitives_are_named_or_skipped() {
    let mut triangles = scene(50);
    triangles[7].b.y = f32::NAN;
    let error = BspBuilder::default().build(&triangles).unwrap_err();
    assert!(matches!(error, BuildError::InvalidPrimitive { id: 7, .. }));
    let builder = BspBuilder {
        invalid_primitives: InvalidPrimitives::Skip,
        ..BspBuilder::default()
    };
    assert_eq!(builder.build(&triangles).unwrap().skipped_count(), 1);
}

#[test]
fn settings_out_of_range_are_named() {
    let default = BspBuilder::default();
    let with_costs = |costs| BspBuilder { costs, ..default };
    let costs = BspCosts::default();
    let cases = [
        (
            "epsilon",
            BspBuilder {
                epsilon: 0.0,
                ..default
            },
        ),
        (
            "epsilon",
            BspBuilder {
                epsilon: f64::NAN,
                ..default
            },
        ),
        (
            "sampled_primitives",
            BspBuilder {
                sampled_primitives: Some(0),
                ..default
            },
        ),
        (
            "general",
            BspBuilder {
                candidate_planes: CandidatePlanes {
                    general: GeneralPlanes::BelowGain(f64::NAN),
                    ..CandidatePlanes::default()
                },
                ..default
            },
        ),
        (
            "max_nodes",
            BspBuilder {
                max_nodes: Some(0),
                ..default
            },
        ),
        (
            "max_candidates",
            BspBuilder {
                max_candidates: 0,
                ..default
            },
        ),
        (
            "max_duplication",
            BspBuilder {
                max_duplication: -1.0,
                ..default
            },
        ),
        (
            "alpha",
            with_costs(BspCosts {
                alpha: Some(f64::NAN),
                ..costs
            }),
        ),
        (
            "intersection_cost",
            with_costs(BspCosts {
                intersection: 0.0,
                ..costs
            }),
        ),
        (
            "traversal_cost",
            with_costs(BspCosts {
                general: -1.0,
                ..costs
            }),
        ),
    ];
    for (name, builder) in cases {
        let message = builder.build(&scene(10)).unwrap_err().to_string();
        assert!(message.contains(name), "{message}");
    }
}

#[test]
fn budgets_bound_bytes_depth_and_references() {
    let triangles = scene(2000);
    let budget = |max_bytes, max_depth| BspBuilder {
        budget: BuildBudget {
            max_bytes,
            max_depth,
        },
        ..BspBuilder::default()
    };
    let error = budget(Some(1000), 120).build(&triangles).unwrap_err();
    assert!(matches!(
        error,
        BuildError::BudgetExceeded { limit: 1000, .. }
    ));
    assert_eq!(budget(None, 5).build(&triangles).unwrap().depth(), 5);
    for max_duplication in [0.0, 0.5, 2.0] {
        let builder = BspBuilder {
            max_duplication,
            ..BspBuilder::default()
        };
        let tree = builder.build(&triangles).unwrap();
        let references = tree.outline().ids.len();
        let limit = 2000 + (2000.0 * max_duplication) as usize;
        assert!((2000..=limit).contains(&references), "{references}");
    }
}

/// A build that begins ends: what does not fit is not split.
#[test]
fn a_limit_on_bytes_makes_larger_leaves_and_is_an_error_where_nothing_fits() {
    let builders = [
        BspBuilder::default(),
        BspBuilder::original(),
        BspBuilder::with_planar_leaves(),
        BspBuilder::with_bounded_leaves(),
    ];
    for family in [
        "points",
        "sheet-rotated-45",
        "staircase",
        "closed-torus",
        "soup-mixed-sizes",
    ] {
        let triangles = families::find(family).expect(family).scene(5, 600);
        for builder in builders {
            let with = |references: usize| {
                let bytes = builder.working_bytes::<Triangle>(references);
                let budget = BuildBudget {
                    max_bytes: Some(bytes),
                    ..builder.budget
                };
                BspBuilder { budget, ..builder }.build(&triangles)
            };
            let count = triangles.len();
            for references in [count, count + 60, 2 * count] {
                let tree = with(references).unwrap();
                let held = tree.outline().ids.len();
                assert!((count..=references).contains(&held), "{family} {held}");
                assert!(agrees(&tree, &triangles), "{family} {references}");
            }
            let error = with(count - 1).unwrap_err();
            assert!(
                matches!(error, BuildError::BudgetExceeded { .. }),
                "{error}"
            );
        }
    }
}

/// Whether the tree answers as brute force does.
fn agrees(tree: &BspTree<Triangle>, triangles: &[Triangle]) -> bool {
    let oracle = oracle(triangles).unwrap();
    let rays = rays::mixed(triangles, 3, 200);
    let mut rays = rays.iter();
    rays.all(|ray| tree.closest_hit(ray) == oracle.closest_hit(ray))
}

#[test]
fn the_number_of_nodes_is_bounded_by_larger_leaves() {
    let triangles = scene(1000);
    let mut counts = Vec::new();
    for max_nodes in [1, 2, 3, 4, 100, 1001] {
        let builder = BspBuilder {
            max_nodes: Some(max_nodes),
            ..BspBuilder::default()
        };
        let tree = builder.build(&triangles).unwrap();
        let nodes = node_count(&tree);
        assert!(nodes <= max_nodes, "{nodes} of {max_nodes}");
        assert!(agrees(&tree, &triangles), "{max_nodes}");
        counts.push(nodes);
    }
    assert!(
        counts[..4] == [1, 1, 3, 3] && counts[4] > 60 && counts[5] > 600,
        "{counts:?}"
    );
}

#[test]
fn axis_aligned_planes_whose_slack_none_shares_keep_their_own() {
    let builder = BspBuilder {
        candidate_planes: CandidatePlanes {
            general: GeneralPlanes::UpTo(0),
            ..CandidatePlanes::default()
        },
        ..BspBuilder::with_planar_leaves()
    };
    let shape = |triangles: &[Triangle]| {
        let tree = builder.build(triangles).unwrap();
        assert!(agrees(&tree, triangles));
        tree.shape()
    };
    let [soup, stadium] = ["soup-uniform", "figure-in-stadium"].map(|family| {
        let family = families::find(family).expect("the family is there");
        shape(&family.scene(7, 1000))
    });
    // Nothing but slack makes a plane a general one here.
    let counts = [soup, stadium].map(|shape| shape.general);
    assert!(counts[0] == 0 && counts[1] > 20, "{counts:?}");
}

#[test]
fn the_number_of_candidates_is_bounded_by_larger_leaves() {
    let family = families::find("straddling-through-center").unwrap();
    let triangles = family.scene(1, 500);
    let nodes = |max_candidates| {
        let builder = BspBuilder {
            max_candidates,
            ..BspBuilder::default()
        };
        let tree = builder.build(&triangles).unwrap();
        assert!(agrees(&tree, &triangles), "{max_candidates}");
        node_count(&tree)
    };
    let counts = [1, 30, 1000].map(nodes);
    // The root alone has ten planes for each triangle.
    assert!(
        counts[0] <= 3 && counts[0] < counts[1] && counts[1] < counts[2],
        "{counts:?}"
    );
}

/// Watches how often it is asked, and says yes from a certain time on.
struct CancelAfter {
    asked: AtomicUsize,
    limit: usize,
}

impl BuildObserver for CancelAfter {
    fn is_cancelled(&self) -> bool {
        self.asked.fetch_add(1, Ordering::Relaxed) >= self.limit
    }
}

#[test]
fn a_cancelled_build_ends_within_a_node() {
    let exhaustive = BspBuilder {
        sampled_primitives: None,
        candidate_planes: CandidatePlanes::of_the_paper(),
        ..BspBuilder::default()
    };
    let observer = CancelAfter {
        asked: AtomicUsize::new(0),
        limit: 20,
    };
    let result = exhaustive.build_with(&scene(2000), &observer);
    assert_eq!(result.unwrap_err(), BuildError::Cancelled);
    // The search of the root alone would ask more often, and what waits on the stack
    // becomes leaves.
    let asked = observer.asked.into_inner();
    assert!(asked < 20 + BuildBudget::DEEPEST as usize, "{asked}");
}

#[test]
fn no_more_references_are_made_than_allowed() {
    let far = families::find("far-offset").expect("the family is there");
    for (seed, max_duplication) in [(0, 0.0), (2, 0.1), (2, 1.0)] {
        let triangles = far.scene(seed, 200);
        for builder in [BspBuilder::default(), BspBuilder::original()] {
            let tree = BspBuilder {
                max_duplication,
                ..builder
            }
            .build(&triangles)
            .unwrap();
            let references = tree.outline().ids.len();
            let allowed = triangles.len() as f64 * (1.0 + max_duplication);
            assert!(references as f64 <= allowed, "{references} {allowed}");
        }
    }
}

#[test]
fn progress_ends_with_all_references() {
    #[derive(Default)]
    struct Watch(AtomicUsize);
    impl BuildObserver for Watch {
        fn progress(&self, done: usize, total: usize) {
            assert!(done <= total);
            self.0.fetch_max(done, Ordering::Relaxed);
        }
    }
    let watch = Watch::default();
    let tree = BspBuilder::default()
        .build_with(&scene(6000), &watch)
        .unwrap();
    assert_eq!(watch.0.into_inner(), tree.outline().ids.len());
}

#[test]
fn a_build_can_be_cancelled() {
    struct Cancel;
    impl BuildObserver for Cancel {
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    let result = BspBuilder::default().build_with(&scene(100), &Cancel);
    assert_eq!(result.unwrap_err(), BuildError::Cancelled);
}

/// Of a surface, whose nodes are divided on many cores, and of triangles that all overlap,
/// where the planes of one node are weighed on many cores.
#[test]
fn the_tree_does_not_depend_on_the_number_of_threads() {
    let soup = families::find("integer-soup").unwrap().scene(1, 300);
    for (triangles, builder) in [
        (scene(5_000), BspBuilder::default()),
        (soup, BspBuilder::with_planar_leaves()),
    ] {
        let in_pool = |threads| -> BspTree<Triangle> {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| builder.build(&triangles)).unwrap()
        };
        let one = in_pool(1);
        for threads in [2, 5] {
            assert!(one.has_same_nodes(&in_pool(threads)), "{threads} threads");
        }
    }
}
