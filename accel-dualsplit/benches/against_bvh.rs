//! Holds dual-split trees against the BVH that they come from: size, conversion,
//! visits and time per ray, on meshes given as OBJ files of triangles.
//!
//! ```sh
//! cargo bench -p accel-dualsplit --bench against_bvh -- bunny.obj
//! ```
//!
//! Rays are paths with up to five diffuse bounces (Lin 2019, section 5), recorded
//! once; the structures then answer the same rays on one thread, in turns of a
//! few hundred rays. In its turn a structure answers twice: first when the others have
//! taken the caches, then from its own. The least time of each turn over all rounds
//! counts, so that a busy machine disturbs little. With `ONLY=NAME` in the environment
//! one structure is asked, once, so that a profiler can count what it does; with
//! `FROM_INSIDE` the camera stands in the middle of the scene.
#![allow(clippy::print_stdout)]

use std::hint::black_box;
use std::time::Instant;

use accel_bvh::CompactBvh;
use accel_core::testing::{bench_arguments, mesh_file};
use accel_dualsplit::glam::Vec3;
use accel_dualsplit::{
    AccelerationStructure, BihConverter, Bvh, BvhBuilder, DualSplitBuilder, DualSplitConverter,
    HTreeConverter, ObjectSplit, Partitioning, RaySegment, TraversalCounters, Triangle,
    WideDualSplitTree,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const ROUNDS: usize = 15;
const TURN: usize = 400;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for path in bench_arguments() {
        let triangles = mesh_file::load(&path)?;
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
    let (direct_ms, direct) = timed(|| DualSplitBuilder::default().build(triangles));
    let direct = direct?;
    println!(
        "  convert: identical {identical_ms:.0} ms, similar {similar_ms:.0} ms; direct build \
         {direct_ms:.0} ms"
    );
    let (refit_ms, refitted) = timed(|| similar.clone().refit(triangles));
    refitted?;
    println!("  copy and refit: similar {refit_ms:.0} ms");
    let source = count(&bvh, &rays);
    print_counts("bvh", &bvh, &source, &bvh, &source);
    let trees = [
        ("identical", &identical),
        ("similar", &similar),
        ("direct", &direct),
    ];
    for (name, tree) in trees {
        print_counts(name, tree, &count(tree, &rays), &bvh, &source);
        println!("    {:?}", tree.node_statistics());
    }
    let bih = BihConverter::default().convert(&bvh)?;
    let h_tree = HTreeConverter::default().convert(&bvh)?;
    let compact = CompactBvh::from_bvh(&bvh)?;
    print_counts("bih", &bih, &count(&bih, &rays), &bvh, &source);
    print_counts("h-tree", &h_tree, &count(&h_tree, &rays), &bvh, &source);
    print_counts("compact", &compact, &count(&compact, &rays), &bvh, &source);
    let (wide_ms, wide) = timed(|| WideDualSplitTree::from_bvh(&bvh));
    let wide = wide?;
    print_counts("wide", &wide, &count(&wide, &rays), &bvh, &source);
    println!("  convert: wide {wide_ms:.0} ms");
    let names = [
        "BVH",
        "identical",
        "similar",
        "direct",
        "BIH",
        "H-tree",
        "Compact BVH",
        "wide",
    ];
    let answers: [Answer<'_>; 8] = [
        &|rays| answer(&bvh, rays),
        &|rays| answer(&identical, rays),
        &|rays| answer(&similar, rays),
        &|rays| answer(&direct, rays),
        &|rays| answer(&bih, rays),
        &|rays| answer(&h_tree, rays),
        &|rays| answer(&compact, rays),
        &|rays| answer(&wide, rays),
    ];
    if let Ok(only) = std::env::var("ONLY") {
        let named = names
            .iter()
            .zip(&answers)
            .filter(|(name, _)| **name == only);
        named.for_each(|(_, answer)| _ = answer(&rays));
        println!("  {} rays", rays.len());
        return Ok(());
    }
    print_times(&names, &answers, &rays);
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

/// The milliseconds that a structure takes for some rays.
type Answer<'a> = &'a dyn Fn(&[RaySegment]) -> f64;

/// Times of the structures behind the first one, against its.
fn print_times(names: &[&str], answers: &[Answer<'_>], rays: &[RaySegment]) {
    let turns: Vec<_> = rays.chunks(TURN).collect();
    let mut least = vec![vec![[f64::INFINITY; 2]; turns.len()]; answers.len()];
    for _ in 0..ROUNDS {
        for (turn, rays) in turns.iter().enumerate() {
            for (least, answer) in least.iter_mut().zip(answers) {
                for time in &mut least[turn] {
                    *time = time.min(answer(rays));
                }
            }
        }
    }
    let sums = least.iter().map(|turns| {
        let sum = |again: usize| -> f64 { turns.iter().map(|times| times[again]).sum() };
        [sum(0), sum(1)]
    });
    let sums: Vec<_> = sums.collect();
    let [cold, warm] = sums[0].map(|ms| rays.len() as f64 / ms / 1e3);
    println!("  bvh {cold:.2} and {warm:.2} Mrays/s, first and second; times against it:");
    for (name, sum) in names.iter().zip(&sums).skip(1) {
        let [cold, warm] = [sum[0] / sums[0][0], sum[1] / sums[0][1]];
        println!("    {name:18} {cold:.3} {warm:.3}");
    }
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

/// 40,000 unless the environment variable `PATHS` tells another number: fewer are
/// enough to count instructions.
fn path_count() -> usize {
    let count = std::env::var("PATHS").ok();
    count.and_then(|count| count.parse().ok()).unwrap_or(40_000)
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
    for _ in 0..path_count() {
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
