//! What every structure must stand: little stack, and great contrast of scale.

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::families::stadium;
use super::rays::{self, RayKind};
use crate::{AccelerationStructure, TraversalCounters, Triangle};

/// Does `work` on a thread with a stack of 64 KiB.
///
/// # Panics
/// If `work` does.
pub fn on_a_small_stack(work: impl FnOnce() + Send) {
    std::thread::scope(|scope| {
        let builder = std::thread::Builder::new().stack_size(64 << 10);
        let thread = builder.spawn_scoped(scope, work).expect("a thread starts");
        thread.join().expect("the work is done");
    });
}

/// Primitive tests of a ray aimed at a dense figure: alone, and in a coarse
/// stadium a million times its size.
pub fn tests_of_a_figure<A: AccelerationStructure>(build: impl Fn(&[Triangle]) -> A) -> [f64; 2] {
    let figure = stadium::figure(20_000);
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let mut rays = rays::rays(RayKind::ThroughEdges, &figure, &mut random, 20_000);
    // The others start below the floor and meet it first.
    rays.retain(|ray| ray.origin.y > -1.5);
    assert!(rays.len() > 5000, "{}", rays.len());
    let mut scene = figure.clone();
    scene.extend(stadium::stadium(2000));
    [figure, scene].map(|triangles| {
        let structure = build(&triangles);
        let mut counters = TraversalCounters::default();
        for ray in &rays {
            structure.closest_hit_with(ray, &mut counters);
        }
        counters.mean(&counters.primitive_tests)
    })
}
