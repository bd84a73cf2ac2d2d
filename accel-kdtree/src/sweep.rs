//! The exact search: every plane that some part touches, by one sweep over the
//! sorted events of each axis (Wald and Havran 2006, section 4.2).
//!
//! ```text
//! below := 0, above := n
//! for each position, in order:
//!     above -= parts that end here and flat ones here
//!     weigh the plane with (below, flat ones, above)
//!     below += parts that begin here and flat ones here
//! ```
//!
//! A node is divided without sorting again: events of parts on one side are
//! copied in order, those of straddling parts are made anew from the clipped
//! parts, sorted by themselves and merged (section 4.3). So sorting happens once,
//! at the root, and the whole build takes O(n log n) time where few parts
//! straddle.

use accel_core::geometry::Axis;

use crate::division::{Destination, DividedParts};
use crate::event::{Event, Events, push_events, sort};
use crate::part::Part;
use crate::plane::{Cheapest, Counts};
use crate::work::Work;

/// Weighs every plane of `events`, which are those of `count` parts.
pub(crate) fn weigh_all(events: &Events, count: usize, cheapest: &mut Cheapest, work: &mut Work) {
    for axis in Axis::ALL {
        let areas = cheapest.areas(axis);
        let (mut below, mut above) = (0, count);
        let along = events.along(axis);
        let mut next = 0;
        while let Some(first) = along.get(next) {
            // Ends, flat ones, starts.
            let mut here = [0; 3];
            while let Some(event) = along.get(next)
                && event.position_key() == first.position_key()
            {
                here[event.kind() as usize] += 1;
                next += 1;
            }
            let [ends, planar, starts] = here;
            above -= ends + planar;
            let counts = Counts {
                below,
                planar,
                above,
            };
            cheapest.weigh(&areas, first.position(), counts);
            below += starts + planar;
        }
    }
    work.comparisons += events.len() as u64;
}

/// The events of both children of a node.
pub(crate) fn divide_events(
    events: &Events,
    divided: &DividedParts,
    work: &mut Work,
) -> [Events; 2] {
    let [below, above] = &divided.sides;
    let mut merges = [
        Merge::new(&below.parts, &below.clipped),
        Merge::new(&above.parts, &above.clipped),
    ];
    for axis in Axis::ALL {
        for merge in &mut merges {
            merge.begin(axis, work);
        }
        for &event in events.along(axis) {
            match divided.destinations[event.part() as usize] {
                Destination::Below(number) => merges[0].push(event.renumbered(number)),
                Destination::Above(number) => merges[1].push(event.renumbered(number)),
                Destination::Straddling => {}
            }
        }
        for merge in &mut merges {
            merge.finish(axis);
        }
    }
    work.comparisons += events.len() as u64;
    merges.map(|merge| {
        work.comparisons += merge.merged.len() as u64;
        merge.merged
    })
}

/// Merges copied events with those of newly clipped parts.
struct Merge<'a> {
    parts: &'a [Part],
    /// The numbers of newly clipped parts.
    clipped: &'a [u32],
    /// Their events along the current axis, sorted; from `next` on not merged.
    fresh: Vec<Event>,
    next: usize,
    merged: Events,
}

impl<'a> Merge<'a> {
    fn new(parts: &'a [Part], clipped: &'a [u32]) -> Self {
        Self {
            parts,
            clipped,
            fresh: Vec::with_capacity(2 * clipped.len()),
            next: 0,
            merged: Events::with_capacity(6 * parts.len()),
        }
    }

    fn begin(&mut self, axis: Axis, work: &mut Work) {
        self.fresh.clear();
        self.next = 0;
        for &number in self.clipped {
            let bounds = &self.parts[number as usize].bounds;
            push_events(bounds, number, axis, &mut self.fresh);
        }
        work.comparisons += sort(&mut self.fresh);
    }

    #[inline]
    fn push(&mut self, event: Event) {
        while let Some(&fresh) = self.fresh.get(self.next)
            && fresh < event
        {
            self.merged.push(fresh);
            self.next += 1;
        }
        self.merged.push(event);
    }

    fn finish(&mut self, axis: Axis) {
        for &fresh in &self.fresh[self.next..] {
            self.merged.push(fresh);
        }
        self.merged.finish(axis);
    }
}
