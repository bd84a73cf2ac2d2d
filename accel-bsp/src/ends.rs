//! Counting pieces on both sides of axis-aligned planes by sorting their ends.

use accel_core::geometry::Axis;
use accel_core::glam::DVec3;

use crate::pieces::{Counts, Pieces};

/// Where the pieces begin and end along an axis, sorted: the counts on both
/// sides of a position follow by looking it up.
pub(crate) struct Ends {
    /// The largest positions that have the piece in front.
    starts: Vec<f64>,
    /// The smallest positions that have the piece behind.
    ends: Vec<f64>,
    /// The same of the pieces that are thinner than the slack: from their end to their
    /// start they are planar.
    flat_starts: Vec<f64>,
    flat_ends: Vec<f64>,
    /// Where the pieces begin and end themselves.
    positions: Vec<f32>,
}

impl Ends {
    pub(crate) fn new(pieces: &Pieces, axis: Axis, slack: f64) -> Self {
        let count = pieces.len();
        let mut ends = Self {
            starts: Vec::with_capacity(count),
            ends: Vec::with_capacity(count),
            flat_starts: Vec::new(),
            flat_ends: Vec::new(),
            positions: Vec::with_capacity(2 * count),
        };
        for piece in 0..count {
            let along = |corner: &DVec3| corner[axis.index()];
            let corners = pieces.corners(piece).iter().map(along);
            let unbounded = (f64::INFINITY, f64::NEG_INFINITY);
            let (low, high) = corners.fold(unbounded, |(low, high), x| (low.min(x), high.max(x)));
            let reach = slack - pieces.pad(piece);
            let (start, end) = (low + reach, high - reach);
            ends.starts.push(start);
            ends.ends.push(end);
            if start < end {
                ends.positions.extend([low as f32, high as f32]);
            } else {
                ends.flat_starts.push(start);
                ends.flat_ends.push(end);
                ends.positions.push((0.5 * (low + high)) as f32);
            }
        }
        let lists = [
            &mut ends.starts,
            &mut ends.ends,
            &mut ends.flat_starts,
            &mut ends.flat_ends,
        ];
        for list in lists {
            list.sort_unstable_by(f64::total_cmp);
        }
        ends.positions.sort_unstable_by(f32::total_cmp);
        ends.positions.dedup();
        ends
    }

    pub(crate) fn positions(&self) -> impl Iterator<Item = f32> {
        self.positions.iter().copied()
    }

    pub(crate) fn count(&self, position: f64) -> Counts {
        let below = |list: &[f64]| list.partition_point(|&end| end < position);
        let up_to = |list: &[f64]| list.partition_point(|&end| end <= position);
        let may_be_in_front = self.starts.len() - below(&self.starts);
        let may_be_behind = up_to(&self.ends);
        let planar = up_to(&self.flat_ends) - below(&self.flat_starts);
        Counts {
            behind: may_be_behind - planar,
            in_front: may_be_in_front - planar,
            planar,
            straddling: self.starts.len() + planar - may_be_in_front - may_be_behind,
        }
    }
}
