//! How polygons become triangles.

use std::fmt::Write as _;

use accel_bench::scene::obj::{FaultKind, LoadedObj};
use glam::{Vec3, Vec3Swizzles};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::accept;

/// A file of one polygon.
fn polygon(corners: &[Vec3]) -> LoadedObj {
    let mut text = String::new();
    for corner in corners {
        writeln!(text, "v {} {} {}", corner.x, corner.y, corner.z).unwrap();
    }
    text.push('f');
    (1..=corners.len()).for_each(|index| write!(text, " {index}").unwrap());
    accept(text.as_bytes())
}

/// Twice the area vector of each triangle.
fn area_vectors(loaded: &LoadedObj) -> Vec<Vec3> {
    (0..loaded.mesh.triangles.len())
        .map(|triangle| {
            let [a, b, c] = loaded.mesh.corners(triangle);
            (b - a).cross(c - a)
        })
        .collect()
}

/// Checks that triangles of one orientation, and none without area, cover
/// exactly a polygon in a plane z = const with this area, each corner used.
fn assert_covers(loaded: &LoadedObj, corners: usize, area: f32) {
    let areas = area_vectors(loaded);
    assert_eq!(areas.len(), corners - 2);
    assert!(areas.iter().all(|vector| vector.z > 0.0), "{areas:?}");
    let sum: f32 = areas.iter().map(|vector| vector.z / 2.0).sum();
    assert!((sum - area).abs() <= 1e-4 * area, "{sum} instead of {area}");
    assert_eq!(loaded.mesh.positions.len(), corners);
    assert!(loaded.faults.is_empty(), "{}", loaded.faults);
}

fn flat(points: &[[f32; 2]]) -> Vec<Vec3> {
    points.iter().map(|&[x, y]| Vec3::new(x, y, 2.0)).collect()
}

#[test]
fn a_convex_polygon_is_the_fan_of_its_first_corner() {
    let hexagon = flat(&[
        [1.0, 0.0],
        [2.0, 0.0],
        [3.0, 1.0],
        [2.0, 2.0],
        [1.0, 2.0],
        [0.0, 1.0],
    ]);
    let fan = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
    assert_eq!(polygon(&hexagon).mesh.triangles, fan);
    let mirrored: Vec<Vec3> = hexagon.iter().map(|point| point.with_x(-point.x)).collect();
    assert_eq!(polygon(&mirrored).mesh.triangles, fan);
}

#[test]
fn a_convex_polygon_with_straight_corners_is_a_fan() {
    let square = flat(&[
        [0.0, 0.0],
        [1.0, 0.0],
        [2.0, 0.0],
        [2.0, 2.0],
        [0.0, 2.0],
        [0.0, 1.0],
    ]);
    let fan = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
    assert_eq!(polygon(&square).mesh.triangles, fan);
}

#[test]
fn a_concave_quad_is_cut_at_its_notch() {
    let arrow = flat(&[[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [1.0, 1.0]]);
    for shift in 0..4 {
        let mut turned = arrow.clone();
        turned.rotate_left(shift);
        assert_covers(&polygon(&turned), 4, 1.0);
    }
}

#[test]
fn concave_polygons_come_right_in_every_plane_and_orientation() {
    let shape = flat(&[
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 3.0],
        [3.0, 3.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [1.0, 3.0],
        [0.0, 3.0],
    ]);
    assert_covers(&polygon(&shape), 8, 8.0);
    for turn in [
        |p: Vec3| p.yzx(),
        |p: Vec3| p.zxy(),
        |p: Vec3| p.yxz(),
        |p: Vec3| p.with_z(p.x + 2.0 * p.y),
    ] {
        let turned: Vec<Vec3> = shape.iter().map(|&point| turn(point)).collect();
        let areas = area_vectors(&polygon(&turned));
        let total: Vec3 = areas.iter().sum();
        assert_eq!(areas.len(), 6);
        assert!(
            areas.iter().all(|vector| vector.dot(total) > 0.0),
            "{areas:?}"
        );
        assert!(
            (total.length() - areas.iter().map(|vector| vector.length()).sum::<f32>()).abs() < 1e-4
        );
    }
}

#[test]
fn straight_corners_of_a_concave_polygon_are_kept() {
    let l_shape = flat(&[
        [0.0, 0.0],
        [1.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [1.5, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
        [0.0, 1.0],
    ]);
    let loaded = polygon(&l_shape);
    assert_covers(&loaded, 9, 3.0);
    for corner in 0..9 {
        assert!(
            loaded
                .mesh
                .triangles
                .iter()
                .flatten()
                .any(|&index| index == corner)
        );
    }
}

#[test]
fn a_hole_connected_by_a_slit_stays_open() {
    let outline = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 3.0],
        [0.0, 3.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [2.0, 2.0],
        [2.0, 1.0],
        [1.0, 1.0],
    ];
    let loaded = polygon(&flat(&outline));
    assert_covers(&loaded, 10, 8.0);
    for triangle in 0..8 {
        let centre = loaded.mesh.corners(triangle).iter().sum::<Vec3>() / 3.0;
        let inside = |value: f32| value > 1.0 && value < 2.0;
        assert!(
            !(inside(centre.x) && inside(centre.y)),
            "{centre} is in the hole"
        );
    }
}

#[test]
fn a_polygon_of_a_thousand_corners_is_covered() {
    let ring = |radius: fn(usize) -> f32| -> Vec<[f32; 2]> {
        let angle = |at: usize| at as f32 * std::f32::consts::TAU / 1000.0;
        (0..1000)
            .map(|at| [radius(at) * angle(at).cos(), radius(at) * angle(at).sin()])
            .collect()
    };
    let sector = (std::f32::consts::TAU / 1000.0).sin() / 2.0;
    let circle = polygon(&flat(&ring(|_| 1.0)));
    assert_covers(&circle, 1000, 1000.0 * sector);
    assert_eq!(circle.mesh.triangles[997], [0, 998, 999]);
    let star = polygon(&flat(&ring(|at| if at % 2 == 0 { 1.0 } else { 0.5 })));
    assert_covers(&star, 1000, 500.0 * sector);
}

#[test]
fn random_polygons_round_a_centre_are_covered() {
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    for _ in 0..300 {
        let count = rng.random_range(5..60);
        let points: Vec<[f32; 2]> = (0..count)
            .map(|at| {
                let angle = at as f32 * std::f32::consts::TAU / count as f32;
                let radius = rng.random_range(0.05..1.0);
                [radius * angle.cos(), radius * angle.sin()]
            })
            .collect();
        let cross = |at: usize| {
            let ([ax, ay], [bx, by]) = (points[at], points[(at + 1) % count]);
            ax * by - ay * bx
        };
        let area = (0..count).map(cross).sum::<f32>() / 2.0;
        assert_covers(&polygon(&flat(&points)), count, area);
    }
}

#[test]
fn a_comb_at_the_limit_of_corners_is_covered_in_bounded_time() {
    let teeth = 4095;
    let mut comb = vec![[0.0, -1.0], [teeth as f32, -1.0]];
    for tooth in (0..teeth).rev() {
        let x = tooth as f32;
        comb.extend([
            [x + 0.75, 0.0],
            [x + 0.625, 4.0],
            [x + 0.375, 4.0],
            [x + 0.25, 0.0],
        ]);
    }
    let area = teeth as f32 * (1.0 + 1.5) - 0.25;
    let start = std::time::Instant::now();
    assert_covers(&polygon(&flat(&comb)), comb.len(), area);
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
}

#[test]
fn polygons_that_cannot_be_split_are_fans_and_reported() {
    let pentagram = [
        [0.0, 3.0],
        [-2.0, -2.0],
        [3.0, 1.0],
        [-3.0, 1.0],
        [2.0, -2.0],
    ];
    let bow_tie = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
    let segment = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]];
    let infinite = [[0.0, 0.0], [1.0, 0.0], [f32::INFINITY, 1.0], [0.0, 1.0]];
    for points in [&pentagram[..], &bow_tie, &segment, &infinite] {
        let loaded = polygon(&flat(points));
        assert_eq!(loaded.mesh.triangles.len(), points.len() - 2);
        let fault = loaded
            .faults
            .of(FaultKind::UnsplittablePolygon)
            .expect("a fault");
        assert_eq!(fault.first_lines, [points.len() as u64 + 1], "{points:?}");
    }
}

#[test]
fn triangles_of_a_polygon_stand_between_those_of_its_neighbours() {
    let loaded = accept(
        b"v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\nv 9 9 9\nf 1 2 5\nf 2 3 4 1\nf 3 4 5\nf 5 1 2\n",
    );
    let triangles = &loaded.mesh.triangles;
    assert_eq!(triangles.len(), 5);
    assert_eq!(
        (triangles[0], triangles[3], triangles[4]),
        ([0, 1, 4], [2, 3, 4], [4, 0, 1])
    );
    assert!(
        triangles[1..3]
            .iter()
            .all(|triangle| triangle.contains(&1) && triangle.contains(&3))
    );
}
