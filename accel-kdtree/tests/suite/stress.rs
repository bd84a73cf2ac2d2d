//! Scenes that would make a careless builder slow, deep, or overflow a stack.

use accel_core::testing::stress::{on_a_small_stack, tests_of_a_figure};
use accel_core::testing::{families, rays};
use accel_kdtree::{
    AccelerationStructure, InvalidPrimitives, KdTree, KdTreeBuilder, PlaneSearch, Termination,
    Triangle, Work,
};

fn builders() -> [KdTreeBuilder; 2] {
    [PlaneSearch::Sweep, PlaneSearch::binned()].map(|search| KdTreeBuilder {
        search,
        invalid_primitives: InvalidPrimitives::Skip,
        ..KdTreeBuilder::default()
    })
}

fn build(builder: &KdTreeBuilder, scene: &[Triangle]) -> (KdTree<Triangle>, Work) {
    builder.build_counting(scene, &()).unwrap()
}

/// Comparisons for each reference, those that splits created included, and each
/// level: of the tree, and of the sort at the root.
fn comparisons_per_level(tree: &KdTree<Triangle>, work: &Work) -> f64 {
    let primitives = tree.primitive_count() as u64;
    let references = (primitives + work.references_created).max(1);
    let levels = tree.depth() + 1 + references.ilog2();
    work.comparisons as f64 / (references * u64::from(levels)) as f64
}

#[test]
fn comparisons_are_at_most_24_times_references_times_levels_on_every_family() {
    for family in families::all() {
        let scene = family.scene(3, 2000);
        for builder in builders() {
            let (tree, work) = build(&builder, &scene);
            let per_level = comparisons_per_level(&tree, &work);
            assert!(per_level <= 24.0, "{}: {per_level} {work:?}", family.name);
            let limit = scene.len() as u64 * 16;
            assert!(work.references_created <= limit, "{}", family.name);
            assert!(tree.depth() <= builder.budget.max_depth);
        }
    }
}

#[test]
fn a_million_stacked_or_coplanar_primitives_take_few_comparisons() {
    let sheet: Vec<Triangle> = (0..1_000_000)
        .map(|i| {
            let (x, y) = ((i / 2 % 707) as f32, (i / 1414) as f32);
            let (dx, dy) = if i % 2 == 0 { (1.0, 1.0) } else { (-1.0, -1.0) };
            let (x, y) = if i % 2 == 0 {
                (x, y)
            } else {
                (x + 1.0, y + 1.0)
            };
            Triangle::new([x, y, 5.0], [x + dx, y, 5.0], [x, y + dy, 5.0])
        })
        .collect();
    let stacked = families::find("one-point").unwrap().scene(1, 1_000_000);
    let duplicates = families::find("duplicates").unwrap().scene(1, 100_000);
    for (name, scene) in [
        ("sheet", &sheet),
        ("stacked", &stacked),
        ("duplicates", &duplicates),
    ] {
        let (tree, work) = build(&builders()[0], scene);
        let n = scene.len() as f64;
        let per_n_log_n = work.comparisons as f64 / (n * n.log2());
        assert!(per_n_log_n < 25.0, "{name}: {per_n_log_n} {work:?}");
        // Straddling is not needed to tell squares of a grid apart.
        assert!(
            work.references_created < scene.len() as u64,
            "{name}: {work:?}"
        );
        assert!(tree.depth() <= 60, "{name}: depth {}", tree.depth());
        // In leaves of a million no reference may be looked for one by one.
        tree.validate().unwrap();
    }
}

#[test]
fn a_thread_with_64_kib_of_stack_builds_and_traverses_the_deepest_family() {
    let manual = KdTreeBuilder {
        termination: Termination::Manual { max_leaf_size: 1 },
        max_duplication: 4.0,
        ..builders()[0]
    };
    let deepest = families::all()
        .iter()
        .map(|family| family.scene(1, 500))
        .max_by_key(|scene| build(&manual, scene).0.depth())
        .unwrap();
    on_a_small_stack(|| {
        let (tree, _) = build(&manual, &deepest);
        assert!(tree.depth() >= 60, "depth {}", tree.depth());
        let rays = rays::mixed(&deepest, 2, 1000);
        let hits = rays.iter().filter(|ray| tree.closest_hit(*ray).is_some());
        assert!(hits.count() > 10);
        tree.validate().unwrap();
    });
}

#[test]
fn a_figure_costs_hardly_more_in_a_stadium_than_alone() {
    for builder in builders() {
        let [alone, in_stadium] = tests_of_a_figure(|triangles| build(&builder, triangles).0);
        assert!(alone > 1.0, "{alone}");
        assert!(in_stadium <= 1.5 * alone, "{in_stadium} against {alone}");
    }
}
