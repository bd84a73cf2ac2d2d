//! Which two slacks all axis-aligned planes of a tree share.
//!
//! A traversal may take more slack than the build, and visits both sides of a plane a
//! little more often. Shared, the slack takes no room in a node, and a ray needs no
//! sum for it at each. Two are enough to keep that of large primitives, or of the
//! whole scene, away from the small ones.

use crate::node::SlackClass;

/// The slacks that axis-aligned planes share.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SharedSlacks {
    pub small: f32,
    pub large: f32,
}

impl SharedSlacks {
    #[inline]
    pub(crate) fn of(self, class: SlackClass) -> f32 {
        match class {
            SlackClass::Small => self.small,
            SlackClass::Large => self.large,
        }
    }

    /// Which one is for planes of this slack, at most the large one.
    pub(crate) fn class_of(self, slack: f32) -> SlackClass {
        debug_assert!(slack <= self.large);
        if slack <= self.small {
            SlackClass::Small
        } else {
            SlackClass::Large
        }
    }
}

/// How many axis-aligned planes a tree has by the binary exponent of their slack.
pub(crate) struct SlackCounts {
    counts: [u32; 256],
    /// By exponent.
    largest: [f32; 256],
}

impl Default for SlackCounts {
    fn default() -> Self {
        Self {
            counts: [0; 256],
            largest: [0.0; 256],
        }
    }
}

impl SlackCounts {
    /// Counts a slack, finite and positive.
    pub(crate) fn count(&mut self, slack: f32) {
        let exponent = exponent_of(slack);
        self.counts[exponent] = self.counts[exponent].saturating_add(1);
        self.largest[exponent] = self.largest[exponent].max(slack);
    }

    /// The smaller slack and the largest one, such that planes have as few powers of
    /// two more than their own as can be.
    pub(crate) fn shared(&self) -> SharedSlacks {
        let in_use = |exponent: &usize| self.counts[*exponent] > 0;
        let Some(largest) = (0..256).rev().find(in_use) else {
            return SharedSlacks::default();
        };
        let excess = |small: &usize| -> u64 {
            let excess_of = |exponent: usize| {
                let shared = if exponent <= *small { *small } else { largest };
                (shared - exponent) as u64 * u64::from(self.counts[exponent])
            };
            (0..=largest).map(excess_of).sum()
        };
        let small = (0..=largest).filter(in_use).min_by_key(excess);
        SharedSlacks {
            small: self.largest[small.unwrap_or(largest)],
            large: self.largest[largest],
        }
    }
}

fn exponent_of(slack: f32) -> usize {
    (slack.to_bits() >> 23 & 0xff) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shared(slacks: &[f32]) -> [f32; 2] {
        let mut counts = SlackCounts::default();
        slacks.iter().for_each(|&slack| counts.count(slack));
        let shared = counts.shared();
        [shared.small, shared.large]
    }

    #[test]
    fn few_large_slacks_are_kept_from_many_small_ones() {
        assert_eq!(shared(&[]), [0.0; 2]);
        assert_eq!(shared(&[0.25]), [0.25; 2]);
        assert_eq!(shared(&[1.0, 1.5, 1.25]), [1.5; 2]);
        assert_eq!(shared(&[0.001, 0.0011, 0.0012, 8.0]), [0.0012, 8.0]);
        assert_eq!(shared(&[0.001, 0.0011, 6.0, 6.5, 8.0]), [0.0011, 8.0]);
        assert_eq!(shared(&[0.001, 4.0, 6.0, 6.5, 8.0]), [0.001, 8.0]);
        assert_eq!(shared(&[f32::MIN_POSITIVE, f32::MAX])[1], f32::MAX);
    }
}
