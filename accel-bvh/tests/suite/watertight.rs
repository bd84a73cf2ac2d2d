//! No ray gets out of a closed mesh: through edges, beside them and through
//! vertices, at any offset and scale.

use accel_bvh::{AccelerationStructure, BvhBuilder, ObjectSplit};
use accel_core::glam::{Quat, Vec3};
use accel_core::testing::closed::{ClosedMesh, interior_rays};

/// Traces rays from inside `mesh`; returns how many.
fn no_ray_escapes(mesh: &ClosedMesh, object_split: ObjectSplit, seed: u64, count: usize) -> usize {
    let builder = BvhBuilder {
        object_split,
        ..BvhBuilder::default()
    };
    let bvh = builder.build(&mesh.to_triangles()).unwrap();
    let rays = interior_rays(mesh, seed, count);
    let hits = bvh.closest_hits(&rays);
    let escaped = rays.iter().zip(&hits).find(|(_, hit)| hit.is_none());
    assert!(
        escaped.is_none(),
        "{escaped:?} of a mesh of {} triangles",
        mesh.triangles.len()
    );
    count
}

fn meshes() -> Vec<ClosedMesh> {
    let rotation = Quat::from_rotation_x(0.3) * Quat::from_rotation_z(1.1);
    vec![
        ClosedMesh::icosphere(4),
        ClosedMesh::bumpy_sphere(4, 0.2),
        ClosedMesh::latitude_longitude(40, 60),
        ClosedMesh::torus(60, 40),
        ClosedMesh::room_of_strips(1000.0, 10),
        ClosedMesh::room_of_strips(100.0, 4).rotated(rotation),
        ClosedMesh::room_of_strips(1000.0, 8).rotated(rotation),
        ClosedMesh::icosphere(3).rotated(rotation),
    ]
}

#[test]
fn no_ray_escapes_at_any_scale() {
    let mut rays = 0;
    for (seed, mesh) in (0..).zip(meshes()) {
        for exponent in [-15, -12, -9, -6, -3, 0, 3, 6, 9, 12, 15] {
            let scaled = mesh.clone().scaled(10.0_f32.powi(exponent));
            for object_split in [ObjectSplit::FullSweep, ObjectSplit::default()] {
                rays += no_ray_escapes(&scaled, object_split, seed, 5000);
            }
        }
    }
    assert!(rays >= 700_000, "{rays}");
}

#[test]
fn no_ray_escapes_at_any_offset() {
    let mut rays = 0;
    for (seed, mesh) in (0..).zip(meshes()) {
        for offset in [0.0, 1e3, 2e5] {
            // At 2e5 a unit sphere would have collapsed onto few coordinates.
            let moved = mesh
                .clone()
                .scaled(1e2)
                .translated(Vec3::new(offset, -offset, offset));
            for object_split in [ObjectSplit::FullSweep, ObjectSplit::default()] {
                rays += no_ray_escapes(&moved, object_split, seed, 10_000);
            }
        }
    }
    assert!(rays >= 400_000, "{rays}");
}
