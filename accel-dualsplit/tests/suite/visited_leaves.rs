//! Which leaves a query visits whose interval does not shrink: *identical* trees,
//! BIH and H-tree those of their BVH, no more and no fewer; *similar* trees at least
//! these.

use std::cell::RefCell;

use accel_core::testing::{families, rays};
use accel_dualsplit::glam::Vec3;
use accel_dualsplit::{
    Aabb, AccelerationStructure, BihConverter, BvhBuilder, DualSplitConverter, HTreeConverter, Hit,
    Intersection, LeafOrdered, LeafRule, ObjectSplit, Partitioning, PreparedRay, Primitive,
    RaySegment, Triangle,
};

thread_local! {
    static TESTED: RefCell<Vec<u32>> = const { RefCell::new(Vec::new()) };
}

/// Remembers that it was tested, and is never hit.
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

/// The primitives of the leaves that a ray visits, sorted.
fn tested(structure: &impl AccelerationStructure, ray: &RaySegment) -> Vec<u32> {
    TESTED.with_borrow_mut(Vec::clear);
    assert!(structure.all_hits(ray).is_empty());
    let mut tested = TESTED.take();
    tested.sort_unstable();
    tested
}

fn recorders(triangles: &[Triangle]) -> Vec<Recorder> {
    let valid = triangles
        .iter()
        .map(Primitive::bounds)
        .filter(Aabb::is_valid);
    valid
        .zip(0..)
        .map(|(bounds, id)| Recorder { bounds, id })
        .collect()
}

#[test]
fn identical_trees_visit_the_leaves_of_their_bvh_and_similar_ones_at_least_these() {
    let (mut visited, mut more) = (0_usize, 0_usize);
    for family in families::all() {
        for (seed, object_split, leaf_rule) in [
            (1, ObjectSplit::FullSweep, LeafRule::SahUpTo(8)),
            (2, ObjectSplit::default(), LeafRule::StopAt(1)),
        ] {
            let scene = family.scene(seed, 800.min(family.full_size));
            let primitives = recorders(&scene);
            let builder = BvhBuilder {
                object_split,
                leaf_rule,
                ..BvhBuilder::default()
            };
            let bvh = builder.build(&primitives).unwrap();
            let convert = |partitioning| {
                let converter = DualSplitConverter {
                    partitioning,
                    ..DualSplitConverter::default()
                };
                converter.convert(&bvh).unwrap()
            };
            let identical = convert(Partitioning::Identical);
            let similar = convert(Partitioning::Similar);
            let bih = BihConverter::default().convert(&bvh).unwrap();
            let h_tree = HTreeConverter::default().convert(&bvh).unwrap();
            for ray in rays::mixed(&scene, seed, 400) {
                let expected = tested(&bvh, &ray);
                let name = family.name;
                assert_eq!(tested(&identical, &ray), expected, "{name} {seed} {ray:?}");
                assert_eq!(tested(&bih, &ray), expected, "{name} {seed} {ray:?}");
                assert_eq!(tested(&h_tree, &ray), expected, "{name} {seed} {ray:?}");
                let superset = tested(&similar, &ray);
                let mut rest = superset.iter();
                let is_within = expected.iter().all(|id| rest.any(|other| other == id));
                assert!(is_within, "{name} {seed} {ray:?}");
                visited += expected.len();
                more += superset.len() - expected.len();
            }
        }
    }
    assert!(visited > 100_000 && more > 0, "{visited} {more}");
}
