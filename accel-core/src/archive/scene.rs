//! By what an archive knows the primitives that it is over.

use super::{FNV_START, fnv};
use crate::geometry::Aabb;
use crate::glam::Vec3;
use crate::primitive::Primitive;
use crate::structure::AccelerationStructure;

/// The fingerprint of the primitives of a structure: of the points that `points`
/// gives of each, and of which primitives were skipped.
pub fn scene_of_structure<A: AccelerationStructure, I: IntoIterator<Item = Vec3>>(
    structure: &A,
    points: impl Fn(&A::Primitive) -> I,
) -> u64 {
    let ids = 0..structure.primitive_count() as u32;
    fingerprint(ids.map(|id| structure.primitive(id)), points)
}

/// The fingerprint of the primitives of a slice, of which a structure skips those
/// without valid bounds.
pub fn scene_of_slice<P: Primitive, I: IntoIterator<Item = Vec3>>(
    primitives: &[P],
    points: impl Fn(&P) -> I,
) -> u64 {
    let valid = |primitive: &P| primitive.bounds().is_valid().then(|| primitive.clone());
    fingerprint(primitives.iter().map(valid), points)
}

/// The corners of a primitive's box: what a tree of boxes depends on.
pub fn bounds_of_scene<P: Primitive>(primitive: &P) -> [Vec3; 2] {
    let bounds = primitive.bounds();
    [bounds.min, bounds.max]
}

/// The box around the gates of all primitives with valid bounds, outside which there is
/// no hit; empty if there are none. The same as a builder's references have.
pub fn bounds_of_hits<P: Primitive>(primitives: &[P]) -> Aabb {
    let boxes = primitives.iter().map(P::bounds).filter(Aabb::is_valid);
    boxes.fold(Aabb::EMPTY, |all, bounds| all.union(&bounds.gate()))
}

/// The 64-bit hash of Fowler, Noll and Vo (FNV-1a).
fn fingerprint<P, I: IntoIterator<Item = Vec3>>(
    primitives: impl Iterator<Item = Option<P>>,
    points: impl Fn(&P) -> I,
) -> u64 {
    let word = |hash: u64, word: u32| fnv(hash, &word.to_le_bytes());
    primitives.fold(FNV_START, |hash, primitive| match primitive {
        None => word(hash, 0),
        Some(primitive) => {
            let coordinates = points(&primitive)
                .into_iter()
                .flat_map(|point| point.to_array());
            coordinates.fold(word(hash, 1), |hash, value| word(hash, value.to_bits()))
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BruteForce, InvalidPrimitives, Triangle};

    #[test]
    fn a_structure_and_its_slice_have_one_fingerprint_and_moved_points_another() {
        let triangle = Triangle::new([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let broken = Triangle::new([f32::NAN; 3], [1.0; 3], [2.0; 3]);
        let scene = [broken, triangle, triangle];
        let structure: BruteForce<Triangle> =
            BruteForce::with_storage(&scene, InvalidPrimitives::Skip).unwrap();
        let corners = |triangle: &Triangle| triangle.vertices();
        let expected = scene_of_structure(&structure, corners);
        assert_eq!(scene_of_slice(&scene, corners), expected);
        assert_ne!(scene_of_slice(&scene[1..], corners), expected);
        assert_ne!(scene_of_slice(&scene, bounds_of_scene), expected);
    }
}
