//! The embedded scenes are what they say, at every size.

use accel_bench::scene::{embedded, obj, obj_export};

#[test]
fn scenes_are_finite_sound_and_about_as_large_as_asked() {
    for scene in embedded::all() {
        for asked in [600, 5000, 60_000, 200_000] {
            let mesh = scene.mesh_of(asked);
            let count = mesh.triangles.len();
            assert!(
                mesh.positions.iter().all(|p| p.is_finite()),
                "{} at {asked}",
                scene.name
            );
            let last = mesh.positions.len() as u32;
            assert!(
                mesh.triangles.iter().flatten().all(|&i| i < last),
                "{}",
                scene.name
            );
            // Furniture, stems and halls have parts that do not get coarser.
            let floor = 10_000;
            let (low, high) = (asked * 3 / 4, (asked * 5 / 4).max(floor));
            assert!(
                (low..=high).contains(&count),
                "{} has {count}, asked {asked}",
                scene.name
            );
        }
    }
}

#[test]
fn the_cylinder_has_the_596_triangles_of_the_paper() {
    let mesh = embedded::find("cylinder").unwrap().mesh();
    assert_eq!(mesh.triangles.len(), 596);
}

#[test]
fn scenes_are_the_same_every_time() {
    for scene in embedded::all() {
        assert_eq!(scene.mesh_of(3000), scene.mesh_of(3000), "{}", scene.name);
    }
}

#[test]
fn an_exported_scene_is_read_back_bit_for_bit() {
    let mesh = embedded::find("room").unwrap().mesh_of(9000);
    let mut text = Vec::new();
    obj_export::write_obj(&mesh, &mut text).unwrap();
    let limits = obj::ObjLimits::default();
    let loaded = obj::read(text.as_slice(), "room.obj".as_ref(), &limits).unwrap();
    let corners = |mesh: &accel_bench::scene::Mesh| -> Vec<_> {
        (0..mesh.triangles.len())
            .map(|i| mesh.corners(i).map(|p| p.to_array().map(f32::to_bits)))
            .collect()
    };
    assert_eq!(corners(&loaded.mesh), corners(&mesh));
}
