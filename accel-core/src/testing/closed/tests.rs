//! Whether the meshes are closed, and their insides inside.

use std::collections::HashMap;

use super::*;

fn meshes() -> Vec<(&'static str, ClosedMesh)> {
    vec![
        ("icosahedron", ClosedMesh::icosphere(0)),
        ("icosphere", ClosedMesh::icosphere(3)),
        ("bumpy sphere", ClosedMesh::bumpy_sphere(4, 0.3)),
        ("smallest lat-long", ClosedMesh::latitude_longitude(3, 3)),
        ("skinny lat-long", ClosedMesh::latitude_longitude(500, 7)),
        ("room 1 x 30", ClosedMesh::room_of_strips(30.0, 5)),
        ("room 1 x 100", ClosedMesh::room_of_strips(100.0, 4)),
        ("room 1 x 1000", ClosedMesh::room_of_strips(1000.0, 1)),
        ("room 1 x 1e5", ClosedMesh::room_of_strips(1e5, 8)),
        ("torus", ClosedMesh::torus(24, 12)),
    ]
}

/// How often the surface winds around `point`: the sum of the solid angles
/// (van Oosterom and Strackee 1983), in full spheres.
fn winding_number(mesh: &ClosedMesh, point: DVec3) -> f64 {
    let angle = |triangle: &Triangle| {
        let [a, b, c] = triangle.vertices().map(|v| v.as_dvec3() - point);
        let [x, y, z] = [a.length(), b.length(), c.length()];
        let below = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    mesh.to_triangles().iter().map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

fn assert_inside(name: &str, mesh: &ClosedMesh, point: DVec3) {
    let winding = winding_number(mesh, point);
    assert!((winding - 1.0).abs() < 1e-6, "{name}: {winding} at {point}");
}

#[test]
fn each_edge_is_shared_by_two_triangles_in_opposite_directions() {
    for (name, mesh) in meshes() {
        let mut edges = HashMap::new();
        for &[a, b, c] in &mesh.triangles {
            for edge in [(a, b), (b, c), (c, a)] {
                *edges.entry(edge).or_insert(0) += 1;
            }
        }
        for (&(start, end), &uses) in &edges {
            assert_eq!(uses, 1, "{name}: edge {start} {end}");
            assert!(edges.contains_key(&(end, start)), "{name}: {start} {end}");
        }
    }
}

#[test]
fn every_vertex_belongs_to_one_place() {
    for (name, mesh) in meshes() {
        let bits = |position: &Vec3| position.to_array().map(f32::to_bits);
        let mut places: Vec<_> = mesh.positions.iter().map(bits).collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), mesh.positions.len(), "{name}");
    }
}

#[test]
fn sizes_are_as_documented() {
    assert_eq!(ClosedMesh::icosphere(0).triangles.len(), 20);
    assert_eq!(ClosedMesh::icosphere(3).triangles.len(), 1280);
    assert_eq!(ClosedMesh::room_of_strips(100.0, 7).triangles.len(), 112);
    assert_eq!(ClosedMesh::latitude_longitude(10, 4).triangles.len(), 60);
    assert_eq!(ClosedMesh::torus(10, 4).triangles.len(), 80);
}

#[test]
fn balls_lie_inside_up_to_their_surface() {
    for (name, mesh) in meshes() {
        assert!(!mesh.inside.is_empty(), "{name}");
        for ball in &mesh.inside {
            assert!(ball.radius > 0.0, "{name}");
            let center = ball.center.as_dvec3();
            for axis in DVec3::AXES {
                let reach = axis * f64::from(ball.radius);
                assert_inside(name, &mesh, center);
                assert_inside(name, &mesh, center + reach);
                assert_inside(name, &mesh, center - reach);
            }
        }
    }
}

#[test]
fn origins_stay_inside_after_every_transform() {
    let turn = Quat::from_rotation_y(0.7) * Quat::from_rotation_x(1.1);
    for (name, mesh) in meshes() {
        for moved in [
            mesh.rotated(turn),
            mesh.scaled(1e-15),
            mesh.scaled(1e15),
            mesh.rotated(turn).translated(Vec3::splat(1e3)),
            mesh.rotated(turn).translated(Vec3::splat(2e5)),
        ] {
            for ray in interior_rays(&moved, 5, 20) {
                assert_inside(name, &moved, ray.origin.as_dvec3());
                assert!(ray.direction.is_finite() && ray.direction != Vec3::ZERO);
            }
        }
    }
}

#[test]
fn a_mesh_swallowed_by_rounding_has_no_certain_inside() {
    let far = ClosedMesh::icosphere(2).translated(Vec3::splat(1e9));
    assert!(far.inside.is_empty());
}

#[test]
fn interior_rays_aim_at_edges_and_vertices_in_turn() {
    let mesh = ClosedMesh::icosphere(2);
    let triangles = mesh.to_triangles();
    let to_edge = |point: DVec3| {
        let corners = triangles.iter().map(|t| t.vertices().map(Vec3::as_dvec3));
        let edges = corners.flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)]);
        let detours = edges.map(|(a, b)| a.distance(point) + point.distance(b) - a.distance(b));
        detours.fold(f64::INFINITY, f64::min)
    };
    let to_vertex = |point: DVec3| {
        let vertices = mesh.positions.iter().map(|v| v.as_dvec3().distance(point));
        vertices.fold(f64::INFINITY, f64::min)
    };
    for rays in interior_rays(&mesh, 1, 80).chunks_exact(4) {
        let ends = [1, 2, 3].map(|kind: usize| {
            let ray = rays[kind];
            ray.origin.as_dvec3() + ray.direction.as_dvec3()
        });
        assert!(to_edge(ends[0]) < 1e-6 && to_edge(ends[1]) < 1e-5);
        assert!(to_vertex(ends[2]) < 1e-6);
    }
}
