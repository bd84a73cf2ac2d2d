//! Packets of every width, at every level of vectors that the machine has,
//! against brute force, bit for bit.

use accel_core::simd::SimdLevel;
use accel_core::testing::agreement::Expected;
use accel_core::testing::families;
use accel_core::testing::packets::{check_packets, ray_sets};
use accel_kdtree::glam::Vec3;
use accel_kdtree::{
    AccelerationStructure, ClosestHit, InvalidPrimitives, KdTree, KdTreeBuilder, PacketTraversal,
    RaySegment, TraversalCounters, Triangle,
};

/// Rays of one origin with neighbouring directions, over the whole scene; some
/// of the directions lie along axes.
fn camera_rays(tree: &KdTree<Triangle>, side: usize) -> Vec<RaySegment> {
    let Some(bounds) = tree.bounds() else {
        return Vec::new();
    };
    let center = bounds.center();
    let reach = (bounds.max - center).max_element();
    let eye = center + Vec3::new(0.0, 0.0, reach * 1.5);
    let offset = |pixel: usize| (pixel as f32 / (side / 2) as f32 - 1.0) * reach;
    let pixels = (0..side * side).map(|pixel| (pixel % side, pixel / side));
    let ray = |(x, y)| RaySegment::new(eye, center + Vec3::new(offset(x), offset(y), 0.0) - eye);
    pixels.map(ray).collect()
}

#[test]
fn every_width_and_level_agrees_with_brute_force_on_every_family() {
    let builder = KdTreeBuilder {
        invalid_primitives: InvalidPrimitives::Skip,
        ..KdTreeBuilder::default()
    };
    let mut hits = 0;
    for family in families::all() {
        let scene = family.scene(5, 300);
        let tree = builder.build(&scene).unwrap();
        let sets = ray_sets(&scene, 6).into_iter();
        for (set, rays) in sets.chain([("camera", camera_rays(&tree, 12))]) {
            let expected = Expected::new(&scene, rays).unwrap();
            check_packets(&tree, &expected)
                .unwrap_or_else(|error| panic!("{}, {set}: {error}", family.name));
            hits += expected.hits();
        }
    }
    assert!(hits > 5_000, "{hits}");
}

#[test]
fn coherent_packets_visit_fewer_nodes_for_each_ray() {
    let scene = families::find("closed-bumpy-sphere")
        .unwrap()
        .scene(1, 5000);
    let tree = KdTreeBuilder::default().build(&scene).unwrap();
    let rays = camera_rays(&tree, 256);
    let mut single = TraversalCounters::default();
    for ray in &rays {
        tree.closest_hit_with(ray, &mut single);
    }
    let mut packets = TraversalCounters::default();
    PacketTraversal::<8>::query_packets(
        &tree,
        SimdLevel::detect(),
        &rays,
        &mut packets,
        ClosestHit::new,
        |_, _| (),
    );
    assert_eq!(packets.rays, single.rays);
    assert!(
        2 * packets.nodes.sum < single.nodes.sum,
        "{packets:?} {single:?}"
    );
}
