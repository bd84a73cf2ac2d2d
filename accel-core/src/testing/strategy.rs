//! Proptest strategies: scenes and rays that shrink.

use glam::Vec3;
use proptest::prelude::*;
use proptest::sample::subsequence;

use super::families;
use crate::{RaySegment, Triangle};

/// Scenes of at most `largest` triangles: of any family, or of raw coordinates.
/// They shrink by leaving triangles out.
pub fn any_scene(largest: usize) -> impl Strategy<Value = Vec<Triangle>> {
    let count = families::all().count();
    let of_family = (0..count, any::<u64>(), 1..=largest).prop_map(|(index, seed, size)| {
        let family = families::all().nth(index);
        family.map_or_else(Vec::new, |family| family.scene(seed, size))
    });
    let raw = prop::collection::vec(any_triangle(), 0..=largest);
    prop_oneof![3 => of_family, 1 => raw].prop_flat_map(|scene| {
        let count = scene.len();
        subsequence(scene, 0..=count)
    })
}

/// A triangle of raw coordinates.
pub fn any_triangle() -> impl Strategy<Value = Triangle> {
    [any_point(), any_point(), any_point()].prop_map(Triangle::from)
}

/// A ray of raw coordinates, perhaps bounded; some can hit nothing.
pub fn any_ray() -> impl Strategy<Value = RaySegment> {
    let interval = prop_oneof![
        3 => Just((0.0, f32::INFINITY)),
        1 => (any_coordinate(), any_coordinate()),
    ];
    (any_point(), any_point(), interval).prop_map(|(origin, direction, (t_min, t_max))| {
        RaySegment::new(origin, direction).with_interval(t_min, t_max)
    })
}

fn any_point() -> impl Strategy<Value = Vec3> {
    [any_coordinate(), any_coordinate(), any_coordinate()].prop_map(Vec3::from)
}

/// Small integers, where ties are; ordinary numbers; and anything at all.
fn any_coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => (-3_i8..=3).prop_map(f32::from),
        4 => -2.0_f32..2.0,
        1 => any::<f32>(),
    ]
}
