//! The structures of the paper, all from one BVH.

use std::time::Instant;

use accel_bvh::{Bvh, BvhBuilder, CompactBvh, LeafRule, ObjectSplit};
use accel_core::{BuildError, InvalidPrimitives, Triangle};
use accel_dualsplit::{
    BihConverter, DualSplitConverter, HTreeConverter, NodeSet, NodeStatistics, Partitioning,
    PlaneTree,
};

use crate::registry::Structure;

/// A structure, and what is known of it.
pub(super) struct Method {
    pub name: &'static str,
    pub structure: Structure,
    pub nodes: usize,
    /// Of trees of planes.
    pub statistics: Option<NodeStatistics>,
    /// What converting it from the BVH took.
    pub conversion_seconds: f64,
}

/// The structures in the order of the table, the BVH first.
pub(super) struct Built {
    pub methods: Vec<Method>,
    /// What building the source took.
    pub sweep_seconds: f64,
    /// What a binned build takes.
    pub binned_seconds: f64,
}

/// Builds the source and converts it.
pub(super) fn build_all(
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
) -> Result<Built, BuildError> {
    let builder = |object_split| BvhBuilder {
        object_split,
        leaf_rule: LeafRule::SahUpTo(8),
        invalid_primitives,
        ..BvhBuilder::default()
    };
    let (binned_seconds, _) = timed(|| builder(ObjectSplit::default()).build(triangles))?;
    let (sweep_seconds, bvh) = timed(|| builder(ObjectSplit::FullSweep).build(triangles))?;
    let dual_split = |partitioning| DualSplitConverter {
        partitioning,
        ..DualSplitConverter::default()
    };
    let mut methods = vec![
        of_planes("dual-split identical", || {
            dual_split(Partitioning::Identical).convert(&bvh)
        })?,
        of_planes("dual-split similar", || {
            dual_split(Partitioning::Similar).convert(&bvh)
        })?,
        of_planes("BIH", || BihConverter::default().convert(&bvh))?,
        of_planes("H-tree", || HTreeConverter::default().convert(&bvh))?,
        compact(&bvh)?,
    ];
    let nodes = node_count(&bvh);
    let source = Method {
        name: "BVH",
        structure: Box::new(bvh),
        nodes,
        statistics: None,
        conversion_seconds: 0.0,
    };
    methods.insert(0, source);
    Ok(Built {
        methods,
        sweep_seconds,
        binned_seconds,
    })
}

fn timed<T>(build: impl FnOnce() -> Result<T, BuildError>) -> Result<(f64, T), BuildError> {
    let start = Instant::now();
    let built = build()?;
    Ok((start.elapsed().as_secs_f64(), built))
}

fn of_planes<N: NodeSet>(
    name: &'static str,
    convert: impl FnOnce() -> Result<PlaneTree<Triangle, N>, BuildError>,
) -> Result<Method, BuildError> {
    let (conversion_seconds, tree) = timed(convert)?;
    let statistics = tree.node_statistics();
    Ok(Method {
        name,
        nodes: statistics.nodes(),
        statistics: Some(statistics),
        structure: Box::new(tree),
        conversion_seconds,
    })
}

fn compact(bvh: &Bvh<Triangle>) -> Result<Method, BuildError> {
    let (conversion_seconds, tree) = timed(|| CompactBvh::from_bvh(bvh))?;
    Ok(Method {
        name: "Compact BVH",
        structure: Box::new(tree),
        nodes: node_count(bvh),
        statistics: None,
        conversion_seconds,
    })
}

/// Inner nodes and leaves.
fn node_count(bvh: &Bvh<Triangle>) -> usize {
    let bytes = size_of_val(bvh.node_words());
    let inner = bytes / (accel_bvh::INNER_NODE_BYTES + accel_bvh::LEAF_NODE_BYTES);
    if bytes == 0 { 0 } else { 2 * inner + 1 }
}
