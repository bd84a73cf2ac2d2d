//! Scenes that would make a careless builder slow, deep, or overflow a stack.

use accel_bvh::{
    AccelerationStructure, BvhBuilder, InvalidPrimitives, LeafRule, ObjectSplit, Triangle,
};
use accel_core::TraversalCounters;
use accel_core::build::median_depth;
use accel_core::glam::Vec3;
use accel_core::testing::families::stadium;
use accel_core::testing::{families, rays};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

const SPLITS: [ObjectSplit; 2] = [ObjectSplit::FullSweep, ObjectSplit::Binned { bins: 32 }];

fn builder(object_split: ObjectSplit) -> BvhBuilder {
    BvhBuilder {
        object_split,
        invalid_primitives: InvalidPrimitives::Skip,
        ..BvhBuilder::default()
    }
}

/// The median splits beyond `median_depth` halve what is left.
fn depth_bound(count: usize) -> u32 {
    median_depth(count) + count.max(1).ilog2() + 1
}

#[test]
fn coincident_primitives_make_balanced_trees() {
    for (family, count) in [
        ("one-point", 1_000_000),
        ("duplicates", 100_000),
        ("nested-centroids", 10_000),
    ] {
        let scene = families::find(family).unwrap().scene(1, count);
        for object_split in SPLITS {
            let bvh = builder(object_split).build(&scene).unwrap();
            assert!(
                bvh.depth() <= depth_bound(count),
                "{family}: depth {}",
                bvh.depth()
            );
        }
    }
}

#[test]
fn the_depth_is_bounded_on_every_family() {
    for family in families::all() {
        let scene = family.scene(3, 2000);
        for object_split in SPLITS {
            for leaf_rule in [LeafRule::StopAt(1), LeafRule::SahUpTo(8)] {
                let builder = BvhBuilder {
                    leaf_rule,
                    ..builder(object_split)
                };
                let bvh = builder.build(&scene).unwrap();
                assert!(bvh.depth() <= depth_bound(scene.len()), "{}", family.name);
            }
        }
    }
}

#[test]
fn a_thread_with_64_kib_of_stack_builds_and_traverses_the_deepest_family() {
    let deepest = families::all()
        .iter()
        .map(|family| family.scene(1, 3000))
        .max_by_key(|scene| {
            builder(ObjectSplit::FullSweep)
                .build(scene)
                .unwrap()
                .depth()
        })
        .unwrap();
    let work = move || {
        for object_split in SPLITS {
            let bvh = builder(object_split).build(&deepest).unwrap();
            assert!(bvh.depth() >= 30, "depth {}", bvh.depth());
            let rays = rays::mixed(&deepest, 2, 1000);
            assert!(
                rays.iter()
                    .filter(|ray| bvh.closest_hit(ray).is_some())
                    .count()
                    > 10
            );
            bvh.validate().unwrap();
        }
    };
    let thread = std::thread::Builder::new()
        .stack_size(64 << 10)
        .spawn(work)
        .unwrap();
    thread.join().unwrap();
}

#[test]
fn a_figure_costs_hardly_more_in_a_stadium_than_alone() {
    let figure = stadium::figure(20_000);
    let scene: Vec<Triangle> = figure
        .iter()
        .chain(&stadium::stadium(2000))
        .copied()
        .collect();
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let mut rays = rays::rays(rays::RayKind::ThroughEdges, &figure, &mut random, 20_000);
    // The others start below the floor and meet it first.
    rays.retain(|ray| ray.origin.y > -1.5);
    for object_split in SPLITS {
        let tests = |triangles: &[Triangle]| {
            let bvh = builder(object_split).build(triangles).unwrap();
            let mut counters = TraversalCounters::default();
            for ray in &rays {
                bvh.closest_hit_with(ray, &mut counters);
            }
            counters.mean(&counters.primitive_tests)
        };
        let (alone, in_stadium) = (tests(&figure), tests(&scene));
        assert!(rays.len() > 5000 && alone > 1.0, "{alone}");
        assert!(in_stadium <= 1.5 * alone, "{in_stadium} against {alone}");
    }
}

#[test]
fn permuting_scaling_and_swapping_axes_change_nothing_that_matters() {
    for family in [
        "overlapping-big",
        "integer-soup",
        "hairball",
        "t-junction-wall",
    ] {
        let scene = families::find(family).unwrap().scene(4, 1000);
        let rays = rays::mixed(&scene, 5, 500);
        for object_split in SPLITS {
            let build = |scene: &[Triangle]| builder(object_split).build(scene).unwrap();
            let bvh = build(&scene);
            let reversed: Vec<Triangle> = scene.iter().rev().copied().collect();
            let reversed = build(&reversed);
            let map = |f: fn(Vec3) -> Vec3| {
                build(
                    &scene
                        .iter()
                        .map(|t| Triangle::from(t.vertices().map(f)))
                        .collect::<Vec<_>>(),
                )
            };
            let doubled = map(|p| p * 1024.0);
            let swapped = map(|p| Vec3::new(p.z, p.x, p.y));
            for ray in &rays {
                let mut ids: Vec<u32> = bvh.all_hits(ray).iter().map(|hit| hit.id).collect();
                ids.sort_unstable();

                let last = scene.len() as u32 - 1;
                let mut others: Vec<u32> = reversed
                    .all_hits(ray)
                    .iter()
                    .map(|hit| last - hit.id)
                    .collect();
                others.sort_unstable();
                assert_eq!(ids, others, "permuted: {ray:?}");

                // By a power of two: exact, so even t is the same.
                let mut scaled = *ray;
                (scaled.origin, scaled.direction) = (ray.origin * 1024.0, ray.direction * 1024.0);
                assert_eq!(
                    doubled.all_hits(&scaled),
                    bvh.all_hits(ray),
                    "scaled: {ray:?}"
                );

                let turn = |p: Vec3| Vec3::new(p.z, p.x, p.y);
                let mut turned = *ray;
                (turned.origin, turned.direction) = (turn(ray.origin), turn(ray.direction));
                // Equal components may choose another main axis: then edges may fall
                // to another neighbour, so only rays with a clear one must agree.
                let d = ray.direction.abs();
                let ties = d.x == d.y || d.y == d.z || d.z == d.x;
                let mut others: Vec<u32> =
                    swapped.all_hits(&turned).iter().map(|hit| hit.id).collect();
                others.sort_unstable();
                assert!(ties || ids == others, "axes swapped: {ray:?}");
            }
        }
    }
}
