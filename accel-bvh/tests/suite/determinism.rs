//! Trees are the same bytes for any number of threads.

use accel_bvh::{
    AccelerationStructure, Bvh, BvhBuilder, LeafRule, ObjectSplit, Reinsertion, Triangle,
};
use accel_core::testing::families;

fn in_pool(threads: usize, triangles: &[Triangle], builder: &BvhBuilder) -> Bvh<Triangle> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    pool.install(|| builder.build(triangles)).unwrap()
}

#[test]
fn the_tree_does_not_depend_on_the_number_of_threads() {
    // Large enough to fork, to bin in parallel and to sweep in parallel.
    for family in ["hairball", "soup-mixed-sizes", "duplicates"] {
        let triangles = families::find(family).expect(family).scene(7, 36_000);
        assert!(triangles.len() > 1 << 15, "{family}");
        for object_split in [ObjectSplit::FullSweep, ObjectSplit::Binned { bins: 32 }] {
            for (leaf_rule, reinsertion) in [
                (LeafRule::StopAt(8), None),
                (LeafRule::SahUpTo(8), Some(Reinsertion::default())),
            ] {
                let builder = BvhBuilder {
                    object_split,
                    leaf_rule,
                    reinsertion,
                    ..BvhBuilder::default()
                };
                let one = in_pool(1, &triangles, &builder);
                for threads in [2, 3, 8] {
                    let many = in_pool(threads, &triangles, &builder);
                    assert_eq!(one.node_words(), many.node_words(), "{family} {builder:?}");
                    assert_eq!(
                        one.outline().ids,
                        many.outline().ids,
                        "{family} {builder:?}"
                    );
                }
            }
        }
    }
}
