//! Whether families show what their descriptions claim.

use glam::{DVec3, Vec3};

use super::*;

fn scene(name: &str) -> Vec<Triangle> {
    find(name).unwrap().scene(5, 1000)
}

fn vertices(scene: &[Triangle]) -> impl Iterator<Item = Vec3> {
    scene.iter().flat_map(Triangle::vertices)
}

fn bounds(triangle: &Triangle) -> (Vec3, Vec3) {
    let [a, b, c] = triangle.vertices();
    (a.min(b).min(c), a.max(b).max(c))
}

/// Twice the area, in f64.
fn area(triangle: &Triangle) -> f64 {
    let [a, b, c] = triangle.vertices().map(Vec3::as_dvec3);
    (b - a).cross(c - a).length()
}

#[test]
fn points_and_lines_have_no_area() {
    for name in [
        "points",
        "lines-repeated-vertex",
        "lines-collinear",
        "one-point",
    ] {
        assert!(scene(name).iter().all(|t| area(t) == 0.0), "{name}");
    }
    for triangle in scene("lines-axis-parallel") {
        let (low, high) = bounds(&triangle);
        let extents = (high - low).to_array();
        assert_eq!(extents.iter().filter(|&&extent| extent > 0.0).count(), 1);
    }
}

#[test]
fn slivers_are_thin_but_have_area() {
    for (name, width) in [
        ("slivers-1e-7", 1e-7),
        ("slivers-1e-15", 1e-15),
        ("slivers-1e-30", 1e-30),
    ] {
        let slivers = scene(name);
        let thin = |t: &&Triangle| (0.1 * width..10.0 * width).contains(&area(t));
        let share = slivers.iter().filter(thin).count();
        assert!(2 * share >= slivers.len(), "{name}: {share}");
    }
}

#[test]
fn nested_centroids_coincide_exactly() {
    let scene = find("nested-centroids").unwrap().scene(3, 10_000);
    let box_center = |t: &Triangle| bounds(t).0.midpoint(bounds(t).1);
    let corner_mean = |t: &Triangle| (t.a.as_dvec3() + t.b.as_dvec3() + t.c.as_dvec3()) / 3.0;
    let center = box_center(&scene[0]);
    for triangle in &scene {
        assert_eq!(box_center(triangle), center);
        assert_eq!(corner_mean(triangle), center.as_dvec3());
        assert!(area(triangle) > 0.0);
    }
}

#[test]
fn flat_scenes_have_no_extent_in_their_axis() {
    for (axis, names) in [
        ["sheet-x", "flat-x"],
        ["sheet-y", "flat-y"],
        ["sheet-z", "flat-z"],
    ]
    .iter()
    .enumerate()
    {
        for name in names {
            let scene = scene(name);
            let height = scene[0].a[axis];
            assert!(vertices(&scene).all(|v| v[axis] == height), "{name}");
        }
    }
}

#[test]
fn the_rotated_sheet_lies_on_no_axis_aligned_plane() {
    let scene = scene("sheet-rotated-45");
    let normal = DVec3::new(1.0, -1.0, 0.0).normalize();
    let turned = DVec3::new(1.0, 1.0, 0.0).normalize();
    let spread = |direction: DVec3| {
        let along = vertices(&scene).map(|v| direction.dot(v.as_dvec3()));
        let (low, high) = along.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
        high - low
    };
    assert!(spread(normal).min(spread(turned)) < 1e-6);
    assert!(spread(DVec3::X) > 0.5 && spread(DVec3::Y) > 0.5);
}

#[test]
fn the_cylinder_of_the_paper_has_596_triangles() {
    let family = find("skinny-cylinder-rotated").unwrap();
    assert_eq!(family.scene(0, family.full_size).len(), 596);
}

#[test]
fn scales_are_those_of_their_names() {
    let largest = |name| vertices(&scene(name)).fold(0.0, |m: f32, v| m.max(v.abs().max_element()));
    assert!((1e29..1e31).contains(&largest("scale-1e30")));
    assert!((1e-31..1e-29).contains(&largest("scale-1e-30")));
    assert!((f32::MAX / 16.0..f32::MAX / 4.0).contains(&largest("scale-near-max")));
    assert_eq!(largest("scale-max"), f32::MAX);
    assert!((f32::from_bits(1)..f32::MIN_POSITIVE).contains(&largest("subnormal")));
    let bits = |value: f32| {
        let scene = scene("negative-zero");
        let coordinates: Vec<_> = vertices(&scene).flat_map(|v| v.to_array()).collect();
        coordinates.iter().any(|x| x.to_bits() == value.to_bits())
    };
    assert!(bits(0.0) && bits(-0.0));
}

#[test]
fn the_stadium_is_a_million_times_the_figure() {
    let extent = |scene: &[Triangle]| {
        let low = vertices(scene).fold(Vec3::INFINITY, Vec3::min);
        let high = vertices(scene).fold(Vec3::NEG_INFINITY, Vec3::max);
        (high - low).max_element()
    };
    let ratio = extent(&stadium::stadium(1000)) / extent(&stadium::figure(5000));
    assert!((4e5..4e6).contains(&ratio), "{ratio}");
}

#[test]
fn integer_scenes_have_integer_coordinates() {
    for name in ["axis-grid", "touching-cubes", "integer-soup"] {
        assert!(vertices(&scene(name)).all(|v| v == v.round()), "{name}");
    }
}
