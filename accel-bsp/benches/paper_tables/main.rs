//! The columns of Tables 2 and 3 of the paper (Ize 2008), measured: nodes of both
//! kinds and tests per ray, the hits of the unconfirmed mode that differ, leaves by
//! size, build time and peak memory.
//!
//! ```sh
//! cargo bench -p accel-bsp --bench paper_tables -- bunny.obj skinny-cylinder-rotated
//! ```
//!
//! A scene is an OBJ file of polygons, or the name of a family of the test scenes.
//! Before the scenes, `--epsilon` sweeps the epsilon of the build and compares with
//! brute force, `--costs` sweeps the cost of a test (section 5.1), `--planes` tries
//! the candidate planes of section 6.1, `--growth` tells how build times grow, and
//! `--exhaustive N` compares with the exhaustive search on the first N triangles.
#![allow(clippy::print_stdout)]

mod rays;
mod scene;
mod sweeps;

use std::time::Instant;

use accel_bsp::{
    AccelerationStructure, BspBuilder, BspCosts, BspTree, Hit, RaySegment, TraversalCounters,
    Triangle, UnconfirmedHit,
};
use accel_core::testing::bench_arguments;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let mut options = sweeps::Options::default();
    let mut arguments = bench_arguments();
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--epsilon" => options.epsilon = true,
            "--costs" => options.costs = true,
            "--planes" => options.planes = true,
            "--growth" => options.growth = true,
            "--exhaustive" => {
                options.exhaustive = arguments.next().ok_or("--exhaustive N")?.parse()?;
            }
            name => {
                let triangles = scene::load(name)?;
                println!("{name}: {} triangles", triangles.len());
                if options.is_default() {
                    print_tables(&triangles)?;
                } else {
                    sweeps::run(&options, &triangles)?;
                }
            }
        }
    }
    Ok(())
}

fn print_tables(triangles: &[Triangle]) -> Result<(), Failure> {
    let variants = [
        ("BSP-orig", BspBuilder::original()),
        ("BSP", BspBuilder::default()),
        ("BSP-tri", BspBuilder::with_planar_leaves()),
        ("BSP-tri unconfirmed", BspBuilder::with_bounded_leaves()),
    ];
    println!("  Table 3");
    let mut trees = Vec::new();
    for (name, builder) in variants {
        let built = Built::new(&builder, triangles)?;
        println!("    {name:20} {}", built.describe());
        trees.push((name, built.tree));
    }
    let tree = &trees[0].1;
    for (kind, rays) in [
        ("ray cast", rays::camera(tree)),
        ("path traced", rays::paths(tree)),
    ] {
        println!("  Table 2, {kind}: {} rays", rays.len());
        for (name, tree) in &trees {
            let is_unconfirmed = tree.shape().bounded_leaves > 0;
            let (counters, differing) = count(tree, &rays, is_unconfirmed);
            println!("    {name:20} {}", per_ray(&counters));
            if is_unconfirmed {
                println!(
                    "    {differing} of {} hits differ from the kernel's",
                    rays.len()
                );
            }
        }
    }
    Ok(())
}

/// A tree, and what its build took.
pub(crate) struct Built {
    pub tree: BspTree<Triangle>,
    pub seconds: f64,
    peak_bytes: Option<u64>,
}

impl Built {
    pub(crate) fn new(builder: &BspBuilder, triangles: &[Triangle]) -> Result<Self, Failure> {
        scene::reset_peak_memory();
        let start = Instant::now();
        let tree = builder.build(triangles)?;
        Ok(Self {
            tree,
            seconds: start.elapsed().as_secs_f64(),
            peak_bytes: scene::peak_memory(),
        })
    }

    /// The rows of Table 3.
    pub(crate) fn describe(&self) -> String {
        let shape = self.tree.shape();
        let inner = shape.axis_aligned + shape.general;
        let leaves = |size| shape.leaves_by_size.get(size).copied().unwrap_or(0);
        let more: usize = shape.leaves_by_size.iter().skip(5).sum();
        let filled: usize = shape.leaves_by_size.iter().skip(1).sum();
        let peak = self.peak_bytes.map_or("unknown".into(), |bytes| {
            format!("{:.0} MB", bytes as f64 / 1e6)
        });
        format!(
            "{:.2} s, peak {peak}, depth {}, nodes {}, kd {:.1} %, leaves of 0 to 4: {:?}, more: \
             {more}, most {}, single {:.2} % of the filled, bounded {}, cost {:.3}",
            self.seconds,
            self.tree.depth(),
            inner + shape.leaves_by_size.iter().sum::<usize>(),
            100.0 * shape.axis_aligned as f64 / inner.max(1) as f64,
            [0, 1, 2, 3, 4].map(leaves),
            shape.leaves_by_size.len().saturating_sub(1),
            100.0 * leaves(1) as f64 / filled.max(1) as f64,
            shape.bounded_leaves,
            cost(&self.tree),
        )
    }
}

/// By the default costs, whatever the tree was built with.
pub(crate) fn cost(tree: &BspTree<Triangle>) -> f64 {
    let cost = tree.surface_area_cost(&BspCosts::default());
    cost.unwrap_or_default()
}

/// What the rays take, and of the unconfirmed hits, how many differ from those of
/// the kernel.
pub(crate) fn count(
    tree: &BspTree<Triangle>,
    rays: &[RaySegment],
    is_unconfirmed: bool,
) -> (TraversalCounters, usize) {
    let mut counters = TraversalCounters::default();
    let mut differing = 0;
    for ray in rays {
        if is_unconfirmed {
            let hit = tree.closest_hit_unconfirmed_with(ray, &mut counters);
            differing += usize::from(differs(hit, tree.closest_hit(ray)));
        } else {
            tree.closest_hit_with(ray, &mut counters);
        }
    }
    (counters, differing)
}

/// Another primitive, or another place.
fn differs(hit: Option<UnconfirmedHit>, expected: Option<Hit>) -> bool {
    match (hit, expected) {
        (Some(hit), Some(expected)) => {
            hit.id != expected.id || (hit.t - expected.t).abs() > 1e-4 * expected.t
        }
        (hit, expected) => hit.is_some() != expected.is_some(),
    }
}

/// The columns of Table 2.
pub(crate) fn per_ray(counters: &TraversalCounters) -> String {
    let inner = counters.nodes.sum - counters.leaves.sum;
    let traversal_based = counters.plane_tests.sum - inner - 6 * counters.box_tests.sum;
    let mean = |sum: u64| sum as f64 / counters.rays.max(1) as f64;
    format!(
        "tests: standard {:.3}, traversal-based {:.3}; nodes: BSP {:.2}, kd {:.2}, leaves {:.2}",
        mean(counters.primitive_tests.sum),
        mean(traversal_based),
        mean(counters.general_nodes.sum),
        mean(inner - counters.general_nodes.sum),
        mean(counters.leaves.sum),
    )
}
