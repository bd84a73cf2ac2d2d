//! What holds of every family.

use std::collections::HashSet;

use super::*;

fn is_finite(triangle: &Triangle) -> bool {
    triangle.vertices().iter().all(|vertex| vertex.is_finite())
}

/// Bits, because NaN differs from itself and zero equals minus zero.
fn bits(scene: &[Triangle]) -> Vec<u32> {
    let vertices = scene.iter().flat_map(Triangle::vertices);
    vertices
        .flat_map(|v| v.to_array())
        .map(f32::to_bits)
        .collect()
}

#[test]
fn there_are_at_least_44_families_with_distinct_names() {
    let names: HashSet<_> = all().iter().map(|family| family.name).collect();
    assert_eq!(names.len(), all().len());
    assert!(names.len() >= 44, "only {} families", names.len());
    for family in all() {
        assert_eq!(find(family.name).unwrap().name, family.name);
        assert!(!family.about.is_empty());
    }
    assert!(find("no such family").is_none());
}

#[test]
fn scenes_never_exceed_the_size_asked_for() {
    for family in all() {
        for size in [0, 1, 2, 3, 5, 12, 13, 100, 1999, 2000] {
            let triangles = family.scene(7, size).len();
            assert!(triangles <= size, "{}: {triangles} of {size}", family.name);
        }
    }
}

#[test]
fn scenes_come_near_the_size_asked_for() {
    for family in all() {
        let smallest = match family.name {
            "empty" => 0,
            "one-triangle" => 1,
            _ => 1200,
        };
        let triangles = family.scene(3, 2000).len();
        assert!(triangles >= smallest, "{}: {triangles}", family.name);
    }
}

#[test]
fn a_scene_follows_from_its_seed() {
    for family in all() {
        let first = bits(&family.scene(11, 500));
        assert_eq!(first, bits(&family.scene(11, 500)), "{}", family.name);
    }
}

#[test]
fn seeds_vary_every_scene_that_can_vary() {
    for family in all().iter().filter(|family| family.name != "empty") {
        let first = bits(&family.scene(1, 500));
        assert_ne!(first, bits(&family.scene(2, 500)), "{}", family.name);
    }
}

#[test]
fn has_invalid_tells_the_truth() {
    for family in all() {
        for (seed, size) in [(0, 1), (1, 10), (2, 100), (3, 2000)] {
            let scene = family.scene(seed, size);
            let has_invalid = !scene.iter().all(is_finite);
            assert_eq!(has_invalid, family.has_invalid, "{}", family.name);
        }
    }
}

#[test]
fn full_sizes_are_those_the_numerics_demand() {
    for (name, size) in [
        ("one-point", 1_000_000),
        ("duplicates", 100_000),
        ("nested-centroids", 10_000),
    ] {
        let family = find(name).unwrap();
        assert_eq!(family.full_size, size);
        assert_eq!(family.scene(0, size).len(), size);
    }
}
