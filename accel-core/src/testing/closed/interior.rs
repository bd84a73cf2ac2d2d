//! Rays that start inside a closed mesh and aim where it might leak.

use glam::{DVec3, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::super::edge::{point_beside_edge, point_on_edge};
use super::super::random::{point_in_cube, unit_vector};
use super::ClosedMesh;
use crate::RaySegment;

/// `count` rays from inside `mesh`, each of which must hit it: in turn in a
/// random direction, exactly towards a point on an edge, 1e-8 to 1e-6 of the
/// edge's length beside such a point, and exactly towards a vertex.
///
/// # Panics
/// If the mesh has no triangles or no place certainly inside is left of it: a
/// test over its rays would pass without testing anything.
pub fn interior_rays(mesh: &ClosedMesh, seed: u64, count: usize) -> Vec<RaySegment> {
    assert!(
        !mesh.triangles.is_empty() && !mesh.inside.is_empty(),
        "a mesh of {} triangles has {} places certainly inside it",
        mesh.triangles.len(),
        mesh.inside.len(),
    );
    let triangles = mesh.to_triangles();
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    (0..count)
        .map(|index| {
            let origin = origin(mesh, &mut rng);
            let triangle = &triangles[rng.random_range(0..triangles.len())];
            let mut corners = triangle.vertices().map(Vec3::as_dvec3);
            corners.rotate_left(rng.random_range(0..3));
            let direction = match index % 4 {
                0 => unit_vector(&mut rng).as_dvec3(),
                1 => point_on_edge(corners, &mut rng) - origin,
                2 => point_beside_edge(corners, &mut rng) - origin,
                _ => corners[0] - origin,
            };
            RaySegment::new(origin.as_vec3(), direction.as_vec3())
        })
        .collect()
}

/// A point in one of the balls, as f32 holds it.
fn origin(mesh: &ClosedMesh, rng: &mut Pcg64Mcg) -> DVec3 {
    let ball = mesh.inside[rng.random_range(0..mesh.inside.len())];
    // Half the cube's diagonal is sqrt(3), so this stays within the ball.
    let jitter = 0.5 * ball.radius * point_in_cube(rng);
    (ball.center + jitter).as_dvec3()
}
