//! Packets of every width, at every level of vectors that the machine has,
//! against brute force, bit for bit.

use std::ops::ControlFlow;

use accel_bvh::accel_core::simd::SimdLevel;
use accel_bvh::{
    AccelerationStructure, AllHits, AnyHit, Bvh, BvhBuilder, ClosestHit, Filtered, Hit,
    InvalidPrimitives, ObjectSplit, PacketTraversal, PreparedRay, Query, RaySegment, Sphere,
    TraversalCounters, Triangle,
};
use accel_core::BruteForce;
use accel_core::testing::agreement::oracle;
use accel_core::testing::rays::RayKind;
use accel_core::testing::{families, rays};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// The answers of all queries to a ray, hits by their bits.
#[derive(Clone, Debug, PartialEq)]
struct Answers {
    closest: Option<Bits>,
    any: bool,
    all: Vec<Bits>,
    odd: Option<Bits>,
}

type Bits = [u32; 4];

fn bits(hit: Hit) -> Bits {
    [hit.t.to_bits(), hit.u.to_bits(), hit.v.to_bits(), hit.id]
}

fn is_odd(hit: &Hit) -> bool {
    hit.id % 2 == 1
}

fn single<A: AccelerationStructure>(structure: &A, rays: &[RaySegment]) -> Vec<Answers> {
    let answers = rays.iter().map(|ray| Answers {
        closest: structure.closest_hit(ray).map(bits),
        any: structure.any_hit(ray),
        all: structure.all_hits(ray).into_iter().map(bits).collect(),
        odd: structure.closest_hit_where(ray, is_odd).map(bits),
    });
    answers.collect()
}

/// Any of the queries. One type for all keeps the instances of packet traversal,
/// which take long to compile, few.
enum AnyQuery {
    Closest(ClosestHit),
    Any(AnyHit),
    All(AllHits),
    Odd(Filtered<ClosestHit, fn(&Hit) -> bool>),
}

impl AnyQuery {
    fn each(ray: &PreparedRay) -> [Self; 4] {
        [
            Self::Closest(ClosestHit::new(ray)),
            Self::Any(AnyHit::new(ray)),
            Self::All(AllHits::new(ray)),
            Self::Odd(Filtered::new(ClosestHit::new(ray), is_odd)),
        ]
    }

    fn answer(self, answers: &mut Answers) {
        match self {
            Self::Closest(query) => answers.closest = query.best().map(bits),
            Self::Any(query) => answers.any = query.found(),
            Self::All(query) => answers.all = query.into_sorted().into_iter().map(bits).collect(),
            Self::Odd(query) => answers.odd = query.into_inner().best().map(bits),
        }
    }
}

impl Query for AnyQuery {
    fn t_max(&self) -> f32 {
        match self {
            Self::Closest(query) => query.t_max(),
            Self::Any(query) => query.t_max(),
            Self::All(query) => query.t_max(),
            Self::Odd(query) => query.t_max(),
        }
    }

    fn offer(&mut self, hit: &Hit) -> ControlFlow<()> {
        match self {
            Self::Closest(query) => query.offer(hit),
            Self::Any(query) => query.offer(hit),
            Self::All(query) => query.offer(hit),
            Self::Odd(query) => query.offer(hit),
        }
    }
}

fn in_packets<A: PacketTraversal<N>, const N: usize>(
    structure: &A,
    level: SimdLevel,
    rays: &[RaySegment],
) -> Vec<Answers> {
    let none = Answers {
        closest: None,
        any: false,
        all: Vec::new(),
        odd: None,
    };
    let mut answers = vec![none; rays.len()];
    for kind in 0..4 {
        let query = |ray: &PreparedRay| {
            let [closest, any, all, odd] = AnyQuery::each(ray);
            match kind {
                0 => closest,
                1 => any,
                2 => all,
                _ => odd,
            }
        };
        structure.query_packets(level, rays, &mut (), query, |index, query| {
            if let Some(query) = query {
                query.answer(&mut answers[index]);
            }
        });
    }
    answers
}

/// Compares packets of every width at every level with `expected`.
fn compare<A>(structure: &A, rays: &[RaySegment], expected: &[Answers], what: &str)
where
    A: PacketTraversal<4> + PacketTraversal<8> + PacketTraversal<16> + PacketTraversal<64>,
{
    for level in SimdLevel::available() {
        let widths = [
            (4, in_packets::<A, 4>(structure, level, rays)),
            (8, in_packets::<A, 8>(structure, level, rays)),
            (16, in_packets::<A, 16>(structure, level, rays)),
            (64, in_packets::<A, 64>(structure, level, rays)),
        ];
        for (width, actual) in widths {
            for ((ray, expected), actual) in rays.iter().zip(expected).zip(&actual) {
                let level = level.name();
                assert_eq!(expected, actual, "{what}, {width} lanes, {level}: {ray:?}");
            }
        }
    }
}

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

/// All finite kinds in turn, every seventh ray replaced by one that is none, and
/// a run of those: packets with empty lanes and packets without a ray.
fn spoiled(scene: &[Triangle], seed: u64) -> Vec<RaySegment> {
    let mut rays = rays::mixed(scene, seed, 160);
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let none = rays::rays(RayKind::NonFinite, scene, &mut random, rays.len());
    for (index, ray) in rays.iter_mut().enumerate() {
        if index % 7 == 3 || (80..150).contains(&index) {
            *ray = none[index];
        }
    }
    rays
}

/// Sheaves of rays about those of all finite kinds: of one origin and nearly
/// one direction, zero components kept.
fn coherent(scene: &[Triangle], seed: u64) -> Vec<RaySegment> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let middles = rays::mixed(scene, seed, 6);
    let sheaves = middles.iter().flat_map(|middle| [*middle; 16]);
    let sheaves = sheaves.map(|mut ray| {
        for axis in 0..3 {
            ray.direction[axis] *= 1.0 + random.random_range(-0.02..0.02_f32);
        }
        ray
    });
    sheaves.collect()
}

/// From one origin in all directions, straight through vertices.
fn from_one_origin(scene: &[Triangle], seed: u64) -> Vec<RaySegment> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut rays = rays::rays(RayKind::ThroughVertices, scene, &mut random, 96);
    let origin = rays[0].origin;
    for ray in &mut rays {
        ray.direction = ray.origin + ray.direction - origin;
        ray.origin = origin;
    }
    rays
}

#[test]
fn every_width_and_level_agrees_with_brute_force_on_every_family() {
    let (mut hits, mut scenes) = (0, 0);
    for (index, family) in (0_u64..).zip(families::all()) {
        // Half of the trees are swept, half are binned.
        let seed = index % 2;
        let scene = family.scene(seed, 300);
        let (bvh, oracle) = (built(&scene, seed == 0), oracle(&scene).unwrap());
        let sets = [
            ("spoiled", spoiled(&scene, seed)),
            ("coherent", coherent(&scene, seed)),
            ("from one origin", from_one_origin(&scene, seed)),
        ];
        for (set, rays) in sets {
            let expected = single(&oracle, &rays);
            let what = format!("family {}, seed {seed}, {set}", family.name);
            compare(&bvh, &rays, &expected, &what);
            hits += expected.iter().filter(|answers| answers.any).count();
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
    for rays in [spoiled(&boxes, 1), coherent(&boxes, 2)] {
        let expected = single(&oracle, &rays);
        compare(&bvh, &rays, &expected, "spheres");
    }
}

#[test]
fn a_tree_of_nothing_and_one_of_a_leaf_answer_packets() {
    let triangle = Triangle::new([0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]);
    let rays: Vec<_> = (0..70)
        .map(|index| RaySegment::new([index as f32 * 0.02, 0.1, 0.0], [0.0, 0.0, 1.0]))
        .collect();
    for scene in [&[][..], &[triangle]] {
        let expected = single(&oracle(scene).unwrap(), &rays);
        compare(&built(scene, true), &rays, &expected, "few triangles");
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
