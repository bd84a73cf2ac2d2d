//! The matrix: every row of the registry, every embedded scene, every kind of
//! rays, against brute force.

use accel_bench::rays::{RayKind, RaySource};
use accel_bench::registry::{self, Structure};
use accel_bench::scene::embedded::{self, EmbeddedScene};
use accel_bench::verification::Expected;
use accel_core::primitive::triangles_of_mesh;
use accel_core::{InvalidPrimitives, Triangle};
use rayon::prelude::*;

const TRIANGLES: usize = 1200;
const SIZE: (u32, u32) = (24, 18);

#[test]
fn every_row_agrees_with_brute_force_on_every_scene_and_kind_of_rays() {
    embedded::all().par_iter().for_each(check);
}

fn check(scene: &EmbeddedScene) {
    let rows = registry::select(&["all".to_owned()]).unwrap();
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
