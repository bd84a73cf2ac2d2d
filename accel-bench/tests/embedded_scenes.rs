//! The embedded scenes are what they say, at every size.

use std::collections::{HashMap, HashSet};

use accel_bench::scene::{Mesh, embedded, obj, obj_export};
use accel_bvh::BvhBuilder;
use accel_core::glam::Vec3;
use accel_core::{AccelerationStructure, Triangle};

fn assert_sound(mesh: &Mesh, what: &str) {
    let is_finite = mesh.positions.iter().all(|p| p.is_finite());
    assert!(is_finite, "{what} has a position that is not finite");
    let count = mesh.positions.len() as u32;
    let in_range = mesh.triangles.iter().flatten().all(|&i| i < count);
    assert!(in_range, "{what} has an index without a position");
    let mut is_used = vec![false; mesh.positions.len()];
    for &index in mesh.triangles.iter().flatten() {
        is_used[index as usize] = true;
    }
    assert!(!is_used.contains(&false), "{what} has idle positions");
    let is_flat = |&[a, b, c]: &[u32; 3]| {
        let [a, b, c] = [a, b, c].map(|i| mesh.positions[i as usize]);
        a == b || b == c || c == a
    };
    let flat = mesh.triangles.iter().filter(|t| is_flat(t)).count();
    assert_eq!(flat, 0, "{what} has triangles with equal corners");
}

#[test]
fn scenes_are_sound_and_within_ten_percent_of_the_count_asked_for() {
    let mut failures = Vec::new();
    for scene in embedded::all() {
        for asked in [
            500, 631, 1000, 1999, 2000, 5000, 12_345, 60_000, 200_000, 1_000_000,
        ] {
            let mesh = scene.mesh_of(asked);
            let what = format!("{} of {asked}", scene.name);
            assert_sound(&mesh, &what);
            let ratio = mesh.triangles.len() as f64 / asked as f64;
            if !(0.9..=1.1).contains(&ratio) {
                failures.push(format!("{what} has {}", mesh.triangles.len()));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn even_the_smallest_scenes_are_sound() {
    for scene in embedded::all() {
        for asked in [0, 1, 7, 50, 150] {
            let mesh = scene.mesh_of(asked);
            assert_sound(&mesh, &format!("{} of {asked}", scene.name));
            assert!(mesh.triangles.len() < 800, "{} of {asked}", scene.name);
        }
    }
}

#[test]
fn the_cylinder_has_the_596_skinny_triangles_of_the_paper() {
    let mesh = embedded::find("cylinder").unwrap().mesh();
    assert_eq!(mesh.triangles.len(), 596);
    let aspect = |i| {
        let [a, b, c] = mesh.corners(i);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        longest * longest / (b - a).cross(c - a).length()
    };
    let skinny = (0..596).filter(|&i| aspect(i) > 10.0).count();
    assert!(skinny > 550, "{skinny}");
    // Closed: each edge belongs to two triangles.
    let mut edges: HashMap<[[u32; 3]; 2], usize> = HashMap::new();
    for i in 0..596 {
        let corners = mesh.corners(i).map(bits);
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let edge = [corners[from], corners[to]];
            *edges
                .entry([edge[0].min(edge[1]), edge[0].max(edge[1])])
                .or_default() += 1;
        }
    }
    assert_eq!(edges.len(), 596 * 3 / 2);
    assert!(edges.values().all(|&count| count == 2));
}

#[test]
fn the_figure_holds_95_percent_of_the_stadium() {
    let mesh = embedded::find("stadium").unwrap().mesh();
    let is_of_figure = |&i: &usize| mesh.corners(i).iter().all(|p| p.length() < 2.6);
    let of_figure = (0..mesh.triangles.len()).filter(is_of_figure).count();
    let percent = of_figure as f64 * 100.0 / mesh.triangles.len() as f64;
    assert!((94.0..96.0).contains(&percent), "{percent}");
}

#[test]
fn a_seed_gives_the_same_scene_every_time_and_another_seed_another() {
    for scene in embedded::all() {
        let first = (scene.generate)(3000, 1);
        assert_eq!(first, (scene.generate)(3000, 1), "{}", scene.name);
        let is_other = first != (scene.generate)(3000, 2);
        // Nothing in the cylinder is random.
        assert_eq!(is_other, scene.name != "cylinder", "{}", scene.name);
    }
}

#[test]
fn names_are_unique_and_found() {
    for scene in embedded::all() {
        let found = embedded::find(scene.name).unwrap();
        assert_eq!(found.description, scene.description);
    }
    assert!(embedded::find("Room").is_none());
}

#[test]
fn every_camera_sees_its_scene_in_most_of_its_picture() {
    for scene in embedded::all() {
        let triangles = scene.mesh();
        let triangles: Vec<_> = (0..triangles.triangles.len())
            .map(|i| Triangle::from(triangles.corners(i)))
            .collect();
        let bvh = BvhBuilder::default().build(&triangles).unwrap();
        for camera in scene.cameras() {
            let camera = camera.validated().unwrap();
            let rays = camera.rays(40, 30);
            let hits: HashSet<_> = rays
                .iter()
                .filter_map(|ray| bvh.closest_hit(ray))
                .map(|hit| hit.id)
                .collect();
            let count = rays.iter().filter(|ray| bvh.any_hit(ray)).count();
            let what = format!("{}: {camera}", scene.name);
            assert!(count * 100 >= 15 * rays.len(), "{what} hits with {count}");
            assert!(hits.len() >= 50, "{what} sees {} triangles", hits.len());
        }
    }
}

#[test]
fn an_exported_scene_is_read_back_bit_for_bit() {
    assert_read_back(&embedded::find("room").unwrap().mesh_of(9000));
}

#[test]
fn extreme_numbers_are_exported_to_their_bits() {
    let numbers = [
        0.0,
        -0.0,
        0.1,
        1.0 / 3.0,
        16_777_216.0,
        f32::MAX,
        -f32::MAX,
        f32::MIN_POSITIVE,
        f32::from_bits(1),
        f32::from_bits(0x007f_ffff),
        f32::EPSILON,
        1.000_000_1,
        3.402_823e37,
        1e-40,
        -123_456.79,
    ];
    let positions = numbers.chunks_exact(3).map(Vec3::from_slice).collect();
    let triangles = vec![[0, 1, 2], [2, 3, 4], [4, 0, 1]];
    assert_read_back(&Mesh {
        positions,
        triangles,
    });
}

fn assert_read_back(mesh: &Mesh) {
    let mut text = Vec::new();
    obj_export::write_obj(mesh, &mut text).unwrap();
    let limits = obj::ObjLimits::default();
    let loaded = obj::read(text.as_slice(), "export.obj".as_ref(), &limits).unwrap();
    let corners = |mesh: &Mesh| -> Vec<_> {
        let all = 0..mesh.triangles.len();
        all.map(|i| mesh.corners(i).map(bits)).collect()
    };
    assert_eq!(corners(&loaded.mesh), corners(mesh));
}

fn bits(position: Vec3) -> [u32; 3] {
    position.to_array().map(f32::to_bits)
}
