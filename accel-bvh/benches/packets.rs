//! Packets against single rays on the primary rays of meshes given as OBJ files
//! of triangles.
//!
//! ```sh
//! cargo bench -p accel-bvh --bench packets -- bunny.obj
//! ```
//!
//! One thread answers the rays in tiles of 8 by 8 pixels, again row by row, and
//! as many rays between random points around the scene, which share nothing;
//! single rays and packets of every width take turns of a few thousand rays.
//! Ratios are medians over all turns. Every hit is compared, bit for bit.
#![allow(clippy::print_stdout)]

use std::hint::black_box;
use std::time::Instant;

use accel_bvh::accel_core::simd::SimdLevel;
use accel_bvh::glam::Vec3;
use accel_bvh::{
    AccelerationStructure, Bvh, BvhBuilder, ClosestHit, Hit, ObjectSplit, PacketTraversal,
    RaySegment, TraversalCounters, Triangle,
};
use accel_core::testing::{bench_arguments, mesh_file};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const SIDE: usize = 512;
const ROUNDS: usize = 5;
const TURN: usize = 4096;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for path in bench_arguments() {
        let triangles = mesh_file::load(&path)?;
        println!("{path}: {} triangles", triangles.len());
        let builder = BvhBuilder {
            object_split: ObjectSplit::FullSweep,
            ..BvhBuilder::default()
        };
        let bvh = builder.build(&triangles)?;
        let rows = primary_rays(&bvh);
        let tiles = tiles(&rows);
        compare("tiles", &bvh, &tiles);
        compare("rows", &bvh, &rows);
        compare("random", &bvh, &random_rays(&bvh));
        count::<1>(&bvh, &tiles);
        count::<4>(&bvh, &tiles);
        count::<8>(&bvh, &tiles);
        count::<16>(&bvh, &tiles);
        count::<64>(&bvh, &tiles);
    }
    Ok(())
}

fn compare(order: &str, bvh: &Bvh<Triangle>, rays: &[RaySegment]) {
    let names = ["4", "8", "16", "64"];
    let mut ratios = [const { Vec::new() }; 4];
    let mut rates = Vec::new();
    let [mut single_hits, mut packet_hits] = [(); 2].map(|()| vec![None; TURN]);
    for rays in (0..ROUNDS).flat_map(|_| rays.chunks(TURN)) {
        let hits = &mut packet_hits[..rays.len()];
        let single = time(|| trace_single(bvh, rays, &mut single_hits));
        rates.push(rays.len() as f64 / single * 1e-6);
        let mut packets = |width: usize, trace: &dyn Fn(&mut [Option<Hit>])| {
            ratios[width].push(single / time(|| trace(hits)));
            assert_eq!(
                bits(hits),
                bits(&single_hits[..rays.len()]),
                "{order} {width}"
            );
        };
        packets(0, &|hits| {
            PacketTraversal::<4>::trace_closest_packets(bvh, rays, hits);
        });
        packets(1, &|hits| {
            PacketTraversal::<8>::trace_closest_packets(bvh, rays, hits);
        });
        packets(2, &|hits| {
            PacketTraversal::<16>::trace_closest_packets(bvh, rays, hits);
        });
        packets(3, &|hits| {
            PacketTraversal::<64>::trace_closest_packets(bvh, rays, hits);
        });
    }
    print!("  {order}: single {:.2} Mrays/s; packets of", median(rates));
    for (name, ratios) in names.iter().zip(ratios) {
        print!("  {name}: {:.2}x", median(ratios));
    }
    println!();
}

/// What packets of `N` do, by ray: a packet that visits a node visits it once,
/// and a vector that is tested against a box is tested once.
fn count<const N: usize>(bvh: &Bvh<Triangle>, rays: &[RaySegment]) {
    let mut counters = TraversalCounters::default();
    let level = SimdLevel::detect();
    PacketTraversal::<N>::query_packets(
        bvh,
        level,
        rays,
        &mut counters,
        ClosestHit::new,
        |_, _| (),
    );
    println!(
        "  packets of {N:2}: per ray {:.2} nodes, {:.2} of them leaves, {:.2} box tests, {:.2} triangles",
        counters.mean(&counters.nodes),
        counters.mean(&counters.leaves),
        counters.mean(&counters.box_tests),
        counters.mean(&counters.primitive_tests),
    );
}

#[inline(never)]
fn trace_single(bvh: &Bvh<Triangle>, rays: &[RaySegment], hits: &mut [Option<Hit>]) {
    for (ray, hit) in rays.iter().zip(hits) {
        *hit = bvh.closest_hit(ray);
    }
}

/// Seconds.
fn time(run: impl FnOnce()) -> f64 {
    let start = Instant::now();
    run();
    black_box(start.elapsed().as_secs_f64())
}

fn bits(hits: &[Option<Hit>]) -> Vec<Option<[u32; 4]>> {
    let bits = |hit: Hit| [hit.t.to_bits(), hit.u.to_bits(), hit.v.to_bits(), hit.id];
    hits.iter().map(|hit| hit.map(bits)).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// A ray through each pixel, row by row, from outside the scene, or from its
/// middle if `FROM_INSIDE` is set: rooms are seen from inside.
fn primary_rays(bvh: &Bvh<Triangle>) -> Vec<RaySegment> {
    let bounds = bvh.bounds().expect("the scene is not empty");
    let extent = bounds.max - bounds.min;
    let is_inside = std::env::var_os("FROM_INSIDE").is_some();
    let forward = Vec3::new(-0.7, -0.2, -0.6).normalize();
    let distance = if is_inside { 0.0 } else { 0.8 };
    let eye = bounds.center() - forward * extent.length() * distance;
    let right = forward.cross(Vec3::Y).normalize();
    let up = right.cross(forward);
    let pixel = |index: usize| (index as f32 + 0.5) / SIDE as f32 - 0.5;
    let rays = (0..SIDE * SIDE).map(|index| {
        let (x, y) = (pixel(index % SIDE), pixel(index / SIDE));
        RaySegment::new(eye, forward + right * x - up * y)
    });
    rays.collect()
}

/// Rays between random points of the sphere around the scene.
fn random_rays(bvh: &Bvh<Triangle>) -> Vec<RaySegment> {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let bounds = bvh.bounds().expect("the scene is not empty");
    let radius = 0.5 * (bounds.max - bounds.min).length();
    let mut point = || loop {
        let point = Vec3::from([0; 3].map(|_| random.random_range(-1.0..1.0_f32)));
        if (0.01..1.0).contains(&point.length()) {
            break bounds.center() + radius * point.normalize();
        }
    };
    let rays = (0..SIDE * SIDE / 4).map(|_| {
        let (from, to) = (point(), point());
        RaySegment::new(from, to - from)
    });
    rays.collect()
}

/// The same rays in tiles of 8 by 8 pixels, of these in blocks of 4 by 2.
fn tiles(rows: &[RaySegment]) -> Vec<RaySegment> {
    let tiles = SIDE / 8;
    let ray = |index: usize| {
        let (tile, within) = (index / 64, index % 64);
        let (block, lane) = (within / 8, within % 8);
        let x = tile % tiles * 8 + block % 2 * 4 + lane % 4;
        let y = tile / tiles * 8 + block / 2 * 2 + lane / 4;
        rows[y * SIDE + x]
    };
    (0..rows.len()).map(ray).collect()
}
