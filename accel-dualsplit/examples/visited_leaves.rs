//! Holds the leaves that rays visit in converted trees against those of the BVH that
//! they come from, on meshes given as OBJ files of triangles: all hits are asked for,
//! so that no interval shrinks. *Identical* trees, BIH and H-tree must visit the same
//! leaves, *similar* trees at least these.
//!
//! ```sh
//! cargo run --release -p accel-dualsplit --example visited_leaves -- bunny.obj
//! ```
//!
//! A million rays a mesh, between random points of its box; `RAYS` sets another
//! number.
#![allow(clippy::print_stdout)]

use std::cell::RefCell;

use accel_core::testing::mesh_file;
use accel_dualsplit::glam::Vec3;
use accel_dualsplit::{
    Aabb, AccelerationStructure, BihConverter, BvhBuilder, DualSplitConverter, HTreeConverter, Hit,
    Intersection, LeafOrdered, ObjectSplit, Partitioning, PreparedRay, Primitive, RaySegment,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

thread_local! {
    static TESTED: RefCell<Vec<u32>> = const { RefCell::new(Vec::new()) };
}

/// A triangle's box, which remembers that it was tested and is never hit.
#[derive(Clone)]
struct Recorder {
    bounds: Aabb,
    id: u32,
}

impl Primitive for Recorder {
    type Storage = LeafOrdered<Self>;

    fn bounds(&self) -> Aabb {
        self.bounds
    }

    fn intersect(&self, _: &PreparedRay) -> Option<Intersection> {
        TESTED.with_borrow_mut(|tested| tested.push(self.id));
        None
    }

    fn geometric_normal(&self, _: &Hit, _: Vec3) -> Vec3 {
        Vec3::Y
    }
}

/// The primitives of all leaves that a ray visits, in order of their ids.
fn tested(structure: &impl AccelerationStructure, ray: &RaySegment) -> Vec<u32> {
    structure.all_hits(ray);
    let mut tested = TESTED.take();
    tested.sort_unstable();
    tested
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for path in std::env::args().skip(1) {
        let triangles = mesh_file::load(&path)?;
        let boxes = triangles
            .iter()
            .map(Primitive::bounds)
            .filter(Aabb::is_valid);
        let recorders: Vec<Recorder> = boxes
            .zip(0..)
            .map(|(bounds, id)| Recorder { bounds, id })
            .collect();
        println!("{path}: {} triangles", triangles.len());
        compare(&recorders)?;
    }
    Ok(())
}

fn compare(recorders: &[Recorder]) -> Result<(), Box<dyn std::error::Error>> {
    let builder = BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        ..BvhBuilder::default()
    };
    let bvh = builder.build(recorders)?;
    let dual_split = |partitioning| {
        let converter = DualSplitConverter {
            partitioning,
            ..DualSplitConverter::default()
        };
        converter.convert(&bvh)
    };
    let identical = dual_split(Partitioning::Identical)?;
    let similar = dual_split(Partitioning::Similar)?;
    let bih = BihConverter::default().convert(&bvh)?;
    let h_tree = HTreeConverter::default().convert(&bvh)?;
    let bounds = bvh.bounds().ok_or("the mesh is empty")?;
    let count: usize = std::env::var("RAYS").map_or(Ok(1_000_000), |count| count.parse())?;
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let mut point = || {
        let share = Vec3::from([0; 3].map(|_| random.random_range(-0.2..1.2_f32)));
        bounds.min + (bounds.max - bounds.min) * share
    };
    let (mut visited, mut more) = (0_usize, 0_usize);
    let mut different = [0_usize; 4];
    for _ in 0..count {
        let origin = point();
        let ray = RaySegment::new(origin, point() - origin);
        let expected = tested(&bvh, &ray);
        different[0] += usize::from(tested(&identical, &ray) != expected);
        different[1] += usize::from(tested(&bih, &ray) != expected);
        different[2] += usize::from(tested(&h_tree, &ray) != expected);
        let superset = tested(&similar, &ray);
        let mut rest = superset.iter();
        let is_within = expected.iter().all(|id| rest.any(|other| other == id));
        different[3] += usize::from(!is_within);
        visited += expected.len();
        more += superset.len() - expected.len().min(superset.len());
    }
    let [identical, bih, h_tree, similar] = different;
    println!(
        "  {count} rays, {visited} references in visited leaves; rays with other leaves: identical \
         {identical}, BIH {bih}, H-tree {h_tree}; similar lacks some for {similar}, and visits {:.2} \
         % more",
        100.0 * more as f64 / visited.max(1) as f64
    );
    Ok(())
}
