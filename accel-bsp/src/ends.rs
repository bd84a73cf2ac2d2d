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
    /// Middles of pieces thinner than the slack.
    flats: Vec<f64>,
    /// Where the pieces begin and end themselves.
    positions: Vec<f32>,
}

impl Ends {
    pub(crate) fn new(pieces: &Pieces, axis: Axis, slack: f64) -> Self {
        let count = pieces.len();
        let mut ends = Self {
            starts: Vec::with_capacity(count),
            ends: Vec::with_capacity(count),
            flats: Vec::new(),
            positions: Vec::with_capacity(2 * count),
        };
        for piece in 0..count {
            let along = |corner: &DVec3| corner[axis.index()];
            let corners = pieces.corners(piece).iter().map(along);
            let unbounded = (f64::INFINITY, f64::NEG_INFINITY);
            let (low, high) = corners.fold(unbounded, |(low, high), x| (low.min(x), high.max(x)));
            let reach = slack - pieces.pad(piece);
            let (start, end) = (low + reach, high - reach);
            if start < end {
                ends.starts.push(start);
                ends.ends.push(end);
                ends.positions.extend([low as f32, high as f32]);
            } else {
                let middle = (0.5 * (low + high)) as f32;
                ends.starts.push(f64::from(middle));
                ends.ends.push(f64::from(middle));
                ends.flats.push(f64::from(middle));
                ends.positions.push(middle);
            }
        }
        for list in [&mut ends.starts, &mut ends.ends, &mut ends.flats] {
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
        let total = self.starts.len();
        let not_in_front = self.starts.partition_point(|&start| start < position);
        let not_behind = total - self.ends.partition_point(|&end| end <= position);
        let planar = self.flats.partition_point(|&flat| flat <= position)
            - self.flats.partition_point(|&flat| flat < position);
        let straddling = not_in_front + not_behind + planar - total;
        Counts {
            behind: not_in_front - straddling,
            in_front: not_behind - straddling,
            planar,
            straddling,
        }
    }
}
