//! Packets of every width and instruction set against single rays, bit for bit.

use accel_core::simd::SimdLevel;
use accel_core::testing::{families, rays};
use accel_kdtree::glam::Vec3;
use accel_kdtree::{
    AccelerationStructure, AllHits, AnyHit, ClosestHit, Hit, InvalidPrimitives, KdTree,
    KdTreeBuilder, PacketTraversal, PreparedRay, RaySegment, TraversalCounters, Triangle,
};

type Bits = [u32; 4];

fn bits(hit: &Hit) -> Bits {
    [hit.t.to_bits(), hit.id, hit.u.to_bits(), hit.v.to_bits()]
}

/// What single rays answer.
struct Expected {
    closest: Vec<Option<Bits>>,
    any: Vec<bool>,
    all: Vec<Vec<Bits>>,
}

impl Expected {
    fn new(tree: &KdTree<Triangle>, rays: &[RaySegment]) -> Self {
        let all = |ray| tree.all_hits(ray).iter().map(bits).collect();
        Self {
            closest: rays
                .iter()
                .map(|ray| tree.closest_hit(ray).as_ref().map(bits))
                .collect(),
            any: rays.iter().map(|ray| tree.any_hit(ray)).collect(),
            all: rays.iter().map(all).collect(),
        }
    }
}

fn check<const N: usize>(
    tree: &KdTree<Triangle>,
    level: SimdLevel,
    rays: &[RaySegment],
    expected: &Expected,
) {
    let context = |index: usize| format!("{N} at {}: {:?}", level.name(), rays[index]);
    let packets = |index: usize, actual: Option<Bits>| {
        assert_eq!(actual, expected.closest[index], "{}", context(index));
    };
    PacketTraversal::<N>::query_packets(
        tree,
        level,
        rays,
        &mut (),
        ClosestHit::new,
        |index, query| {
            packets(
                index,
                query.and_then(|query| query.best().as_ref().map(bits)),
            );
        },
    );
    PacketTraversal::<N>::query_packets(tree, level, rays, &mut (), AnyHit::new, |index, query| {
        let actual = query.is_some_and(|query| query.found());
        assert_eq!(actual, expected.any[index], "{}", context(index));
    });
    PacketTraversal::<N>::query_packets(
        tree,
        level,
        rays,
        &mut (),
        AllHits::new,
        |index, query| {
            let hits = query.map_or_else(Vec::new, AllHits::into_sorted);
            let actual: Vec<Bits> = hits.iter().map(bits).collect();
            assert_eq!(actual, expected.all[index], "{}", context(index));
        },
    );
}

fn check_widths(tree: &KdTree<Triangle>, rays: &[RaySegment]) {
    let expected = Expected::new(tree, rays);
    for level in SimdLevel::available() {
        check::<1>(tree, level, rays, &expected);
        check::<4>(tree, level, rays, &expected);
        check::<8>(tree, level, rays, &expected);
        check::<16>(tree, level, rays, &expected);
        check::<21>(tree, level, rays, &expected);
    }
}

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
fn packets_give_the_bits_of_single_rays_on_every_family() {
    let builder = KdTreeBuilder {
        invalid_primitives: InvalidPrimitives::Skip,
        ..KdTreeBuilder::default()
    };
    let mut hits = 0;
    for family in families::all() {
        let scene = family.scene(5, 300);
        let tree = builder.build(&scene).unwrap();
        let camera = camera_rays(&tree, 12);
        check_widths(&tree, &camera);
        check_widths(&tree, &rays::mixed(&scene, 6, 150));
        hits += camera.iter().filter(|ray| tree.any_hit(*ray)).count();
    }
    assert!(hits > 1000, "{hits}");
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
        |ray: &PreparedRay| ClosestHit::new(ray),
        |_, _| (),
    );
    assert_eq!(packets.rays, single.rays);
    assert!(
        2 * packets.nodes.sum < single.nodes.sum,
        "{packets:?} {single:?}"
    );
}
