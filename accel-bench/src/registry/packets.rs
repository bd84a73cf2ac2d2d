//! The rows of structures that trace packets. Their counts are those of single
//! rays.

use accel_bsp::BspBuilder;
use accel_bvh::{BvhBuilder, ObjectSplit};
use accel_core::{
    BuildError, BuildObserver, InPackets, InvalidPrimitives, SurfaceAreaHeuristic, Triangle,
};
use accel_dualsplit::DualSplitConverter;
use accel_kdtree::KdTreeBuilder;

use super::{Row, Structure, bsp};

pub(super) static ROWS: &[Row] = &[
    Row {
        name: "bvh-sweep-packet",
        is_headline: true,
        about: "bvh-sweep in packets of 8 rays, one vector of 8 lanes",
        settings: "as bvh-sweep; coherent rays only",
        heuristic: SurfaceAreaHeuristic::default,
        build: build_bvh::<8>,
    },
    Row {
        name: "bvh-sweep-4-packet",
        is_headline: false,
        about: "bvh-sweep in packets of 4 rays",
        settings: "as bvh-sweep; coherent rays only",
        heuristic: SurfaceAreaHeuristic::default,
        build: build_bvh::<4>,
    },
    Row {
        name: "bvh-sweep-16-packet",
        is_headline: false,
        about: "bvh-sweep in packets of 16 rays, two vectors side by side",
        settings: "as bvh-sweep; coherent rays only",
        heuristic: SurfaceAreaHeuristic::default,
        build: build_bvh::<16>,
    },
    Row {
        name: "bvh-sweep-64-packet",
        is_headline: false,
        about: "bvh-sweep in groups of 64 rays, culled together (Wald, Boulos, Shirley 2007)",
        settings: "as bvh-sweep; coherent rays only",
        heuristic: SurfaceAreaHeuristic::default,
        build: build_bvh::<64>,
    },
    Row {
        name: "kdtree-sweep-packet",
        is_headline: false,
        about: "kdtree-sweep in packets of 8 rays, one vector of 8 lanes",
        settings: "as kdtree-sweep; coherent rays only",
        heuristic: kd_heuristic,
        build: build_kdtree::<8>,
    },
    Row {
        name: "kdtree-sweep-4-packet",
        is_headline: false,
        about: "kdtree-sweep in packets of 4 rays",
        settings: "as kdtree-sweep; coherent rays only",
        heuristic: kd_heuristic,
        build: build_kdtree::<4>,
    },
    Row {
        name: "kdtree-sweep-16-packet",
        is_headline: false,
        about: "kdtree-sweep in packets of 16 rays, one vector of 16 lanes",
        settings: "as kdtree-sweep; coherent rays only",
        heuristic: kd_heuristic,
        build: build_kdtree::<16>,
    },
    Row {
        name: "dualsplit-similar-packet",
        is_headline: false,
        about: "dualsplit-similar in packets of 8 rays, one vector of 8 lanes",
        settings: "as dualsplit-similar; coherent rays only",
        heuristic: SurfaceAreaHeuristic::default,
        build: |triangles, invalid, observer| {
            let bvh = super::bvh::build_bvh(ObjectSplit::FullSweep, triangles, invalid, observer)?;
            let tree = DualSplitConverter::default().convert(&bvh)?;
            Ok(Box::new(InPackets::<_, 8>(tree)))
        },
    },
    Row {
        name: "bsp-packet",
        is_headline: false,
        about: "bsp in packets of 8 rays of one origin, one vector of 8 lanes",
        settings: "as bsp; coherent rays only",
        heuristic: bsp::heuristic,
        build: |triangles, invalid, observer| {
            build_bsp::<8>(BspBuilder::default(), triangles, invalid, observer)
        },
    },
    Row {
        name: "bsp-4-packet",
        is_headline: false,
        about: "bsp in packets of 4 rays of one origin",
        settings: "as bsp; coherent rays only",
        heuristic: bsp::heuristic,
        build: |triangles, invalid, observer| {
            build_bsp::<4>(BspBuilder::default(), triangles, invalid, observer)
        },
    },
    Row {
        name: "bsp-16-packet",
        is_headline: false,
        about: "bsp in packets of 16 rays of one origin, one vector of 16 lanes",
        settings: "as bsp; coherent rays only",
        heuristic: bsp::heuristic,
        build: |triangles, invalid, observer| {
            build_bsp::<16>(BspBuilder::default(), triangles, invalid, observer)
        },
    },
    Row {
        name: "bsp-tri-packet",
        is_headline: false,
        about: "bsp-tri in packets of 8 rays of one origin, one vector of 8 lanes",
        settings: "as bsp-tri; coherent rays only",
        heuristic: bsp::tri_heuristic,
        build: |triangles, invalid, observer| {
            build_bsp::<8>(
                BspBuilder::with_planar_leaves(),
                triangles,
                invalid,
                observer,
            )
        },
    },
    Row {
        name: "bsp-tri-4-packet",
        is_headline: false,
        about: "bsp-tri in packets of 4 rays of one origin",
        settings: "as bsp-tri; coherent rays only",
        heuristic: bsp::tri_heuristic,
        build: |triangles, invalid, observer| {
            build_bsp::<4>(
                BspBuilder::with_planar_leaves(),
                triangles,
                invalid,
                observer,
            )
        },
    },
    Row {
        name: "bsp-tri-16-packet",
        is_headline: false,
        about: "bsp-tri in packets of 16 rays of one origin, one vector of 16 lanes",
        settings: "as bsp-tri; coherent rays only",
        heuristic: bsp::tri_heuristic,
        build: |triangles, invalid, observer| {
            build_bsp::<16>(
                BspBuilder::with_planar_leaves(),
                triangles,
                invalid,
                observer,
            )
        },
    },
];

fn build_bvh<const N: usize>(
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    observer: &dyn BuildObserver,
) -> Result<Structure, BuildError> {
    let builder = BvhBuilder {
        object_split: ObjectSplit::FullSweep,
        invalid_primitives,
        ..BvhBuilder::default()
    };
    let bvh = builder.build_with(triangles, observer)?;
    Ok(Box::new(InPackets::<_, N>(bvh)))
}

fn kd_heuristic() -> SurfaceAreaHeuristic {
    KdTreeBuilder::default().heuristic
}

fn build_kdtree<const N: usize>(
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    observer: &dyn BuildObserver,
) -> Result<Structure, BuildError> {
    let builder = KdTreeBuilder {
        invalid_primitives,
        ..KdTreeBuilder::default()
    };
    let tree = builder.build_with(triangles, observer)?;
    Ok(Box::new(InPackets::<_, N>(tree)))
}

fn build_bsp<const N: usize>(
    mut builder: BspBuilder,
    triangles: &[Triangle],
    invalid_primitives: InvalidPrimitives,
    observer: &dyn BuildObserver,
) -> Result<Structure, BuildError> {
    builder.invalid_primitives = invalid_primitives;
    let tree = builder.build_with(triangles, observer)?;
    Ok(Box::new(InPackets::<_, N>(tree)))
}
