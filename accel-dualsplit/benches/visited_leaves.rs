//! Holds the leaves that rays visit in converted trees against those of the BVH that
//! they come from, on meshes given as OBJ files of triangles: all hits are asked for,
//! so that no interval shrinks. *Identical* trees, BIH and H-tree must visit the same
//! leaves, *similar* trees at least these.
//!
//! ```sh
//! cargo bench -p accel-dualsplit --bench visited_leaves -- bunny.obj
//! ```
//!
//! A million rays a mesh, between random points of its box; `RAYS` sets another
//! number.
#![allow(clippy::print_stdout)]

#[path = "../tests/suite/recorder.rs"]
mod recorder;

use accel_core::testing::{bench_arguments, mesh_file};
use accel_dualsplit::glam::Vec3;
use accel_dualsplit::{AccelerationStructure, BvhBuilder, ObjectSplit, RaySegment};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use recorder::{Trees, recorders};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count: usize = std::env::var("RAYS").map_or(Ok(1_000_000), |count| count.parse())?;
    let builder = BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        ..BvhBuilder::default()
    };
    for path in bench_arguments() {
        let triangles = mesh_file::load(&path)?;
        println!("{path}: {} triangles", triangles.len());
        let trees = Trees::new(&builder, &recorders(&triangles))?;
        compare(&trees, count)?;
    }
    Ok(())
}

fn compare(trees: &Trees, count: usize) -> Result<(), Box<dyn std::error::Error>> {
    let bounds = trees.bvh.bounds().ok_or("the mesh is empty")?;
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let mut point = || {
        let share = Vec3::from([0; 3].map(|_| random.random_range(-0.2..1.2_f32)));
        bounds.min + (bounds.max - bounds.min) * share
    };
    let (mut visited, mut more, mut lacking) = (0_usize, 0_usize, 0_usize);
    let mut different = [0_usize; 3];
    for _ in 0..count {
        let origin = point();
        let visits = trees.visits(&RaySegment::new(origin, point() - origin));
        for (different, is_same) in different.iter_mut().zip(visits.are_same) {
            *different += usize::from(!is_same);
        }
        lacking += usize::from(!visits.similar_has_all);
        visited += visits.in_bvh;
        more += visits.more_in_similar;
    }
    let [identical, bih, h_tree] = different;
    println!(
        "  {count} rays, {visited} references in visited leaves; rays with other leaves: identical \
         {identical}, BIH {bih}, H-tree {h_tree}; similar lacks some for {lacking}, and visits \
         {:.2} % more",
        100.0 * more as f64 / visited.max(1) as f64
    );
    Ok(())
}
