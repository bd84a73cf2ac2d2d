//! Packets of every width, at every level of vectors that the machine has,
//! against brute force, bit for bit.

use accel_bvh::accel_core::simd::SimdLevel;
use accel_bvh::{
    AccelerationStructure, Bvh, BvhBuilder, ClosestHit, InvalidPrimitives, ObjectSplit,
    PacketTraversal, RaySegment, Sphere, TraversalCounters, Triangle,
};
use accel_core::BruteForce;
use accel_core::testing::agreement::Expected;
use accel_core::testing::packets::{check_packets, ray_sets};
use accel_core::testing::{families, rays};

fn built(triangles: &[Triangle], is_swept: bool) -> Bvh<Triangle> {
    let builder = BvhBuilder {
        object_split: if is_swept {
            ObjectSplit::FullSweep
        } else {
            ObjectSplit::default()
        },
        invalid_primitives: InvalidPrimitives::Skip,
        ..BvhBuilder::default()
    };
    builder.build(triangles).unwrap()
}

#[test]
fn every_width_and_level_agrees_with_brute_force_on_every_family() {
    let (mut hits, mut scenes) = (0, 0);
    for (index, family) in (0_u64..).zip(families::all()) {
        // Half of the trees are swept, half are binned.
        let seed = index % 2;
        let scene = family.scene(seed, 300);
        let bvh = built(&scene, seed == 0);
        for (set, rays) in ray_sets(&scene, seed) {
            let expected = Expected::new(&scene, rays).unwrap();
            check_packets(&bvh, &expected)
                .unwrap_or_else(|error| panic!("{}, seed {seed}, {set}: {error}", family.name));
            hits += expected.hits();
        }
        scenes += 1;
    }
    assert!(scenes >= 40 && hits > 5_000, "{scenes} {hits}");
}

#[test]
fn primitives_without_a_test_of_lanes_agree() {
    let boxes = families::find("soup-mixed-sizes").unwrap().scene(3, 300);
    let spheres: Vec<Sphere> = boxes
        .iter()
        .map(|triangle| Sphere::new(triangle.a, triangle.a.distance(triangle.b)))
        .collect();
    let bvh = BvhBuilder::default().build(&spheres).unwrap();
    let oracle = BruteForce::new(&spheres).unwrap();
    for (set, rays) in ray_sets(&boxes, 1) {
        check_packets(&bvh, &Expected::by(&oracle, rays))
            .unwrap_or_else(|error| panic!("{set}: {error}"));
    }
}

#[test]
fn a_tree_of_nothing_and_one_of_a_leaf_answer_packets() {
    let triangle = Triangle::new([0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]);
    let rays: Vec<_> = (0..70)
        .map(|index| RaySegment::new([index as f32 * 0.02, 0.1, 0.0], [0.0, 0.0, 1.0]))
        .collect();
    for scene in [&[][..], &[triangle]] {
        let expected = Expected::new(scene, rays.clone()).unwrap();
        check_packets(&built(scene, true), &expected).unwrap();
    }
}

#[test]
fn slices_are_answered_in_order_on_all_cores() {
    let scene = families::find("overlapping-big").unwrap().scene(5, 300);
    let bvh = built(&scene, true);
    let rays = rays::mixed(&scene, 6, 3001);
    let packets = PacketTraversal::<8>::closest_hits_packet(&bvh, &rays);
    assert_eq!(packets, bvh.closest_hits(&rays));
    let packets = PacketTraversal::<64>::any_hits_packet(&bvh, &rays);
    assert_eq!(packets, bvh.any_hits(&rays));
}

#[test]
fn a_sheaf_of_rays_visits_fewer_nodes_than_its_rays_alone() {
    let scene = families::find("soup-mixed-sizes").unwrap().scene(1, 2000);
    let bvh = built(&scene, true);
    let origin = bvh.bounds().unwrap().max * 3.0;
    let forward = bvh.bounds().unwrap().center() - origin;
    let rays: Vec<_> = (0..64)
        .map(|index| {
            let step = 1e-3 * forward.length();
            let mut direction = forward;
            direction.x += step * (index % 8) as f32;
            direction.y += step * (index / 8) as f32;
            RaySegment::new(origin, direction)
        })
        .collect();
    let mut alone = TraversalCounters::default();
    for ray in &rays {
        bvh.closest_hit_with(ray, &mut alone);
    }
    let mut together = TraversalCounters::default();
    let level = SimdLevel::detect();
    PacketTraversal::<64>::query_packets(
        &bvh,
        level,
        &rays,
        &mut together,
        ClosestHit::new,
        |_, _| (),
    );
    assert_eq!((together.rays, alone.rays), (64, 64));
    assert!(
        4 * together.nodes.sum < alone.nodes.sum,
        "{together:?} {alone:?}"
    );
}
