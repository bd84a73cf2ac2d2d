//! The kd-tree's two builders, with clipping and without, beside a full-sweep
//! BVH, in one run on one thread: how long they take to build, what the trees are
//! like (Ize 2008, Table 3), what rays cost (Table 2), and how fast they are.
//!
//! ```sh
//! cargo bench -p accel-kdtree --bench kd_tree_against_bvh -- MESH.obj [x,y,z,x,y,z,fov]
//! ```
//!
//! The camera is given by where it stands, what it looks at, and its vertical
//! field of view in degrees; without one it looks at the whole mesh along -z.
//! Primary rays, then diffuse paths of up to five bounces from them; structures
//! take turns, and ratios are medians over all turns. Primary rays come in blocks
//! of 4 by 2 pixels, and the packets of both structures are held against their
//! single rays.
#![allow(clippy::print_stdout)]

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use accel_bvh::{Bvh, BvhBuilder, ObjectSplit};
use accel_core::testing::{bench_arguments, mesh_file};
use accel_kdtree::glam::Vec3;
use accel_kdtree::{
    Aabb, AccelerationStructure, BuildError, KdTree, KdTreeBuilder, PacketTraversal, PlaneSearch,
    Primitive, RaySegment, SurfaceAreaHeuristic, Termination, TraversalCounters, Triangle,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Pixels along a side of the image.
const IMAGE: usize = 256;
/// Pixels along a side of the image for packets.
const PACKETS_IMAGE: usize = 1024;
const ROUNDS: usize = 5;
const TURN: usize = 4096;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = bench_arguments();
    let Some(path) = arguments.next() else {
        println!("name an OBJ file");
        return Ok(());
    };
    let triangles = mesh_file::load(&path)?;
    let eye = match arguments.next() {
        Some(text) => parse_numbers(&text)?,
        None => in_front_of(&triangles),
    };
    println!("{path}: {} triangles, camera {eye:?}", triangles.len());
    // One thread, so that builders are compared by what they do.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    Ok(pool.install(|| compare(&triangles, eye))?)
}

fn compare(triangles: &[Triangle], camera: [f32; 7]) -> Result<(), BuildError> {
    let builder = BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        ..BvhBuilder::default()
    };
    let (time, bvh) = timed(|| builder.build(triangles));
    let bvh = bvh?;
    describe("bvh-sweep", time, &bvh, &builder.heuristic);
    let mut trees = Vec::new();
    for (name, builder) in variants() {
        let (time, tree) = timed(|| builder.build(triangles));
        let tree = tree?;
        describe(name, time, &tree, &builder.heuristic);
        trees.push((name, tree));
    }
    let primary = primary_rays(camera, IMAGE);
    let paths = bounces(&bvh, &primary);
    for (kind, rays) in [("primary", &primary), ("path", &paths)] {
        print_counts(kind, "bvh-sweep", &bvh, rays);
        for (name, tree) in &trees {
            print_counts(kind, name, tree, rays);
            let differ = |ray: &&RaySegment| tree.closest_hit(*ray) != bvh.closest_hit(*ray);
            let disagreements = rays.iter().filter(differ).count();
            assert_eq!(disagreements, 0, "{name} disagrees with the BVH");
        }
        print_times(kind, &bvh, &trees, rays);
    }
    let primary = primary_rays(camera, PACKETS_IMAGE);
    print_packets("bvh-sweep", &bvh, &primary);
    print_packets(trees[0].0, &trees[0].1, &primary);
    Ok(())
}

/// The settings compared; another set with `VARIANTS=termination`.
fn variants() -> Vec<(&'static str, KdTreeBuilder)> {
    let default = KdTreeBuilder::default();
    let binned = KdTreeBuilder {
        search: PlaneSearch::binned(),
        ..default
    };
    let boxes = |builder| KdTreeBuilder {
        clips_primitives: false,
        ..builder
    };
    let terminated = |termination| KdTreeBuilder {
        termination,
        ..default
    };
    if std::env::var_os("VARIANTS").is_some() {
        let costs = |traversal_cost, empty_bonus| KdTreeBuilder {
            heuristic: SurfaceAreaHeuristic {
                traversal_cost,
                intersection_cost: 20.0,
            },
            empty_bonus,
            ..default
        };
        return vec![
            ("default", default),
            ("K_T 30", costs(30.0, 0.2)),
            ("K_T 45", costs(45.0, 0.2)),
            ("K_T 60", costs(60.0, 0.2)),
            ("15, none", costs(15.0, 0.0)),
            ("30, none", costs(30.0, 0.0)),
            ("45, none", costs(45.0, 0.0)),
            ("30, half", costs(30.0, 0.1)),
            (
                "refines 1",
                terminated(Termination::BadRefines { allowed: 1 }),
            ),
            (
                "refines 3",
                terminated(Termination::BadRefines { allowed: 3 }),
            ),
            (
                "manual 2",
                terminated(Termination::Manual { max_leaf_size: 2 }),
            ),
        ];
    }
    vec![
        ("sweep", default),
        ("sweep boxes", boxes(default)),
        ("binned", binned),
        ("binned boxes", boxes(binned)),
    ]
}

fn describe(
    name: &str,
    milliseconds: f64,
    structure: &impl AccelerationStructure,
    heuristic: &SurfaceAreaHeuristic,
) {
    let statistics = structure.tree_statistics(heuristic);
    let histogram = &statistics.leaf_histogram;
    let many: usize = histogram.iter().skip(8).sum();
    println!(
        "{name:13} {milliseconds:7.0} ms  nodes {:8}  depth {:3}  references {:8} ({:.2})  SAH \
         {:.2}  MB {:.1}  leaves by size {:?}, 8 and more: {many}, most {}",
        statistics.nodes(),
        statistics.depth,
        statistics.references,
        statistics.duplication(),
        statistics.sah_cost / heuristic.intersection_cost,
        structure.bytes().total() as f64 / 1e6,
        &histogram[..histogram.len().min(8)],
        histogram.len() - 1,
    );
}

fn print_counts(
    kind: &str,
    name: &str,
    structure: &impl AccelerationStructure,
    rays: &[RaySegment],
) {
    let mut counters = TraversalCounters::default();
    for ray in rays {
        structure.closest_hit_with(ray, &mut counters);
    }
    println!(
        "{kind:8} {name:13} nodes {:6.2}  of these leaves {:5.2}  primitive tests {:6.2}",
        counters.mean(&counters.nodes),
        counters.mean(&counters.leaves),
        counters.mean(&counters.primitive_tests),
    );
}

fn print_times(
    kind: &str,
    bvh: &Bvh<Triangle>,
    trees: &[(&str, KdTree<Triangle>)],
    rays: &[RaySegment],
) {
    let mut ratios = vec![Vec::new(); trees.len()];
    let mut rates = Vec::new();
    for rays in (0..ROUNDS).flat_map(|_| rays.chunks(TURN)) {
        let bvh_time = answer(bvh, rays);
        rates.push(rays.len() as f64 / bvh_time / 1e3);
        for (ratios, (_, tree)) in ratios.iter_mut().zip(trees) {
            ratios.push(bvh_time / answer(tree, rays));
        }
    }
    println!(
        "{kind:8} bvh-sweep {:.2} Mrays/s; speed against it:",
        median(rates)
    );
    for ((name, _), ratios) in trees.iter().zip(ratios) {
        println!("{kind:8} {name:13} {:.2}", median(ratios));
    }
}

/// Speed of packets against single rays.
fn print_packets<A>(name: &str, structure: &A, rays: &[RaySegment])
where
    A: PacketTraversal<8> + PacketTraversal<16> + PacketTraversal<64>,
{
    let mut ratios = [const { Vec::new() }; 3];
    for rays in (0..ROUNDS).flat_map(|_| rays.chunks(TURN)) {
        let single = answer(structure, rays);
        let times = [
            answer_in_packets::<8, A>(structure, rays),
            answer_in_packets::<16, A>(structure, rays),
            answer_in_packets::<64, A>(structure, rays),
        ];
        for (ratios, time) in ratios.iter_mut().zip(times) {
            ratios.push(single / time);
        }
    }
    let [eight, sixteen, many] = ratios.map(median);
    println!("packets  {name:13} of 8: {eight:.2}x, of 16: {sixteen:.2}x, of 64: {many:.2}x");
}

#[inline(never)]
fn answer_in_packets<const N: usize, A: PacketTraversal<N>>(
    structure: &A,
    rays: &[RaySegment],
) -> f64 {
    let mut hits = vec![None; rays.len()];
    let (time, ()) = timed(|| structure.trace_closest_packets(rays, &mut hits));
    let is_single = |(ray, hit)| structure.closest_hit(ray) == hit;
    assert!(
        rays.iter().zip(hits).all(is_single),
        "packets of {N} disagree"
    );
    time
}

/// Milliseconds for all rays.
#[inline(never)]
fn answer(structure: &impl AccelerationStructure, rays: &[RaySegment]) -> f64 {
    let (time, ()) = timed(|| {
        for ray in rays {
            black_box(structure.closest_hit(black_box(ray)));
        }
    });
    time
}

fn timed<T>(run: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = run();
    (start.elapsed().as_secs_f64() * 1e3, result)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn parse_numbers(text: &str) -> Result<[f32; 7], Box<dyn Error>> {
    let numbers: Vec<f32> = text
        .split([',', ';'])
        .map(str::parse)
        .collect::<Result<_, _>>()?;
    numbers
        .try_into()
        .map_err(|_| "a camera takes seven numbers".into())
}

fn in_front_of(triangles: &[Triangle]) -> [f32; 7] {
    let bounds = triangles.iter().fold(Aabb::EMPTY, |bounds, triangle| {
        bounds.union(&triangle.bounds())
    });
    let at = bounds.center();
    let distance = bounds.largest_extent() as f32 * 1.5;
    [at.x, at.y, at.z + distance, at.x, at.y, at.z, 40.0]
}

/// One ray through the middle of every pixel of a square image, in tiles of 8 by
/// 8 pixels and of these in blocks of 4 by 2.
fn primary_rays([x, y, z, at_x, at_y, at_z, degrees]: [f32; 7], side: usize) -> Vec<RaySegment> {
    let eye = Vec3::new(x, y, z);
    let forward = (Vec3::new(at_x, at_y, at_z) - eye).normalize();
    let right = forward.cross(Vec3::Y).normalize();
    let up = right.cross(forward);
    let half = (degrees.to_radians() / 2.0).tan();
    let offset = |pixel: usize| ((pixel as f32 + 0.5) / side as f32 * 2.0 - 1.0) * half;
    let pixels = (0..side * side).map(|index| {
        let (tile, within) = (index / 64, index % 64);
        let (block, lane) = (within / 8, within % 8);
        let column = tile % (side / 8) * 8 + block % 2 * 4 + lane % 4;
        (column, tile / (side / 8) * 8 + block / 2 * 2 + lane / 4)
    });
    pixels
        .map(|(column, row)| {
            RaySegment::new(eye, forward + right * offset(column) - up * offset(row))
        })
        .collect()
}

/// Up to five diffuse bounces from where the rays hit.
fn bounces(bvh: &Bvh<Triangle>, primary: &[RaySegment]) -> Vec<RaySegment> {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let mut rays = Vec::new();
    for first in primary.iter().step_by(4) {
        let mut ray = *first;
        for _ in 0..5 {
            let Some(hit) = bvh.closest_hit(&ray) else {
                break;
            };
            let surface = bvh.surface(&ray, &hit).expect("the hit is of this tree");
            let normal = surface.normal.normalize_or(Vec3::Y);
            let side = if normal.dot(ray.direction) > 0.0 {
                -1.0
            } else {
                1.0
            };
            let direction = normal * side + on_sphere(&mut random);
            ray = RaySegment::new(surface.origin_towards(direction), direction);
            rays.push(ray);
        }
    }
    rays
}

fn on_sphere(random: &mut Pcg64Mcg) -> Vec3 {
    loop {
        let point = Vec3::from([0; 3].map(|_| random.random_range(-1.0..1.0_f32)));
        let length = point.length();
        if (0.01..1.0).contains(&length) {
            return point / length;
        }
    }
}
