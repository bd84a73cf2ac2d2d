//! The matrix: every row of the registry, every embedded scene, every kind of
//! rays, against brute force.

use accel_bench::rays::{RayKind, RaySource};
use accel_bench::registry::{self, Structure};
use accel_bench::scene::embedded;
use accel_bench::verification::Expected;
use accel_core::primitive::triangles_of_mesh;
use accel_core::{InvalidPrimitives, Triangle};

const TRIANGLES: usize = 2000;
const SIZE: (u32, u32) = (24, 18);

#[test]
fn every_row_agrees_with_brute_force_on_every_scene_and_kind_of_rays() {
    let names = ["all".to_owned()];
    let rows = registry::select(&names).unwrap();
    for scene in embedded::all() {
        let mesh = scene.mesh_of(TRIANGLES);
        let triangles: Vec<Triangle> = triangles_of_mesh(&mesh.positions, &mesh.triangles).unwrap();
        let oracle = registry::oracle(&triangles, InvalidPrimitives::Reject).unwrap();
        let structures: Vec<Structure> = rows
            .iter()
            .map(|row| {
                row.build(&triangles, InvalidPrimitives::Reject, &())
                    .unwrap()
            })
            .collect();
        let finder = structures[0].as_ref();
        let source = RaySource {
            structure: finder,
            triangles: &triangles,
            camera: scene.camera(),
            size: SIZE,
            bounds: finder.scene_bounds().unwrap(),
            ambient_length: RaySource::AMBIENT_LENGTH,
            seed: 3,
        };
        for kind in RayKind::ALL {
            let rays = source.rays(kind).rays;
            assert!(!rays.is_empty(), "{} {kind}", scene.name);
            let expected = Expected::new(&oracle, kind.question(), rays, &|_| ());
            for (row, structure) in rows.iter().zip(&structures) {
                let disagreements = expected.disagreements(structure.as_ref());
                let first = disagreements.first();
                assert!(
                    first.is_none(),
                    "{} {kind} {}: {first:?}",
                    scene.name,
                    row.name
                );
            }
        }
    }
}
