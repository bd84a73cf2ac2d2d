//! Primitives that remember being tested, and what follows from them: which leaves a
//! ray visits in the trees of one BVH. For the test and for the example of this name.

use std::cell::RefCell;

use accel_dualsplit::glam::Vec3;
use accel_dualsplit::{
    Aabb, AccelerationStructure, Bih, BihConverter, BuildError, Bvh, BvhBuilder,
    DualSplitConverter, DualSplitTree, HTree, HTreeConverter, Hit, Intersection, LeafOrdered,
    Partitioning, PreparedRay, Primitive, RaySegment, Triangle,
};

thread_local! {
    static TESTED: RefCell<Vec<u32>> = const { RefCell::new(Vec::new()) };
}

/// A triangle's box, which remembers that it was tested and is never hit.
#[derive(Clone)]
pub struct Recorder {
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

/// Of all triangles with finite corners.
pub fn recorders(triangles: &[Triangle]) -> Vec<Recorder> {
    let valid = triangles
        .iter()
        .map(Primitive::bounds)
        .filter(Aabb::is_valid);
    valid
        .zip(0..)
        .map(|(bounds, id)| Recorder { bounds, id })
        .collect()
}

/// The trees of one BVH.
pub struct Trees {
    pub bvh: Bvh<Recorder>,
    identical: DualSplitTree<Recorder>,
    similar: DualSplitTree<Recorder>,
    bih: Bih<Recorder>,
    h_tree: HTree<Recorder>,
}

/// What one ray visits.
pub struct Visits {
    /// References in the leaves that it visits in the BVH.
    pub in_bvh: usize,
    /// Whether these are the leaves that it visits in the *identical* tree, the BIH
    /// and the H-tree.
    pub are_same: [bool; 3],
    /// Whether it visits them in the *similar* tree, and how many references more.
    pub similar_has_all: bool,
    pub more_in_similar: usize,
}

impl Trees {
    pub fn new(builder: &BvhBuilder, recorders: &[Recorder]) -> Result<Self, BuildError> {
        let bvh = builder.build(recorders)?;
        let convert = |partitioning| {
            let converter = DualSplitConverter {
                partitioning,
                ..DualSplitConverter::default()
            };
            converter.convert(&bvh)
        };
        Ok(Self {
            identical: convert(Partitioning::Identical)?,
            similar: convert(Partitioning::Similar)?,
            bih: BihConverter::default().convert(&bvh)?,
            h_tree: HTreeConverter::default().convert(&bvh)?,
            bvh,
        })
    }

    /// Asks for all hits, so that the ray's interval does not shrink.
    pub fn visits(&self, ray: &RaySegment) -> Visits {
        let expected = tested(&self.bvh, ray);
        let superset = tested(&self.similar, ray);
        let mut rest = superset.iter();
        Visits {
            in_bvh: expected.len(),
            are_same: [
                tested(&self.identical, ray) == expected,
                tested(&self.bih, ray) == expected,
                tested(&self.h_tree, ray) == expected,
            ],
            similar_has_all: expected.iter().all(|id| rest.any(|other| other == id)),
            more_in_similar: superset.len().saturating_sub(expected.len()),
        }
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
