//! Moving nodes makes trees better, keeps limits, and takes bounded time.

use accel_bvh::{
    AccelerationStructure, BuildBudget, BuildError, BuildObserver, Bvh, BvhBuilder,
    InvalidPrimitives, LeafRule, ObjectSplit, Reinsertion, SurfaceAreaHeuristic, Triangle,
};
use accel_core::statistics::TreeStatistics;
use accel_core::testing::families;

fn sah_cost(bvh: &Bvh<Triangle>) -> f64 {
    TreeStatistics::of(&bvh.outline(), &SurfaceAreaHeuristic::default()).sah_cost
}

fn builder(reinsertion: Option<Reinsertion>) -> BvhBuilder {
    BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        leaf_rule: LeafRule::StopAt(1),
        reinsertion,
        invalid_primitives: InvalidPrimitives::Skip,
        ..BvhBuilder::default()
    }
}

#[test]
fn no_tree_becomes_worse_and_crossed_needles_much_better() {
    for family in families::all() {
        let scene = family.scene(3, 3000);
        let plain = builder(None).build(&scene).unwrap();
        let improved = builder(Some(Reinsertion::default())).build(&scene).unwrap();
        let [before, after] = [&plain, &improved].map(sah_cost);
        let name = family.name;
        assert!(after <= before * (1.0 + 1e-9), "{name}: {before}, {after}");
        if name == "needles-crossed" {
            assert!(after < 0.85 * before, "{before}, {after}");
        }
    }
}

#[test]
fn budgets_hold_for_improved_trees() {
    let scene = families::find("hairball").unwrap().scene(1, 4000);
    let reinsertion = Some(Reinsertion {
        rounds: 50,
        share: 1.0,
    });
    let shallow = BvhBuilder {
        budget: BuildBudget {
            max_depth: 13,
            ..BuildBudget::default()
        },
        ..builder(reinsertion)
    };
    let bvh = shallow.build(&scene).unwrap();
    assert!(bvh.depth() <= 13);
    bvh.validate().unwrap();

    let needed = builder(reinsertion).working_bytes(scene.len());
    let small = BvhBuilder {
        budget: BuildBudget {
            max_bytes: Some(needed - 1),
            ..BuildBudget::default()
        },
        ..builder(reinsertion)
    };
    assert!(matches!(
        small.build(&scene),
        Err(BuildError::BudgetExceeded { what: "bytes", .. })
    ));
}

#[test]
fn improving_can_be_cancelled() {
    struct AfterTheBuild(std::sync::atomic::AtomicBool);
    impl BuildObserver for AfterTheBuild {
        fn progress(&self, done: usize, total: usize) {
            if done == total {
                self.0.store(true, std::sync::atomic::Ordering::Relaxed);
            }
        }
        fn is_cancelled(&self) -> bool {
            self.0.load(std::sync::atomic::Ordering::Relaxed)
        }
    }
    let scene = families::find("hairball").unwrap().scene(1, 2000);
    let observer = AfterTheBuild(false.into());
    let built = builder(Some(Reinsertion::default())).build_with(&scene, &observer);
    assert_eq!(built.err(), Some(BuildError::Cancelled));
}

#[test]
fn scenes_whose_boxes_all_overlap_take_bounded_time() {
    for name in [
        "one-point",
        "duplicates",
        "nested-centroids",
        "coplanar-overlapping",
    ] {
        let scene = families::find(name).unwrap().scene(1, 30_000);
        let bvh = builder(Some(Reinsertion {
            rounds: 4,
            share: 1.0,
        }))
        .build(&scene)
        .unwrap();
        bvh.validate().unwrap();
    }
}
