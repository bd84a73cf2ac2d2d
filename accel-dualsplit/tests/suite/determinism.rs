//! Trees are the same bytes for any number of threads, and converting is checked
//! at its limits.

use accel_core::testing::families;
use accel_dualsplit::{
    AccelerationStructure, BuildBudget, BuildError, BvhBuilder, CarvingCosts, DualSplitConverter,
    Partitioning, Triangle,
};

#[test]
fn the_words_do_not_depend_on_the_number_of_threads() {
    for family in ["hairball", "soup-mixed-sizes", "duplicates"] {
        let triangles = families::find(family).expect(family).scene(7, 20_000);
        let bvh = BvhBuilder::default().build(&triangles).unwrap();
        for partitioning in [Partitioning::Identical, Partitioning::Similar] {
            let converter = DualSplitConverter {
                partitioning,
                ..DualSplitConverter::default()
            };
            let with_threads = |threads| {
                let pool = rayon::ThreadPoolBuilder::new()
                    .num_threads(threads)
                    .build()
                    .unwrap();
                pool.install(|| converter.convert(&bvh)).unwrap()
            };
            let one = with_threads(1);
            for threads in [2, 8] {
                let many = with_threads(threads);
                assert!(one.node_words() == many.node_words(), "{family} {threads}");
            }
        }
    }
}

#[test]
fn an_empty_scene_makes_an_empty_tree() {
    let bvh = BvhBuilder::default().build::<Triangle>(&[]).unwrap();
    let tree = DualSplitConverter::default().convert(&bvh).unwrap();
    assert_eq!((tree.node_words().len(), tree.bounds()), (0, None));
    tree.validate().unwrap();
}

#[test]
fn settings_out_of_range_and_budgets_are_typed_errors() {
    let triangles = families::find("hairball").unwrap().scene(1, 500);
    let bvh = BvhBuilder::default().build(&triangles).unwrap();
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let converter = DualSplitConverter {
            carving_costs: CarvingCosts {
                single_axis: bad,
                dual_axis: 0.5,
            },
            ..DualSplitConverter::default()
        };
        let error = converter.convert(&bvh).unwrap_err();
        let is_setting = matches!(
            error,
            BuildError::InvalidSetting { setting, .. } if setting == "carving_costs.single_axis"
        );
        assert!(is_setting, "{error}");
    }
    let converter = DualSplitConverter {
        budget: BuildBudget {
            max_bytes: Some(1000),
            ..BuildBudget::default()
        },
        ..DualSplitConverter::default()
    };
    let error = converter.convert(&bvh).unwrap_err();
    assert!(
        matches!(error, BuildError::BudgetExceeded { limit: 1000, .. }),
        "{error}"
    );
}
