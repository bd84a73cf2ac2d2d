//! What settings do.

use accel_bsp::{
    AccelerationStructure, BspBuilder, BspCosts, CandidatePlanes, GeneralPlanes, RaySegment,
    Triangle,
};
use accel_core::testing::agreement::oracle;

use crate::{Built, Failure, cost, count, per_ray, rays};

/// Which settings to vary; none for the paper's tables.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Options {
    pub epsilon: bool,
    pub costs: bool,
    pub planes: bool,
    pub growth: bool,
    pub exhaustive: usize,
}

impl Options {
    pub(crate) fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

pub(crate) fn run(options: &Options, triangles: &[Triangle]) -> Result<(), Failure> {
    if options.epsilon {
        sweep_epsilon(triangles)?;
    }
    if options.costs {
        sweep_costs(triangles)?;
    }
    if options.planes {
        try_planes(triangles)?;
    }
    if options.growth {
        measure_growth(triangles)?;
    }
    if options.exhaustive > 0 {
        compare_with_exhaustive(&triangles[..options.exhaustive.min(triangles.len())])?;
    }
    Ok(())
}

/// Quality, and agreement with brute force, for every epsilon.
fn sweep_epsilon(triangles: &[Triangle]) -> Result<(), Failure> {
    const COMPARED: usize = 2000;
    let oracle = oracle(triangles)?;
    for exponent in (14..=24).step_by(2) {
        let builder = BspBuilder {
            epsilon: 1.0 / f64::from(1_u32 << exponent),
            ..BspBuilder::with_planar_leaves()
        };
        let built = Built::new(&builder, triangles)?;
        let rays = rays::paths(&built.tree);
        let some = rays.iter().step_by(rays.len().div_ceil(COMPARED).max(1));
        let differs = |ray: &&RaySegment| built.tree.closest_hit(*ray) != oracle.closest_hit(*ray);
        let compared = some.clone().count();
        println!(
            "  epsilon 2^-{exponent}: {} of {compared} differ from brute force\n    {}\n    {}",
            some.filter(differs).count(),
            built.describe(),
            per_ray(&count(&built.tree, &rays, false).0),
        );
    }
    Ok(())
}

/// The cost of a test of a primitive, for BSP and the unconfirmed BSP-tri.
fn sweep_costs(triangles: &[Triangle]) -> Result<(), Failure> {
    for intersection in [1.0, 2.0, 4.0, 8.0, 16.0, 32.0] {
        for builder in [BspBuilder::default(), BspBuilder::with_bounded_leaves()] {
            let costs = BspCosts {
                intersection,
                ..builder.costs
            };
            let built = Built::new(&BspBuilder { costs, ..builder }, triangles)?;
            let is_unconfirmed = built.tree.shape().bounded_leaves > 0;
            let rays = rays::camera(&built.tree);
            let (counters, differing) = count(&built.tree, &rays, is_unconfirmed);
            println!(
                "  C_i {intersection}, unconfirmed {is_unconfirmed}, {differing} differ\n    {}\n    {}",
                built.describe(),
                per_ray(&counters),
            );
        }
    }
    Ok(())
}

/// The candidate planes of section 6.1, one kind at a time.
fn try_planes(triangles: &[Triangle]) -> Result<(), Failure> {
    let paper = CandidatePlanes::of_the_paper();
    let general = |general| CandidatePlanes { general, ..paper };
    let choices = [
        paper,
        general(GeneralPlanes::UpTo(1000)),
        general(GeneralPlanes::UpTo(64)),
        general(GeneralPlanes::BelowGain(0.4)),
        CandidatePlanes {
            shared_edges: true,
            ..paper
        },
        CandidatePlanes {
            tangents: 2,
            ..paper
        },
    ];
    for candidate_planes in choices {
        let builder = BspBuilder {
            candidate_planes,
            ..BspBuilder::default()
        };
        let built = Built::new(&builder, triangles)?;
        let rays = rays::paths(&built.tree);
        println!(
            "  {candidate_planes:?}\n    {}\n    {}",
            built.describe(),
            per_ray(&count(&built.tree, &rays, false).0),
        );
    }
    Ok(())
}

/// Build times of the first triangles of a scene, ever more of them, and the exponent
/// from one number to the next.
fn measure_growth(triangles: &[Triangle]) -> Result<(), Failure> {
    let mut smaller: Option<(f64, f64)> = None;
    for count in [1_000, 5_000, 20_000, 80_000, 200_000] {
        let Some(part) = triangles.get(..count) else {
            break;
        };
        let built = Built::new(&BspBuilder::default(), part)?;
        let count = count as f64;
        let exponent = smaller.map_or(f64::NAN, |(fewer, seconds)| {
            (built.seconds / seconds).ln() / (count / fewer).ln()
        });
        smaller = Some((count, built.seconds));
        println!(
            "  first {count}: exponent {exponent:.3}, {}",
            built.describe()
        );
    }
    Ok(())
}

/// The cost of the default tree over that of the paper's search (section 5.1).
fn compare_with_exhaustive(triangles: &[Triangle]) -> Result<(), Failure> {
    let exhaustive = BspBuilder {
        sampled_primitives: None,
        candidate_planes: CandidatePlanes::of_the_paper(),
        ..BspBuilder::default()
    };
    let sampled = Built::new(&BspBuilder::default(), triangles)?;
    let exhaustive = Built::new(&exhaustive, triangles)?;
    let [cost, best] = [&sampled, &exhaustive].map(|built| cost(&built.tree));
    println!(
        "  {} triangles: cost {cost:.3} in {:.2} s; exhaustive {best:.3} in {:.2} s; ratio {:.4}",
        triangles.len(),
        sampled.seconds,
        exhaustive.seconds,
        cost / best,
    );
    Ok(())
}
