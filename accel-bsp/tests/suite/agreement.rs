//! Every variant on every scene family, against brute force: single rays, and packets
//! of every width at every level of vectors that the machine has.

use accel_bsp::{BspBuilder, CandidatePlanes, InvalidPrimitives, RaySegment, Triangle};
use accel_core::glam::Vec3;
use accel_core::testing::agreement::Expected;
use accel_core::testing::families;
use accel_core::testing::family_check::{Checked, Effort, check_families};
use accel_core::testing::packets::{check_width, ray_sets};
use accel_core::testing::rays;

fn check(effort: &Effort, builders: &[BspBuilder]) -> Checked {
    let build = |triangles: &[Triangle]| {
        let builds = builders.iter().map(|builder| {
            let builder = BspBuilder {
                invalid_primitives: InvalidPrimitives::Skip,
                ..*builder
            };
            builder.build(triangles)
        });
        builds.collect()
    };
    check_families(effort, build).unwrap_or_else(|error| panic!("{error}"))
}

const EFFORT: Effort = Effort {
    seeds: 2,
    triangles: 300,
    rays: 200,
    full_size_rays: 0,
};

#[test]
fn every_variant_agrees_with_brute_force_on_every_family() {
    let variants = [
        BspBuilder::default(),
        BspBuilder::original(),
        BspBuilder::with_planar_leaves(),
    ];
    let checked = check(&EFFORT, &variants);
    assert!(
        checked.families >= 40 && checked.hits > 10_000,
        "{checked:?}"
    );
}

#[test]
fn other_epsilons_and_the_exhaustive_search_agree_on_every_family() {
    let part = Effort {
        seeds: 1,
        triangles: 150,
        ..EFFORT
    };
    let tri = BspBuilder::with_planar_leaves();
    let with_epsilon = |exponent: u32| BspBuilder {
        epsilon: 1.0 / (1_u32 << exponent) as f64,
        ..tri
    };
    let exhaustive = BspBuilder {
        sampled_primitives: None,
        candidate_planes: CandidatePlanes::of_the_paper(),
        ..tri
    };
    let settings = [with_epsilon(24), with_epsilon(14), exhaustive];
    let checked = check(&part, &settings);
    assert!(checked.hits > 2_000, "{checked:?}");
}

#[test]
fn packets_of_every_variant_agree_with_brute_force_on_every_family() {
    let variants = [
        BspBuilder::default(),
        BspBuilder::original(),
        BspBuilder::with_planar_leaves(),
        BspBuilder::with_bounded_leaves(),
    ];
    let mut hits = 0;
    for (index, family) in families::all().iter().enumerate() {
        let scene = family.scene(7, 200);
        let builder = BspBuilder {
            invalid_primitives: InvalidPrimitives::Skip,
            ..variants[index % variants.len()]
        };
        let tree = builder.build(&scene).unwrap();
        for (set, rays) in ray_sets(&scene, 7) {
            let expected = Expected::new(&scene, rays).unwrap();
            let checked = check_width::<_, 4>(&tree, &expected)
                .and_then(|()| check_width::<_, 8>(&tree, &expected))
                .and_then(|()| check_width::<_, 16>(&tree, &expected));
            checked.unwrap_or_else(|error| panic!("{}, {set}: {error}", family.name));
            hits += expected.hits();
        }
    }
    assert!(hits > 5_000, "{hits}");
}

/// What the kernel rounds of them is no share of their direction.
#[test]
fn rays_whose_shear_has_no_digits_left_hit_what_they_must() {
    let mut hits = 0;
    for (scene, rays) in rays::with_subnormal_ratios() {
        let expected = Expected::new(&scene, rays).unwrap();
        hits += expected.hits();
        for builder in [BspBuilder::default(), BspBuilder::with_planar_leaves()] {
            let tree = builder.build(&scene).unwrap();
            let disagreements = expected.disagreements(&tree);
            assert!(disagreements.is_empty(), "{}", disagreements[0]);
            check_width::<_, 8>(&tree, &expected).unwrap_or_else(|error| panic!("{error}"));
        }
    }
    assert!(hits > 800, "{hits}");
}

/// Directions so long that the speed at which a ray comes nearer to a plane overflows.
#[test]
fn packets_of_the_longest_directions_agree_with_brute_force() {
    let names = [
        "closed-icosphere",
        "figure-in-stadium",
        "sheet-rotated",
        "staircase-rotated",
    ];
    for name in names {
        let scene = families::find(name).unwrap().scene(1, 100);
        let tree = BspBuilder {
            max_candidates: 400,
            ..BspBuilder::default()
        };
        let tree = tree.build(&scene).unwrap();
        let [_, _, (_, from_one_origin)] = ray_sets(&scene, 3);
        for exponent in (92..124).step_by(4) {
            let scale = 2.0_f32.powi(exponent);
            let rays = from_one_origin
                .iter()
                .map(|ray| RaySegment::new(ray.origin, ray.direction * scale))
                .filter(|ray| ray.direction.is_finite());
            let expected = Expected::new(&scene, rays.collect()).unwrap();
            check_width::<_, 8>(&tree, &expected)
                .unwrap_or_else(|error| panic!("{name}, 2^{exponent}: {error}"));
        }
    }
}

/// One over the slope of the ray over a plane is infinite there, and yet it crosses it at
/// a `t` that is finite.
#[test]
fn a_ray_along_which_t_is_almost_the_largest_number_finds_its_hit() {
    let scene = families::find("closed-room-of-strips")
        .unwrap()
        .scene(20, 150);
    let corners = scene.iter().flat_map(Triangle::vertices);
    let largest = corners.map(|corner| corner.abs().max_element());
    let scale = f64::from(1 << 28) / f64::from(largest.fold(0.0, f32::max));
    let scaled = |corner: Vec3| (corner.as_dvec3() * scale).as_vec3();
    let scene: Vec<Triangle> = scene
        .iter()
        .map(|triangle| triangle.vertices().map(scaled).into())
        .collect();
    let direction = [4.189407e-35, -2.3207411e-35, -2.3449759e-35];
    let ray = RaySegment::new([2208923.8, 1786551.4, 8959878.0], direction);
    let rays = vec![ray, ray.with_interval(0.0, f32::MAX)];
    let expected = Expected::new(&scene, rays).unwrap();
    for axis_aligned_nodes in [false, true] {
        let builder = BspBuilder {
            epsilon: 1.0 / (1 << 14) as f64,
            axis_aligned_nodes,
            ..BspBuilder::default()
        };
        let tree = builder.build(&scene).unwrap();
        let disagreements = expected.disagreements(&tree);
        assert!(disagreements.is_empty(), "{}", disagreements[0]);
    }
}
