//! Holds dual-split trees against the BVH that they come from: size, conversion,
//! visits and time per ray, on meshes given as OBJ files of triangles.
//!
//! ```sh
//! cargo run --release -p accel-dualsplit --example against_bvh -- bunny.obj
//! ```
//!
//! Rays are paths with up to five diffuse bounces (Lin 2019, section 5), recorded
//! once; the structures then answer the same rays on one thread, in turns of a
//! few thousand rays. Ratios are medians over all turns.
#![allow(clippy::print_stdout)]

use std::hint::black_box;
use std::time::Instant;

use accel_dualsplit::glam::Vec3;
use accel_dualsplit::{
    AccelerationStructure, Bvh, BvhBuilder, DualSplitConverter, DualSplitTree, ObjectSplit,
    Partitioning, RaySegment, TraversalCounters, Triangle,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const PATHS: usize = 40_000;
const ROUNDS: usize = 7;
const TURN: usize = 4096;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for path in std::env::args().skip(1) {
        let triangles = triangles_of(&std::fs::read_to_string(&path)?)?;
        println!("{path}: {} triangles", triangles.len());
        compare(&triangles)?;
    }
    Ok(())
}

fn compare(triangles: &[Triangle]) -> Result<(), Box<dyn std::error::Error>> {
    let (binned_ms, _) = timed(|| BvhBuilder::default().build(triangles));
    let sweep = BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        ..BvhBuilder::default()
    };
    let (sweep_ms, bvh) = timed(|| sweep.build(triangles));
    let bvh = bvh?;
    println!("  build: sweep {sweep_ms:.0} ms, binned {binned_ms:.0} ms");
    let rays = paths(&bvh);
    let convert = |partitioning| {
        let converter = DualSplitConverter {
            partitioning,
            ..DualSplitConverter::default()
        };
        timed(|| converter.convert(&bvh))
    };
    let (identical_ms, identical) = convert(Partitioning::Identical);
    let (similar_ms, similar) = convert(Partitioning::Similar);
    let (identical, similar) = (identical?, similar?);
    println!("  convert: identical {identical_ms:.0} ms, similar {similar_ms:.0} ms");
    let source = count(&bvh, &rays);
    print_counts("bvh", &bvh, &source, &bvh, &source);
    for (name, tree) in [("identical", &identical), ("similar", &similar)] {
        print_counts(name, tree, &count(tree, &rays), &bvh, &source);
        println!("    {:?}", tree.node_statistics());
    }
    print_times(&bvh, [&identical, &similar], &rays);
    Ok(())
}

fn timed<T>(run: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = run();
    (start.elapsed().as_secs_f64() * 1e3, result)
}

fn count(structure: &impl AccelerationStructure, rays: &[RaySegment]) -> TraversalCounters {
    let mut counters = TraversalCounters::default();
    for ray in rays {
        structure.closest_hit_with(ray, &mut counters);
    }
    counters
}

fn print_counts(
    name: &str,
    structure: &impl AccelerationStructure,
    counters: &TraversalCounters,
    source: &Bvh<Triangle>,
    source_counters: &TraversalCounters,
) {
    let percent = |a: u64, b: u64| 100.0 * a as f64 / b as f64;
    println!(
        "  {name:10} bytes {} ({:.1}%)  per ray: planes {:.1} ({:.1}%)  nodes {:.1} ({:.1}%)  \
         primitives {:.2} ({:.1}%)",
        structure.node_bytes(),
        percent(structure.node_bytes() as u64, source.node_bytes() as u64),
        counters.mean(&counters.plane_tests),
        percent(counters.plane_tests.sum, source_counters.plane_tests.sum),
        counters.mean(&counters.nodes),
        percent(counters.nodes.sum, source_counters.nodes.sum),
        counters.mean(&counters.primitive_tests),
        percent(
            counters.primitive_tests.sum,
            source_counters.primitive_tests.sum
        ),
    );
}

fn print_times(bvh: &Bvh<Triangle>, trees: [&DualSplitTree<Triangle>; 2], rays: &[RaySegment]) {
    let mut ratios = [const { Vec::new() }; 2];
    let mut bvh_times = Vec::new();
    for rays in (0..ROUNDS).flat_map(|_| rays.chunks(TURN)) {
        let bvh_time = answer(bvh, rays);
        bvh_times.push(rays.len() as f64 / bvh_time / 1e3);
        for (ratios, tree) in ratios.iter_mut().zip(trees) {
            ratios.push(answer(tree, rays) / bvh_time);
        }
    }
    let [identical, similar] = ratios.map(median);
    println!(
        "  bvh {:.2} Mrays/s; time against it: identical {identical:.3}, similar {similar:.3}",
        median(bvh_times)
    );
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

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Paths from a camera outside or in the middle of the scene: the first ray and
/// up to five diffuse bounces.
fn paths(bvh: &Bvh<Triangle>) -> Vec<RaySegment> {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let bounds = bvh.bounds().expect("the scene is not empty");
    let extent = bounds.max - bounds.min;
    // Scenes of rooms are seen from inside, scans from outside.
    let is_inside = std::env::var_os("FROM_INSIDE").is_some();
    let distance = if is_inside { 0.3 } else { 1.2 };
    let eye = bounds.center() + Vec3::new(0.6, 0.1, 0.7).normalize() * extent * distance;
    let mut rays = Vec::new();
    for _ in 0..PATHS {
        let target = bounds.center() + extent * 0.4 * (in_cube(&mut random));
        let mut ray = RaySegment::new(eye, target - eye);
        for _ in 0..6 {
            rays.push(ray);
            let Some(hit) = bvh.closest_hit(&ray) else {
                break;
            };
            let surface = bvh.surface(&ray, &hit).expect("the hit is of this tree");
            let normal = surface.normal.normalize_or(Vec3::Y);
            let normal = if normal.dot(ray.direction) > 0.0 {
                -normal
            } else {
                normal
            };
            let direction = normal + on_sphere(&mut random);
            ray = RaySegment::new(surface.origin_towards(direction), direction);
        }
    }
    rays
}

fn in_cube(random: &mut Pcg64Mcg) -> Vec3 {
    Vec3::from([0; 3].map(|_| random.random_range(-1.0..1.0_f32)))
}

fn on_sphere(random: &mut Pcg64Mcg) -> Vec3 {
    loop {
        let point = in_cube(random);
        let length = point.length();
        if (0.01..1.0).contains(&length) {
            return point / length;
        }
    }
}

/// The triangles of an OBJ file; polygons are fanned.
fn triangles_of(text: &str) -> Result<Vec<Triangle>, Box<dyn std::error::Error>> {
    let mut vertices: Vec<Vec3> = Vec::new();
    let mut triangles = Vec::new();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let coordinates: Vec<f32> = words.map(str::parse).collect::<Result<_, _>>()?;
                vertices.push(Vec3::from_slice(&coordinates));
            }
            Some("f") => {
                let corners: Vec<Vec3> = words
                    .map(|word| {
                        let index: isize = word.split('/').next().unwrap_or_default().parse()?;
                        let index = if index < 0 {
                            vertices.len() as isize + index
                        } else {
                            index - 1
                        };
                        let vertex = vertices.get(index as usize).copied();
                        vertex.ok_or_else(|| format!("no vertex {word}").into())
                    })
                    .collect::<Result<_, Box<dyn std::error::Error>>>()?;
                for pair in corners[1..].windows(2) {
                    triangles.push(Triangle::new(corners[0], pair[0], pair[1]));
                }
            }
            _ => {}
        }
    }
    Ok(triangles)
}
