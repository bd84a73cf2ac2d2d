//! Trees are the same bytes for any number of threads.

use accel_core::testing::families;
use accel_kdtree::{AccelerationStructure, KdTree, KdTreeBuilder, PlaneSearch, Triangle};

fn in_pool(threads: usize, triangles: &[Triangle], builder: &KdTreeBuilder) -> KdTree<Triangle> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    pool.install(|| builder.build(triangles)).unwrap()
}

#[test]
fn the_tree_does_not_depend_on_the_number_of_threads() {
    // Large enough to fork, to bin in parallel and to sort in parallel; the small
    // budget is used up.
    for (family, max_duplication) in [("hairball", 1.0), ("closed-bumpy-sphere", 16.0)] {
        let triangles = families::find(family).expect(family).scene(7, 40_000);
        for search in [PlaneSearch::Sweep, PlaneSearch::binned()] {
            let builder = KdTreeBuilder {
                search,
                max_duplication,
                ..KdTreeBuilder::default()
            };
            let one = in_pool(1, &triangles, &builder);
            assert!(one.depth() > 10);
            for threads in [2, 3, 8] {
                let many = in_pool(threads, &triangles, &builder);
                assert_eq!(one.node_words(), many.node_words(), "{family} {search:?}");
                assert_eq!(one.outline().ids, many.outline().ids, "{family} {search:?}");
            }
        }
    }
}
