//! Which two slacks the axis-aligned planes of a tree share.
//!
//! A traversal may take more slack than the build, and visits both sides of a plane a
//! little more often. Shared, the slack takes no room in a node, and a ray needs no
//! sum for it at each. One is for the bulk, and one for those of large primitives or of
//! the whole scene. Planes that neither suits are stored as general ones, which have
//! their own.

use crate::node::SlackClass;

/// The most that a plane's slack grows by being shared, in powers of two.
const MOST_EXCESS: usize = 4;

/// The slacks that axis-aligned planes share.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SharedSlacks {
    pub small: f32,
    /// No less than `small`.
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

    /// Which one suits planes of this slack, if any does.
    pub(crate) fn class_of(self, slack: f32) -> Option<SlackClass> {
        let suits = |class: &SlackClass| {
            let shared = self.of(*class);
            slack <= shared && exponent_of(slack) + MOST_EXCESS > exponent_of(shared)
        };
        [SlackClass::Small, SlackClass::Large]
            .into_iter()
            .find(suits)
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

    /// The largest slack, and of the smaller ones that which suits the most planes.
    pub(crate) fn shared(&self) -> SharedSlacks {
        let in_use = |exponent: &usize| self.counts[*exponent] > 0;
        let Some(largest) = (0..256).rev().find(in_use) else {
            return SharedSlacks::default();
        };
        let suited = |exponent: &usize| -> u64 {
            let first = (exponent + 1).saturating_sub(MOST_EXCESS);
            let counts = self.counts[first..=*exponent].iter();
            counts.map(|&count| u64::from(count)).sum()
        };
        let smaller = 0..(largest + 1).saturating_sub(MOST_EXCESS);
        let small = smaller.filter(in_use).max_by_key(suited);
        SharedSlacks {
            small: self.largest[small.unwrap_or(largest)],
            large: self.largest[largest],
        }
    }

    /// How many of the planes counted neither of these suits.
    pub(crate) fn unsuited(&self, shared: SharedSlacks) -> usize {
        let used = self.counts.iter().zip(self.largest);
        let unsuited = used.filter(|&(_, slack)| shared.class_of(slack).is_none());
        unsuited.map(|(&count, _)| count as usize).sum()
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
        let is_unsuited = |slack: &&f32| shared.class_of(**slack).is_none();
        let unsuited = slacks.iter().filter(is_unsuited).count();
        assert_eq!(counts.unsuited(shared), unsuited);
        [shared.small, shared.large]
    }

    #[test]
    fn few_large_slacks_are_kept_from_many_small_ones() {
        assert_eq!(shared(&[]), [0.0; 2]);
        assert_eq!(shared(&[0.25]), [0.25; 2]);
        assert_eq!(shared(&[1.0, 1.5, 1.25, 0.25]), [1.5; 2]);
        assert_eq!(shared(&[0.001, 0.0011, 0.0012, 8.0]), [0.0012, 8.0]);
        assert_eq!(shared(&[0.001, 0.0011, 0.2, 8.0]), [0.0011, 8.0]);
        assert_eq!(shared(&[f32::MIN_POSITIVE, f32::MAX])[1], f32::MAX);
    }

    #[test]
    fn a_slack_suits_planes_of_a_little_less() {
        let shared = SharedSlacks {
            small: 0.5,
            large: 64.0,
        };
        let [small, large] = [Some(SlackClass::Small), Some(SlackClass::Large)];
        for (slack, class) in [(0.0625, small), (0.5, small), (8.0, large), (64.0, large)] {
            assert_eq!(shared.class_of(slack), class, "{slack}");
        }
        for slack in [0.06, 0.51, 7.9, 65.0] {
            assert_eq!(shared.class_of(slack), None, "{slack}");
        }
    }
}
