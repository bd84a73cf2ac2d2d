//! Carrying splits out on slices of references.

use crate::geometry::{Aabb, Axis};
use crate::reference::Reference;

/// Reorders `references` so that those for which `is_left` holds come first, and
/// returns how many they are. Deterministic, but does not keep their order.
pub fn in_place<R>(references: &mut [R], is_left: impl Fn(&R) -> bool) -> usize {
    let (mut first, mut end) = (0, references.len());
    while first < end {
        if is_left(&references[first]) {
            first += 1;
        } else {
            end -= 1;
            references.swap(first, end);
        }
    }
    first
}

/// As [`in_place`], keeping the order on both sides. `scratch` is as long as
/// `references`.
pub fn stable<R: Copy>(
    references: &mut [R],
    scratch: &mut [R],
    is_left: impl Fn(&R) -> bool,
) -> usize {
    let (mut left, mut right) = (0, 0);
    for position in 0..references.len() {
        let reference = references[position];
        // Both are written and one counter moves: no branch to mispredict.
        let goes_left = is_left(&reference);
        references[left] = reference;
        scratch[right] = reference;
        left += usize::from(goes_left);
        right += usize::from(!goes_left);
    }
    references[left..].copy_from_slice(&scratch[..right]);
    left
}

/// The fallback that always divides: half of the references, in the order along
/// the widest axis of their centres, on each side. Returns the axis and the
/// number on the left.
pub fn at_median<R: AsRef<Reference>>(references: &mut [R], centers: &Aabb) -> (Axis, usize) {
    let axis = centers.widest_axis();
    let middle = references.len() / 2;
    if middle > 0 {
        references.select_nth_unstable_by_key(middle, |reference| reference.as_ref().key(axis));
    }
    (axis, middle)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn references(ids: &[u32]) -> Vec<Reference> {
        ids.iter()
            .map(|&id| Reference {
                bounds: Aabb::new([id as f32, 0.0, 0.0], [id as f32, 0.0, 0.0]),
                id,
            })
            .collect()
    }

    fn ids(references: &[Reference]) -> Vec<u32> {
        references.iter().map(|reference| reference.id).collect()
    }

    #[test]
    fn stable_partition_keeps_order_and_loses_nothing() {
        let mut all = references(&[5, 2, 8, 1, 9, 4]);
        let mut scratch = all.clone();
        let left = stable(&mut all, &mut scratch, |reference| reference.id % 2 == 0);
        assert_eq!((left, ids(&all)), (3, vec![2, 8, 4, 5, 1, 9]));
    }

    #[test]
    fn in_place_partition_divides_and_loses_nothing() {
        let mut all = references(&[5, 2, 8, 1, 9, 4]);
        let left = in_place(&mut all, |reference| reference.id < 5);
        assert_eq!(left, 3);
        assert!(all[..left].iter().all(|reference| reference.id < 5));
        let mut sorted = ids(&all);
        sorted.sort_unstable();
        assert_eq!(sorted, [1, 2, 4, 5, 8, 9]);
    }

    #[test]
    fn the_median_divides_even_coincident_references() {
        let mut same = references(&[3, 3, 3, 3, 3]);
        let centers = Aabb::new([3.0, 0.0, 0.0], [3.0, 0.0, 0.0]);
        assert_eq!(at_median(&mut same, &centers), (Axis::X, 2));
        let mut mixed = references(&[7, 1, 5, 3]);
        let (axis, left) = at_median(&mut mixed, &Aabb::new([1.0, 0.0, 0.0], [7.0, 0.0, 0.0]));
        assert_eq!((axis, left), (Axis::X, 2));
        assert!(ids(&mixed[..left]).iter().all(|&id| id <= 3));
    }
}
