//! The full search: every position in the order along an axis.

use super::{Rank, SplitCandidate, SurfaceAreaHeuristic};
use crate::geometry::{Axis, GrowingBox};
use crate::reference::Reference;

/// The cheapest way to cut `references`, sorted along `axis`, into a first and a
/// second part; the position is the number of references in the first. `None`
/// for fewer than two references.
///
/// One pass from the end records the areas of all second parts, one from the
/// start evaluates every cut (Wald 2007, *On fast Construction of SAH-based
/// Bounding Volume Hierarchies*, section 2). `areas` is scratch memory, as long
/// as `references`.
///
/// # Panics
/// If `areas` is empty.
pub fn cheapest_cut<R: AsRef<Reference>>(
    references: &[R],
    axis: Axis,
    parent_area: f64,
    heuristic: &SurfaceAreaHeuristic,
    areas: &mut [f64],
) -> Option<SplitCandidate<usize>> {
    let count = references.len();
    let node_cost = heuristic.of_node(parent_area, count);
    record_areas_from_end(references, areas);
    let mut bounds = GrowingBox::empty();
    let (mut best, mut best_position) = (Rank::WORST, None);
    for (before, (reference, &area)) in references.iter().zip(&areas[1..]).enumerate() {
        let position = before + 1;
        bounds.add(&reference.as_ref().bounds);
        let counts = [position, count - position];
        let rank = Rank::new(node_cost.split([bounds.half_area(), area], counts), counts);
        if rank.beats(best) {
            (best, best_position) = (rank, Some(position));
        }
    }
    best_position.map(|position| SplitCandidate {
        axis,
        position,
        cost: best.cost,
        counts: [position, count - position],
    })
}

/// `areas[i]` becomes the half area around `references[i..]`.
fn record_areas_from_end<R: AsRef<Reference>>(references: &[R], areas: &mut [f64]) {
    let mut bounds = GrowingBox::empty();
    for (reference, area) in references.iter().zip(areas).rev() {
        bounds.add(&reference.as_ref().bounds);
        *area = bounds.half_area();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;

    #[test]
    fn two_clusters_are_cut_apart() {
        let xs = [0.0, 0.1, 0.2, 5.0, 5.1];
        let references: Vec<Reference> = (0..)
            .zip(xs)
            .map(|(id, x)| Reference {
                bounds: Aabb::new([x, 0.0, 0.0], [x + 0.05, 1.0, 1.0]),
                id,
            })
            .collect();
        let parent = crate::reference::bounds_of(&references).half_area();
        let heuristic = SurfaceAreaHeuristic::default();
        let mut areas = vec![0.0; references.len()];
        let cut = cheapest_cut(&references, Axis::X, parent, &heuristic, &mut areas).unwrap();
        assert_eq!((cut.position, cut.counts), (3, [3, 2]));
    }

    #[test]
    fn coincident_references_are_cut_in_the_middle() {
        let same = Reference {
            bounds: Aabb::new([1.0; 3], [1.0; 3]),
            id: 0,
        };
        let heuristic = SurfaceAreaHeuristic::default();
        let cut = cheapest_cut(&[same; 10], Axis::Y, 0.0, &heuristic, &mut [0.0; 10]).unwrap();
        assert_eq!(cut.position, 5);
        assert!(cheapest_cut(&[same], Axis::Y, 0.0, &heuristic, &mut [0.0]).is_none());
    }
}
