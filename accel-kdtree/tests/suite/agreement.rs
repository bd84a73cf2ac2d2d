//! Every setting on every scene family, against brute force.

use accel_core::testing::agreement::Expected;
use accel_core::testing::family_check::{Checked, Effort, check_families};
use accel_core::testing::packets::check_width;
use accel_core::testing::rays;
use accel_kdtree::{
    BuildBudget, InvalidPrimitives, KdTreeBuilder, PlaneSearch, Termination, Triangle,
};

fn check(effort: &Effort, builders: &[KdTreeBuilder]) -> Checked {
    let build = |triangles: &[Triangle]| {
        let builds = builders.iter().map(|builder| {
            let builder = KdTreeBuilder {
                invalid_primitives: InvalidPrimitives::Skip,
                ..*builder
            };
            let tree = builder.build(triangles)?;
            tree.validate().unwrap();
            Ok(tree)
        });
        builds.collect()
    };
    check_families(effort, build).unwrap_or_else(|error| panic!("{error}"))
}

const EFFORT: Effort = Effort {
    seeds: 4,
    triangles: 800,
    rays: 200,
    full_size_rays: 0,
};

/// Few bins and few sweeps, so that small scenes are binned, too.
const BINNED: PlaneSearch = PlaneSearch::Binned {
    bins: 16,
    exact_below: 16,
};

fn default() -> KdTreeBuilder {
    KdTreeBuilder::default()
}

#[test]
fn both_searches_agree_with_brute_force_on_every_family() {
    let binned = KdTreeBuilder {
        search: BINNED,
        ..default()
    };
    let checked = check(&EFFORT, &[default(), binned]);
    assert!(
        checked.families >= 40 && checked.hits > 15_000,
        "{checked:?}"
    );
}

#[test]
fn boxes_alone_agree_with_brute_force_on_every_family() {
    let part = Effort { seeds: 2, ..EFFORT };
    let boxes = |search| KdTreeBuilder {
        search,
        clips_primitives: false,
        ..default()
    };
    let checked = check(&part, &[boxes(PlaneSearch::Sweep), boxes(BINNED)]);
    assert!(checked.hits > 7_000, "{checked:?}");
}

#[test]
fn other_terminations_and_limits_agree_on_every_family() {
    let part = Effort {
        seeds: 3,
        triangles: 300,
        ..EFFORT
    };
    let with_termination = |termination| KdTreeBuilder {
        termination,
        ..default()
    };
    let manual = Termination::Manual { max_leaf_size: 1 };
    let settings = [
        with_termination(manual),
        with_termination(Termination::BadRefines { allowed: 3 }),
        KdTreeBuilder {
            search: BINNED,
            ..with_termination(manual)
        },
        KdTreeBuilder {
            max_duplication: 0.2,
            empty_bonus: 0.5,
            ..with_termination(manual)
        },
        KdTreeBuilder {
            budget: BuildBudget {
                max_depth: 9,
                ..BuildBudget::default()
            },
            ..default()
        },
    ];
    let checked = check(&part, &settings);
    assert!(checked.hits > 8_000, "{checked:?}");
}

/// What the kernel rounds of them is no share of their direction.
#[test]
fn rays_whose_shear_has_no_digits_left_hit_what_they_must() {
    let mut hits = 0;
    for (scene, rays) in rays::with_subnormal_ratios() {
        let expected = Expected::new(&scene, rays).unwrap();
        hits += expected.hits();
        let tree = KdTreeBuilder::default().build(&scene).unwrap();
        let disagreements = expected.disagreements(&tree);
        assert!(disagreements.is_empty(), "{}", disagreements[0]);
        check_width::<_, 8>(&tree, &expected).unwrap_or_else(|error| panic!("{error}"));
    }
    assert!(hits > 800, "{hits}");
}
