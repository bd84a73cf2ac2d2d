//! What builds hold at once, against the budget that they were given. A program of
//! its own: other tests would be counted as well.

use accel_core::testing::families;
use accel_sbvh::{BuildBudget, ObjectSplit, ReferenceLimit, SbvhBuilder};
use peak_alloc::PeakAlloc;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Bins of one thread.
const BINS: usize = 50_000;

#[test]
fn no_build_holds_more_than_its_budget() {
    let triangles = families::find("long-diagonals").unwrap().scene(3, 6000);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.unwrap();
    for object_split in [ObjectSplit::FullSweep, ObjectSplit::default()] {
        let mut last = 0;
        for budget in [3_000_000, 5_000_000, 7_000_000] {
            let builder = SbvhBuilder {
                object_split,
                limit: ReferenceLimit::Factor(4.0),
                budget: BuildBudget {
                    max_bytes: Some(budget),
                    ..BuildBudget::default()
                },
                ..SbvhBuilder::default()
            };
            let before = MEMORY.current_usage();
            MEMORY.reset_peak_usage();
            let (bvh, statistics) = pool
                .install(|| builder.build_with(&triangles, &()))
                .unwrap();
            let peak = MEMORY.peak_usage() - before;
            drop(bvh);
            assert!(
                peak <= budget + BINS,
                "{object_split:?}: {peak} of {budget}"
            );
            assert!(statistics.references > last, "{statistics:?}");
            last = statistics.references;
        }
    }
}
