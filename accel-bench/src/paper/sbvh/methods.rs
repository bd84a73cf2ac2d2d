//! The four methods of Table 1.

use std::time::Instant;

use accel_bvh::{BvhBuilder, LeafRule, ObjectSplit};
use accel_core::{
    AccelerationStructure, BuildError, InvalidPrimitives, SurfaceAreaHeuristic, TreeStatistics,
    Triangle,
};
use accel_sbvh::presplit::{EarlySplitClipping, EdgeVolumeHeuristic, Threshold};
use accel_sbvh::{ReferenceLimit, SbvhBuilder, Spending, SplitStatistics};

use crate::registry::Structure;

/// All methods split until a node holds eight references or fewer (section 5).
const LEAF_RULE: LeafRule = LeafRule::StopAt(8);

/// References per triangle that the SBVH may have. The paper has no limit; its worst
/// case has 2.03.
pub(super) const LIMIT: f64 = 2.0;

/// A tree, and what is known of it.
pub(super) struct Method {
    pub name: &'static str,
    pub structure: Structure,
    pub statistics: TreeStatistics,
    /// References that the tree was built over: more than its leaves hold, where
    /// duplicates were removed from them.
    pub references: usize,
    /// What the SBVH did; nothing for other methods.
    pub splits: Option<SplitStatistics>,
    pub build_seconds: f64,
}

/// The methods in the order of the table.
pub(super) struct Methods {
    methods: [Method; 4],
}

impl Methods {
    pub(super) fn in_order(&self) -> impl Iterator<Item = &Method> {
        self.methods.iter()
    }

    /// The regular BVH, which the others are compared with.
    pub(super) fn plain(&self) -> &Method {
        &self.methods[3]
    }
}

/// The SBVH as in section 5, but under a limit.
pub(super) fn sbvh(invalid_primitives: InvalidPrimitives) -> SbvhBuilder {
    SbvhBuilder {
        leaf_rule: LEAF_RULE,
        bins_per_reference: usize::MAX,
        limit: ReferenceLimit::Factor(LIMIT),
        spending: Spending::ByBenefit,
        invalid_primitives,
        ..SbvhBuilder::default()
    }
}

/// Builds all methods; the thresholds of the presplits are such that they make
/// as many references as the SBVH.
pub(super) fn build_all(
    triangles: &[Triangle],
    invalid: InvalidPrimitives,
) -> Result<Methods, BuildError> {
    let plain = BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        leaf_rule: LEAF_RULE,
        invalid_primitives: invalid,
        ..BvhBuilder::default()
    };
    let bvh = timed("BVH", || {
        let tree = plain.build(triangles)?;
        let references = triangles.len() - tree.skipped_count();
        Ok((Box::new(tree), references, None))
    })?;
    let sbvh = timed("SBVH", || {
        let (tree, splits) = sbvh(invalid).build_with(triangles, &())?;
        Ok((Box::new(tree), splits.references, Some(splits)))
    })?;
    let threshold = Threshold::References(sbvh.references);
    let esc = timed("ESC", || {
        let builder = EarlySplitClipping {
            threshold,
            bvh: plain,
            ..EarlySplitClipping::default()
        };
        let (tree, statistics) = builder.build_with(triangles, &())?;
        Ok((Box::new(tree), statistics.references, None))
    })?;
    let evh = timed("EVH", || {
        let builder = EdgeVolumeHeuristic {
            threshold,
            bvh: plain,
            ..EdgeVolumeHeuristic::default()
        };
        let (tree, statistics) = builder.build_with(triangles, &())?;
        Ok((Box::new(tree), statistics.references, None))
    })?;
    Ok(Methods {
        methods: [sbvh, esc, evh, bvh],
    })
}

type Built = (Structure, usize, Option<SplitStatistics>);

fn timed(
    name: &'static str,
    build: impl FnOnce() -> Result<Built, BuildError>,
) -> Result<Method, BuildError> {
    let start = Instant::now();
    let (structure, references, splits) = build()?;
    let build_seconds = start.elapsed().as_secs_f64();
    let heuristic = SurfaceAreaHeuristic::default();
    Ok(Method {
        name,
        statistics: TreeStatistics::of(&structure.tree_outline(), &heuristic),
        structure,
        references,
        splits,
        build_seconds,
    })
}
