//! Trees are the same bytes for any number of threads.

use accel_core::testing::families;
use accel_sbvh::{
    AccelerationStructure, Bvh, ObjectSplit, ReferenceLimit, SbvhBuilder, Spending, Triangle,
};

fn in_pool(threads: usize, triangles: &[Triangle], builder: &SbvhBuilder) -> Bvh<Triangle> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    pool.install(|| builder.build(triangles)).unwrap()
}

#[test]
fn the_tree_does_not_depend_on_the_number_of_threads() {
    let default = SbvhBuilder::default();
    let builders = [
        default,
        SbvhBuilder {
            object_split: ObjectSplit::default(),
            alpha: 1e-7,
            ..default
        },
        SbvhBuilder {
            limit: ReferenceLimit::Factor(1.05),
            ..default
        },
        SbvhBuilder {
            limit: ReferenceLimit::Factor(1.05),
            spending: Spending::BreadthFirst,
            ..default
        },
        SbvhBuilder {
            limit: ReferenceLimit::Factor(1.05),
            spending: Spending::Shares,
            ..default
        },
    ];
    // Large enough to fork and to search all axes at once.
    for family in ["hairball", "soup-mixed-sizes"] {
        let triangles = families::find(family).expect(family).scene(7, 10_000);
        for builder in builders {
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
