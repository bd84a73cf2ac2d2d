//! What watching a traversal costs: nothing when nobody watches.
//!
//! Three ways to the closest hits of the same rays in the same tree: the generic
//! traversal with `()`, the same with counters, and a loop written by hand over
//! the same words, without queries, storage or statistics. All three give the
//! same hits, which is asserted before anything is timed.
//!
//! The ratios come from rounds that take the three in turn, so that what disturbs
//! the machine disturbs all alike. Criterion's figures for each follow.

use std::hint::black_box;
use std::time::Instant;

use accel_bench::report::model::Spread;
use accel_bench::scene::embedded;
use accel_bvh::{AccelerationStructure, Bvh, BvhBuilder, Hit, PreparedRay, RaySegment, Triangle};
use accel_core::glam::Vec3;
use accel_core::primitive::triangles_of_mesh;
use accel_core::simd::F32x4;
use accel_core::statistics::TraversalCounters;
use accel_core::{Primitive, structure::TraversalStack};
use criterion::{Criterion, criterion_group, criterion_main};

/// A tree's words, and its triangles in leaf order with a mark at leaf ends.
struct ByHand {
    words: Vec<u32>,
    triangles: Vec<(Triangle, u32, bool)>,
    bounds: accel_core::Aabb,
}

impl ByHand {
    fn new(bvh: &Bvh<Triangle>, triangles: &[Triangle]) -> Self {
        let outline = bvh.outline();
        let leaves = outline
            .nodes
            .iter()
            .filter(|node| !node.references.is_empty());
        let in_order = leaves.flat_map(|leaf| {
            let end = leaf.references.end;
            leaf.references
                .clone()
                .map(move |position| (position, position + 1 == end))
        });
        let in_order = in_order.map(|(position, is_last)| {
            let id = outline.ids[position as usize];
            (triangles[id as usize], id, is_last)
        });
        Self {
            words: bvh.node_words().to_vec(),
            triangles: in_order.collect(),
            bounds: bvh.bounds().expect("the scene is not empty"),
        }
    }

    fn closest_hit(&self, ray: &RaySegment) -> Option<Hit> {
        let ray = PreparedRay::new(ray)?;
        let (mut t_max, mut best) = (ray.t_max(), None);
        let whole = ray.slab(&self.bounds);
        if whole.near.max(ray.t_min()) > whole.far.min(t_max) {
            return None;
        }
        let reciprocal = ray.reciprocal();
        let signs = reciprocal.cmplt(Vec3::ZERO);
        let [x, y, z] = [0, 1, 2].map(|axis| usize::from(signs.test(axis)) * 2);
        let pairs = |v: Vec3| F32x4::new(v.x, v.x, v.y, v.y);
        let origin_xy = pairs(ray.origin());
        let (near_reciprocal, far_reciprocal) = (ray.near_reciprocal(), ray.far_reciprocal());
        let (near_reciprocal_xy, far_reciprocal_xy) =
            (pairs(near_reciprocal), pairs(far_reciprocal));
        let origin_z = F32x4::splat(ray.origin().z);
        let reciprocal_z = F32x4::new(
            near_reciprocal.z,
            near_reciprocal.z,
            far_reciprocal.z,
            far_reciprocal.z,
        );
        let t_min = F32x4::splat(ray.t_min());
        let mut stack = TraversalStack::new();
        // A node: its word, and bit 31 for a leaf. The root is an inner node.
        let mut next = Some(0_u32);
        while let Some(node) = next {
            let word = (node & 0x7fff_ffff) as usize;
            next = None;
            if node >> 31 == 1 {
                self.leaf(word, &ray, &mut t_max, &mut best);
            } else {
                let words = &self.words[word..word + 13];
                let plane = |index: usize| f32::from_bits(words[index]);
                let two =
                    |a: usize, b: usize| F32x4::new(plane(a), plane(a + 1), plane(b), plane(b + 1));
                let entry = (two(x, 4 + y) - origin_xy) * near_reciprocal_xy;
                let exit = (two(2 - x, 6 - y) - origin_xy) * far_reciprocal_xy;
                let both = (two(8 + z, 10 - z) - origin_z) * reciprocal_z;
                let near = t_min.max_or_keep(entry);
                let near = near.max_or_keep(near.high()).max_or_keep(both);
                let far = F32x4::splat(t_max).min_or_keep(exit);
                let far = far.min_or_keep(far.high()).min_or_keep(both.high());
                let met = near.le_mask(far) & 0b11;
                let near = near.first_two();
                let pointer = words[12];
                let left = pointer & 0x3fff_ffff | (pointer & 0x4000_0000) << 1;
                let left_words = if pointer & 0x4000_0000 == 0 { 13 } else { 1 };
                let right = ((pointer & 0x3fff_ffff) + left_words) | pointer & 0x8000_0000;
                if met == 0b11 {
                    if near[0] <= near[1] {
                        stack.push(right, near[1]);
                        next = Some(left);
                    } else {
                        stack.push(left, near[0]);
                        next = Some(right);
                    }
                } else if met == 0b01 {
                    next = Some(left);
                } else if met == 0b10 {
                    next = Some(right);
                }
            }
            if next.is_none() {
                next = stack.pop_within(t_max);
            }
        }
        best
    }

    #[inline(never)]
    fn leaf(&self, word: usize, ray: &PreparedRay, t_max: &mut f32, best: &mut Option<Hit>) {
        for (triangle, id, is_last) in &self.triangles[self.words[word] as usize..] {
            if let Some(found) = triangle.intersect(ray) {
                let gate = ray.slab(&triangle.bounds().gate());
                let t = found.t.max(gate.near).min(gate.far) + 0.0;
                let is_hit = !gate.is_empty() && t >= ray.t_min() && t <= *t_max;
                let hit = Hit {
                    t,
                    u: found.u,
                    v: found.v,
                    id: *id,
                };
                if is_hit && best.is_none_or(|best| hit.precedes(&best)) {
                    (*t_max, *best) = (t, Some(hit));
                }
            }
            if *is_last {
                break;
            }
        }
    }
}

/// Rounds of which the ratios are taken.
const ROUNDS: usize = 201;

/// A way to find the closest hits of all rays; returns how many rays hit.
type Way<'a> = (&'a str, Box<dyn Fn() -> usize + 'a>);

fn statistics(criterion: &mut Criterion) {
    let scene = embedded::find("room").expect("the room is embedded");
    let mesh = scene.mesh();
    let triangles = triangles_of_mesh(&mesh.positions, &mesh.triangles).expect("it is sound");
    let bvh = BvhBuilder::default()
        .build(&triangles)
        .expect("it is finite");
    let by_hand = ByHand::new(&bvh, &triangles);
    let rays = scene.camera().rays(160, 120);
    for ray in &rays {
        assert_eq!(bvh.closest_hit(ray), by_hand.closest_hit(ray));
    }
    let ways = three_ways(&bvh, &by_hand, &rays);
    print_interleaved_ratios(&ways);
    let mut group = criterion.benchmark_group("closest hit of 19,200 rays");
    for (name, way) in &ways {
        group.bench_function(*name, |bench| bench.iter(way));
    }
    group.finish();
}

fn three_ways<'a>(
    bvh: &'a Bvh<Triangle>,
    by_hand: &'a ByHand,
    rays: &'a [RaySegment],
) -> [Way<'a>; 3] {
    let without = || {
        let hits = rays.iter().map(|ray| bvh.closest_hit(black_box(ray)));
        hits.flatten().count()
    };
    let with_counters = || {
        let mut counters = TraversalCounters::default();
        let hits = rays
            .iter()
            .map(|ray| bvh.closest_hit_with(black_box(ray), &mut counters));
        let count = hits.flatten().count();
        black_box(counters);
        count
    };
    let by_hand = || {
        let hits = rays.iter().map(|ray| by_hand.closest_hit(black_box(ray)));
        hits.flatten().count()
    };
    [
        ("by hand", Box::new(by_hand)),
        ("without statistics", Box::new(without)),
        ("with counters", Box::new(with_counters)),
    ]
}

/// Times relative to the first way: of each round, in which each way has its
/// turn and another goes first every time.
#[expect(clippy::print_stdout, reason = "criterion prints here too")]
fn print_interleaved_ratios(ways: &[Way<'_>; 3]) {
    let rounds: Vec<[f64; 3]> = (0..ROUNDS)
        .map(|round| {
            let mut seconds = [0.0; 3];
            for turn in 0..3 {
                let way = (turn + round) % 3;
                let start = Instant::now();
                black_box(ways[way].1());
                seconds[way] = start.elapsed().as_secs_f64();
            }
            seconds
        })
        .collect();
    println!("time relative to the loop by hand, {ROUNDS} rounds in turn:");
    for (way, (name, _)) in ways.iter().enumerate() {
        let ratios: Vec<f64> = rounds.iter().map(|round| round[way] / round[0]).collect();
        let milliseconds: Vec<f64> = rounds.iter().map(|round| round[way] * 1e3).collect();
        let ratio = Spread::with_confidence(&ratios);
        println!(
            "{name:>20}: {:.3} [{:.3}, {:.3}], median {:.2} ms",
            ratio.median,
            ratio.min,
            ratio.max,
            Spread::of(&milliseconds).median
        );
    }
}

criterion_group!(benches, statistics);
criterion_main!(benches);
