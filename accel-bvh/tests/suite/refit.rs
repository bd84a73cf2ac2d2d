//! Refitted trees answer as brute force over the moved primitives does.

use accel_bvh::{BvhBuilder, InvalidPrimitives, ObjectSplit, RefitError, Triangle};
use accel_core::glam::Vec3;
use accel_core::testing::agreement::Expected;
use accel_core::testing::{families, rays};

fn moved(triangles: &[Triangle], by: f32) -> Vec<Triangle> {
    triangles
        .iter()
        .zip(0_u32..)
        .map(|(triangle, id)| {
            let angle = id as f32;
            let shift = Vec3::new(angle.sin(), angle.cos(), (angle * 0.7).sin()) * by;
            Triangle::from(triangle.vertices().map(|vertex| vertex * 1.25 + shift))
        })
        .collect()
}

#[test]
fn a_refitted_tree_agrees_with_brute_force_and_is_valid() {
    for (seed, name) in (0..).zip([
        "soup-uniform",
        "hairball",
        "nan-mixed",
        "one-triangle",
        "duplicates",
    ]) {
        let triangles = families::find(name).expect(name).scene(seed, 500);
        for object_split in [ObjectSplit::FullSweep, ObjectSplit::default()] {
            let builder = BvhBuilder {
                object_split,
                invalid_primitives: InvalidPrimitives::Skip,
                ..BvhBuilder::default()
            };
            let mut bvh = builder.build(&triangles).unwrap();
            let moved = moved(&triangles, 0.2);
            bvh.refit(&moved).unwrap();
            bvh.validate().unwrap();
            let expected = Expected::new(&moved, rays::mixed(&moved, seed, 300)).unwrap();
            let disagreements = expected.disagreements(&bvh);
            assert!(disagreements.is_empty(), "{name}: {}", disagreements[0]);
        }
    }
}

#[test]
fn a_refit_that_fails_leaves_the_tree_as_it_was() {
    let triangles = families::find("soup-uniform").unwrap().scene(3, 100);
    let mut bvh = BvhBuilder::default().build(&triangles).unwrap();
    let words = bvh.node_words().to_vec();
    let error = bvh.refit(&triangles[1..]).unwrap_err();
    assert_eq!(
        error,
        RefitError::CountMismatch {
            given: 99,
            expected: 100
        }
    );
    let mut broken = moved(&triangles, 1.0);
    broken[42].a.x = f32::NAN;
    let error = bvh.refit(&broken).unwrap_err();
    assert!(
        matches!(error, RefitError::InvalidPrimitive { id: 42, .. }),
        "{error}"
    );
    assert_eq!(bvh.node_words(), words);
    bvh.validate().unwrap();
}
