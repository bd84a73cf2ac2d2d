//! What holds of the rays at every scene family.

use glam::Vec3;

use super::super::families;
use super::*;

fn is_usable(ray: &RaySegment) -> bool {
    ray.origin.is_finite()
        && ray.direction.is_finite()
        && ray.direction != Vec3::ZERO
        && ray.t_min.is_finite()
        && 0.0 <= ray.t_min
        && ray.t_min <= ray.t_max
}

fn draw(kind: RayKind, scene: &[Triangle]) -> Vec<RaySegment> {
    rays(kind, scene, &mut Pcg64Mcg::seed_from_u64(9), 60)
}

#[test]
fn rays_are_finite_at_every_family() {
    for family in families::all() {
        for size in [0, 1, 200] {
            let scene = family.scene(4, size);
            for kind in RayKind::FINITE {
                for ray in draw(kind, &scene) {
                    assert!(is_usable(&ray), "{} {kind:?} {ray:?}", family.name);
                }
            }
        }
    }
}

#[test]
fn non_finite_rays_are_never_usable() {
    for family in families::all() {
        for ray in draw(RayKind::NonFinite, &family.scene(4, 50)) {
            assert!(!is_usable(&ray), "{} {ray:?}", family.name);
        }
    }
}

#[test]
fn mixed_rays_follow_from_their_seed() {
    let scene = families::find("soup-uniform").unwrap().scene(0, 100);
    let first = mixed(&scene, 1, 130);
    assert_eq!(first.len(), 130);
    assert_eq!(first, mixed(&scene, 1, 130));
    assert_ne!(first, mixed(&scene, 2, 130));
}

#[test]
fn rays_through_vertices_meet_one_at_t_1() {
    let scene = families::find("integer-soup").unwrap().scene(0, 100);
    for ray in draw(RayKind::ThroughVertices, &scene) {
        let end = ray.origin.as_dvec3() + ray.direction.as_dvec3();
        let mut vertices = scene.iter().flat_map(Triangle::vertices);
        let meets = |vertex: Vec3| vertex.as_dvec3().distance(end) < 1e-6;
        assert!(vertices.any(meets), "{ray:?}");
    }
}

#[test]
fn rays_in_box_planes_share_a_coordinate_with_a_vertex() {
    for name in [
        "soup-uniform",
        "subnormal",
        "scale-max",
        "one-point",
        "sheet-x",
    ] {
        let scene = families::find(name).unwrap().scene(0, 100);
        for ray in draw(RayKind::BoxPlanes, &scene) {
            let lies_in_plane = |axis: usize| {
                let mut vertices = scene.iter().flat_map(Triangle::vertices);
                ray.direction[axis] == 0.0 && vertices.any(|v| v[axis] == ray.origin[axis])
            };
            assert!((0..3).any(lies_in_plane), "{name} {ray:?}");
        }
    }
}

#[test]
fn zeros_in_directions_have_both_signs() {
    let scene = families::find("soup-uniform").unwrap().scene(0, 100);
    for kind in [RayKind::BoxPlanes, RayKind::AxisParallel] {
        let rays = draw(kind, &scene);
        for zero in [0.0f32, -0.0] {
            let mut components = rays.iter().flat_map(|ray| ray.direction.to_array());
            assert!(
                components.any(|x| x.to_bits() == zero.to_bits()),
                "{kind:?}"
            );
        }
    }
}

#[test]
fn axis_parallel_rays_have_one_component_at_every_scale() {
    for name in [
        "scale-1e-30",
        "scale-1e30",
        "subnormal",
        "scale-max",
        "empty",
    ] {
        let scene = families::find(name).unwrap().scene(0, 50);
        for ray in draw(RayKind::AxisParallel, &scene) {
            let zeros = ray
                .direction
                .to_array()
                .iter()
                .filter(|&&x| x == 0.0)
                .count();
            assert_eq!(zeros, 2, "{name} {ray:?}");
        }
    }
}

/// Whether the ray's line passes through the triangle's inside, in f64.
fn meets(ray: &RaySegment, triangle: &Triangle) -> bool {
    let [a, b, c] = triangle.vertices().map(Vec3::as_dvec3);
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3().normalize());
    let volumes =
        [(a, b), (b, c), (c, a)].map(|(p, q)| direction.dot((p - origin).cross(q - origin)));
    volumes.iter().all(|&v| v > 0.0) || volumes.iter().all(|&v| v < 0.0)
}

#[test]
fn rays_towards_triangles_hit_their_lines() {
    let scene = families::find("soup-uniform").unwrap().scene(0, 100);
    for (kind, least) in [
        (RayKind::FarOrigins, 40),
        (RayKind::ScaledDirections, 55),
        (RayKind::ShortSegments, 55),
        (RayKind::AxisParallel, 20),
    ] {
        let rays = draw(kind, &scene);
        let hits = |ray: &&RaySegment| scene.iter().any(|triangle| meets(ray, triangle));
        let hits = rays.iter().filter(hits).count();
        assert!(hits >= least, "{kind:?}: {hits} of {}", rays.len());
    }
}

#[test]
fn a_lattice_gets_rays_in_every_plane_and_through_every_vertex() {
    let scene = families::find("axis-grid").unwrap().scene(0, 72);
    let rays = at_every_vertex(&scene, 3);
    // Two cells a side: 27 vertices, and three planes in each of three axes.
    assert_eq!(rays.len(), 27 + 9);
    assert!(rays.iter().all(is_usable));
    let in_planes = rays
        .iter()
        .filter(|ray| ray.direction.cmpeq(Vec3::ZERO).any());
    assert!(in_planes.count() >= 9);
    assert!(at_every_vertex(&[], 3).is_empty());
}
