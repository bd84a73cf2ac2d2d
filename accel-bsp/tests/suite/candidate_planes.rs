//! The candidate planes of sections 5.1 and 6.1 of the paper.

use accel_bsp::{
    BspBuilder, BspCosts, CandidatePlanes, GeneralPlanes, InvalidPrimitives, Triangle,
};
use accel_core::testing::families;
use accel_core::testing::family_check::{Effort, check_families};

/// By these costs a few triangles are worth a node.
const COSTS: BspCosts = BspCosts {
    intersection: 4.0,
    axis_aligned: 1.0,
    general: 1.75,
    alpha: Some(0.1),
};

fn with(candidate_planes: CandidatePlanes) -> BspBuilder {
    BspBuilder {
        costs: COSTS,
        candidate_planes,
        ..BspBuilder::default()
    }
}

fn general(general: GeneralPlanes) -> CandidatePlanes {
    CandidatePlanes {
        general,
        ..CandidatePlanes::default()
    }
}

fn all() -> CandidatePlanes {
    CandidatePlanes {
        shared_edges: true,
        tangents: 2,
        vertex_triples: 4,
        ..CandidatePlanes::of_the_paper()
    }
}

fn cost(builder: &BspBuilder, triangles: &[Triangle]) -> f64 {
    let tree = builder.build(triangles).unwrap();
    tree.surface_area_cost(&COSTS).unwrap()
}

fn scene(family: &str, count: usize) -> Vec<Triangle> {
    families::find(family).expect(family).scene(3, count)
}

#[test]
fn every_choice_agrees_with_brute_force_on_every_family() {
    let effort = Effort {
        seeds: 1,
        triangles: 100,
        rays: 100,
        full_size_rays: 0,
    };
    let choices = [
        general(GeneralPlanes::UpTo(20)),
        general(GeneralPlanes::BelowGain(0.3)),
        all(),
    ];
    let build = |triangles: &[Triangle]| {
        let builds = choices.iter().map(|&choice| {
            let builder = BspBuilder {
                invalid_primitives: InvalidPrimitives::Skip,
                ..with(choice)
            };
            builder.build(triangles)
        });
        builds.collect()
    };
    let checked = check_families(&effort, build).unwrap_or_else(|error| panic!("{error}"));
    assert!(checked.hits > 1000, "{checked:?}");
}

/// The first split alone, by the plain heuristic: a deeper tree is greedy, and may
/// be worse after a better start.
#[test]
fn no_split_is_better_than_the_best_through_three_corners() {
    let mut better = 0;
    for family in [
        "soup-uniform",
        "staircase-rotated",
        "hairball",
        "straddling-umbrella",
    ] {
        for seed in 0..10 {
            let triangles = families::find(family).expect(family).scene(seed, 10);
            let mut usual = BspBuilder {
                costs: BspCosts {
                    alpha: None,
                    ..COSTS
                },
                ..with(CandidatePlanes::of_the_paper())
            };
            usual.budget.max_depth = 1;
            let oracle = BspBuilder {
                candidate_planes: CandidatePlanes {
                    vertex_triples: triangles.len(),
                    ..usual.candidate_planes
                },
                ..usual
            };
            let [usual, best] = [usual, oracle].map(|builder| cost(&builder, &triangles));
            // Planes differ in how far cells reach over them.
            assert!(
                best <= usual * (1.0 + 1e-6),
                "{family} {seed}: {best} {usual}"
            );
            better += usize::from(best < usual * 0.999);
        }
    }
    assert!(better > 10, "{better}");
}

#[test]
fn general_planes_begin_where_the_switch_says() {
    let triangles = scene("closed-bumpy-sphere", 2000);
    let shape = |planes| with(general(planes)).build(&triangles).unwrap().shape();
    assert_eq!(shape(GeneralPlanes::UpTo(0)).general, 0);
    let everywhere = shape(GeneralPlanes::Everywhere);
    for planes in [GeneralPlanes::UpTo(2000), GeneralPlanes::BelowGain(1.0)] {
        assert_eq!(shape(planes), everywhere);
    }
    for planes in [GeneralPlanes::UpTo(8), GeneralPlanes::BelowGain(0.3)] {
        let shape = shape(planes);
        assert!(
            shape.axis_aligned > everywhere.axis_aligned,
            "{shape:?} {everywhere:?}"
        );
        assert!(shape.general > 0, "{shape:?}");
    }
}

/// Two pages that meet at an acute angle: the plane halfway between them parts them.
#[test]
fn a_plane_through_a_shared_edge_parts_its_two_triangles() {
    let page = |z: f32| Triangle::new([0.0; 3], [0.3, 1.0, 0.2], [1.0, 0.5, z]);
    let book = [page(0.1), page(0.5)];
    let shared = CandidatePlanes {
        shared_edges: true,
        ..CandidatePlanes::of_the_paper()
    };
    let tree = with(shared).build(&book).unwrap();
    assert_eq!(tree.shape().leaves_by_size.len(), 2, "{:?}", tree.shape());
    assert!(cost(&with(shared), &book) <= cost(&with(CandidatePlanes::default()), &book));
}

/// Section 6.1's staircase: planes along its slope are tangent to every step.
#[test]
fn tangent_planes_pay_in_a_staircase() {
    let triangles: Vec<Triangle> = (0..12)
        .map(|step| {
            let [x, z] = [step as f32, step as f32];
            Triangle::new([x, 0.0, z], [x + 1.0, 0.0, z], [x + 1.0, 1.0, z])
        })
        .collect();
    let tangents = CandidatePlanes {
        tangents: 11,
        ..CandidatePlanes::of_the_paper()
    };
    let choices = [CandidatePlanes::of_the_paper(), tangents];
    let [usual, tangent] = choices.map(|planes| cost(&with(planes), &triangles));
    assert!(tangent < 0.9 * usual, "{tangent} {usual}");
}
