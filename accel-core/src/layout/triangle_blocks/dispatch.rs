//! One instance of the leaf loop per instruction set, chosen at run time. None
//! enables fused multiply-add, which the kernel must not use.
#![allow(unsafe_code)]

use std::ops::ControlFlow;

use super::TriangleBlocks;
use crate::query::Query;
use crate::ray::PreparedRay;
use crate::statistics::TraversalStatistics;

pub(super) fn intersect_leaf<const LANES: usize, Q: Query, S: TraversalStatistics>(
    blocks: &TriangleBlocks<LANES>,
    leaf: u32,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) -> ControlFlow<()> {
    #[cfg(target_arch = "x86_64")]
    {
        if std::arch::is_x86_feature_detected!("avx512f") {
            // SAFETY: the machine has AVX-512F, as just tested.
            return unsafe { avx512(blocks, leaf, ray, query, statistics) };
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the machine has AVX2, as just tested.
            return unsafe { avx2(blocks, leaf, ray, query, statistics) };
        }
    }
    blocks.intersect_leaf_lanes(leaf, ray, query, statistics)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f")]
fn avx512<const LANES: usize, Q: Query, S: TraversalStatistics>(
    blocks: &TriangleBlocks<LANES>,
    leaf: u32,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) -> ControlFlow<()> {
    blocks.intersect_leaf_lanes(leaf, ray, query, statistics)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2<const LANES: usize, Q: Query, S: TraversalStatistics>(
    blocks: &TriangleBlocks<LANES>,
    leaf: u32,
    ray: &PreparedRay,
    query: &mut Q,
    statistics: &mut S,
) -> ControlFlow<()> {
    blocks.intersect_leaf_lanes(leaf, ray, query, statistics)
}
