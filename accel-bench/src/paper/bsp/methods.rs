//! The structures of the paper: the BSP tree and its variants, the kd-tree, the
//! BVH; single rays and packets.

use std::time::Instant;

use accel_bsp::{BspBuilder, BspCosts, BspTree};
use accel_bvh::{BvhBuilder, ObjectSplit};
use accel_core::{
    AccelerationStructure, BuildError, DynStructure, InPackets, InvalidPrimitives, RaySegment,
    SurfaceAreaHeuristic, Triangle,
};
use accel_kdtree::KdTree;

use super::tuning::{self, BspTuning, KdTreeCosts, Tuned};
use super::unconfirmed::Unconfirmed;
use crate::registry::Structure;

/// A structure, and how it is asked.
pub(super) struct Method {
    pub name: &'static str,
    pub structure: Structure,
    pub way: Way,
}

/// How a structure answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// Ray by ray.
    Single,
    /// Ray by ray, hits not confirmed by the kernel.
    Unconfirmed,
    /// In packets of eight rays of one origin, or of the same signs.
    Packets,
    /// In packets that are traced whatever the rays, as the paper's BVH.
    AnyPackets,
}

/// What Table 3 tells of a tree.
pub(super) struct TreeFacts {
    pub name: &'static str,
    pub build_seconds: f64,
    pub depth: u32,
    pub axis_aligned: usize,
    pub general: usize,
    /// By the number of triangles, the number of leaves that hold as many.
    pub leaves_by_size: Vec<usize>,
    /// Of the leaves of one triangle, those that the traversal itself can answer.
    pub bounded_leaves: usize,
    pub node_bytes: usize,
    /// By the default costs of the BSP tree, whatever the tree was built with.
    pub surface_area_cost: f64,
}

/// Everything built over a scene.
pub(super) struct Built {
    /// The kd-tree with single rays first: the others are compared with it.
    pub methods: Vec<Method>,
    pub facts: Vec<TreeFacts>,
    pub tuned_kd_tree: Tuned<KdTreeCosts>,
    pub tuned_bsp_tri: Tuned<BspTuning>,
}

/// Builds all of them; the kd-tree and a BSP-tri are the fastest of several on `rays`.
pub(super) fn build_all(
    triangles: &[Triangle],
    invalid: InvalidPrimitives,
    rays: &[RaySegment],
) -> Result<Built, BuildError> {
    let (tuned_kd_tree, kd_tree) = tuning::kd_tree(triangles, invalid, rays)?;
    let (tuned_bsp_tri, fast_tri) = tuning::bsp_tri(triangles, invalid, rays)?;
    let mut facts = Vec::new();
    let variants = [
        ("BSP-orig", BspBuilder::original()),
        ("BSP", BspBuilder::default()),
        ("BSP-tri", BspBuilder::with_planar_leaves()),
        ("BSP-tri unconfirmed", BspBuilder::with_bounded_leaves()),
    ];
    let mut trees = Vec::new();
    for (name, mut builder) in variants {
        builder.invalid_primitives = invalid;
        let (build_seconds, tree) = timed(|| builder.build(triangles))?;
        facts.push(of_bsp(name, &tree, build_seconds));
        trees.push(tree);
    }
    let seconds = tuned_bsp_tri.build_seconds;
    facts.push(of_bsp("BSP-tri tuned", &fast_tri, seconds));
    let seconds = tuned_kd_tree.build_seconds;
    facts.push(of_kd_tree("kd-tree", &kd_tree, seconds));
    let [original, bsp, tri, bounded] = trees.try_into().expect("there are four variants");
    let bvh = BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        invalid_primitives: invalid,
        ..BvhBuilder::default()
    };
    let bvh = bvh.build(triangles)?;
    let method = |name, structure, way| Method {
        name,
        structure,
        way,
    };
    let methods = vec![
        method("kd-tree", Box::new(kd_tree.clone()), Way::Single),
        method("BSP-orig", Box::new(original), Way::Single),
        method("BSP", Box::new(bsp.clone()), Way::Single),
        method("BSP-tri", Box::new(tri.clone()), Way::Single),
        method(
            facts[3].name,
            Box::new(Unconfirmed(bounded)),
            Way::Unconfirmed,
        ),
        method(facts[4].name, Box::new(fast_tri), Way::Single),
        method(
            "kd-tree packets",
            Box::new(InPackets::<_, 8>(kd_tree)),
            Way::Packets,
        ),
        method(
            "BSP packets",
            Box::new(InPackets::<_, 8>(bsp)),
            Way::Packets,
        ),
        method(
            "BSP-tri packets",
            Box::new(InPackets::<_, 8>(tri)),
            Way::Packets,
        ),
        method(
            "BVH packets",
            Box::new(InPackets::<_, 8>(bvh)),
            Way::AnyPackets,
        ),
    ];
    Ok(Built {
        methods,
        facts,
        tuned_kd_tree,
        tuned_bsp_tri,
    })
}

impl Built {
    /// BSP-tri, every hit confirmed.
    pub(super) fn bsp_tri(&self) -> (&TreeFacts, &dyn DynStructure) {
        (&self.facts[2], self.methods[3].structure.as_ref())
    }
}

/// What `build` yields, and the seconds that it takes.
pub(super) fn timed<T>(
    build: impl FnOnce() -> Result<T, BuildError>,
) -> Result<(f64, T), BuildError> {
    let start = Instant::now();
    let built = build()?;
    Ok((start.elapsed().as_secs_f64(), built))
}

/// The facts of a BSP tree.
pub(super) fn of_bsp(
    name: &'static str,
    tree: &BspTree<Triangle>,
    build_seconds: f64,
) -> TreeFacts {
    let shape = tree.shape();
    let cost = tree.surface_area_cost(&BspCosts::default());
    TreeFacts {
        name,
        build_seconds,
        depth: tree.depth(),
        axis_aligned: shape.axis_aligned,
        general: shape.general,
        leaves_by_size: shape.leaves_by_size,
        bounded_leaves: shape.bounded_leaves,
        node_bytes: tree.node_bytes(),
        surface_area_cost: cost.unwrap_or_default(),
    }
}

fn of_kd_tree(name: &'static str, tree: &KdTree<Triangle>, build_seconds: f64) -> TreeFacts {
    let costs = BspCosts::default();
    let heuristic = SurfaceAreaHeuristic {
        traversal_cost: costs.axis_aligned,
        intersection_cost: costs.intersection,
    };
    let statistics = tree.tree_statistics(&heuristic);
    TreeFacts {
        name,
        build_seconds,
        depth: tree.depth(),
        axis_aligned: statistics.inner_nodes,
        general: 0,
        leaves_by_size: statistics.leaf_histogram,
        bounded_leaves: 0,
        node_bytes: tree.node_bytes(),
        surface_area_cost: statistics.sah_cost,
    }
}

impl TreeFacts {
    /// Nodes of all kinds.
    pub(super) fn nodes(&self) -> usize {
        self.axis_aligned + self.general + self.leaves_by_size.iter().sum::<usize>()
    }

    /// Leaves that hold `size` triangles.
    pub(super) fn leaves_of(&self, size: usize) -> usize {
        self.leaves_by_size.get(size).copied().unwrap_or(0)
    }

    /// Leaves that hold more than `size` triangles.
    pub(super) fn leaves_above(&self, size: usize) -> usize {
        self.leaves_by_size.iter().skip(size + 1).sum()
    }

    /// Of the leaves that hold triangles, the percentage that holds one.
    pub(super) fn single_percentage(&self) -> f64 {
        100.0 * self.leaves_of(1) as f64 / self.leaves_above(0).max(1) as f64
    }
}
