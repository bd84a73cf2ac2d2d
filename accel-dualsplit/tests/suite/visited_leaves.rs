//! Which leaves a query visits whose interval does not shrink: *identical* trees,
//! BIH and H-tree those of their BVH, no more and no fewer; *similar* trees at least
//! these.

use crate::recorder::{Trees, recorders};
use accel_core::testing::{families, rays};
use accel_dualsplit::{BvhBuilder, LeafRule, ObjectSplit};

#[test]
fn identical_trees_visit_the_leaves_of_their_bvh_and_similar_ones_at_least_these() {
    let (mut visited, mut more) = (0_usize, 0_usize);
    for family in families::all() {
        for (seed, object_split, leaf_rule) in [
            (1, ObjectSplit::FullSweep, LeafRule::SahUpTo(8)),
            (2, ObjectSplit::default(), LeafRule::StopAt(1)),
        ] {
            let scene = family.scene(seed, 800.min(family.full_size));
            let builder = BvhBuilder {
                object_split,
                leaf_rule,
                ..BvhBuilder::default()
            };
            let trees = Trees::new(&builder, &recorders(&scene)).unwrap();
            for ray in rays::mixed(&scene, seed, 400) {
                let visits = trees.visits(&ray);
                let name = family.name;
                assert_eq!(visits.are_same, [true; 3], "{name} {seed} {ray:?}");
                assert!(visits.similar_has_all, "{name} {seed} {ray:?}");
                visited += visits.in_bvh;
                more += visits.more_in_similar;
            }
        }
    }
    assert!(visited > 100_000 && more > 0, "{visited} {more}");
}
