//! Events: where parts begin and end along an axis (Wald and Havran 2006,
//! section 4.2).

use accel_core::Aabb;
use accel_core::build::join;
use accel_core::geometry::Axis;

use crate::part::Part;
use crate::work::Work;

/// The most parts that a node can hold: events number them in 30 bits.
pub(crate) const MAX_PARTS: usize = 1 << 30;

const KIND_SHIFT: u32 = 30;
const POSITION_SHIFT: u32 = 32;

/// What happens at an event. At one position parts end first, then lie flat
/// ones, then begin others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EventKind {
    End,
    Planar,
    Start,
}

/// An event of one part along one axis, in one word that compares as events
/// do: by position, then by kind, then by part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Event(u64);

impl Event {
    fn new(position: f32, kind: EventKind, part: u32) -> Self {
        // Positive zero for both zeros; then the order of bits is that of numbers.
        let bits = (position + 0.0).to_bits();
        let flip = if bits >> 31 == 1 { u32::MAX } else { 1 << 31 };
        let low = (kind as u32) << KIND_SHIFT | part;
        Self(u64::from(bits ^ flip) << POSITION_SHIFT | u64::from(low))
    }

    #[inline]
    pub(crate) fn position(self) -> f32 {
        let ordered = self.position_key();
        let flip = if ordered >> 31 == 1 {
            1 << 31
        } else {
            u32::MAX
        };
        f32::from_bits(ordered ^ flip)
    }

    /// Equal for events at one position.
    #[inline]
    pub(crate) fn position_key(self) -> u32 {
        (self.0 >> POSITION_SHIFT) as u32
    }

    #[inline]
    pub(crate) fn kind(self) -> EventKind {
        match (self.0 as u32) >> KIND_SHIFT {
            0 => EventKind::End,
            1 => EventKind::Planar,
            _ => EventKind::Start,
        }
    }

    /// The part's position in its node.
    #[inline]
    pub(crate) fn part(self) -> u32 {
        self.0 as u32 & ((1 << KIND_SHIFT) - 1)
    }

    /// The same event of a part with another number.
    #[inline]
    pub(crate) fn renumbered(self, part: u32) -> Self {
        const PART_MASK: u64 = (1 << KIND_SHIFT) - 1;
        Self(self.0 & !PART_MASK | u64::from(part))
    }
}

/// Adds the events of a part with these bounds along `axis`.
pub(crate) fn push_events(bounds: &Aabb, part: u32, axis: Axis, events: &mut Vec<Event>) {
    let (low, high) = (axis.of(bounds.min), axis.of(bounds.max));
    if low == high {
        events.push(Event::new(low, EventKind::Planar, part));
    } else {
        events.push(Event::new(low, EventKind::Start, part));
        events.push(Event::new(high, EventKind::End, part));
    }
}

/// The events of a node, in order along each axis.
#[derive(Clone, Debug, Default)]
pub(crate) struct Events {
    all: Vec<Event>,
    /// Where the events along the first axis end, and those along the second.
    ends: [usize; 2],
}

/// Nodes of more events than this sort their axes in parallel.
const PARALLEL_SORT: usize = 1 << 15;

impl Events {
    /// Bytes for each part while a node is divided: events of the node and of
    /// its children.
    pub(crate) const BYTES_PER_PART: usize = 2 * 6 * size_of::<Event>();

    /// The events of `parts`, sorted.
    pub(crate) fn of(parts: &[Part], work: &mut Work) -> Self {
        let mut events = Self::with_capacity(6 * parts.len());
        for axis in Axis::ALL {
            for (number, part) in (0..).zip(parts) {
                push_events(&part.bounds, number, axis, &mut events.all);
            }
            events.finish(axis);
        }
        let is_large = events.all.len() > PARALLEL_SORT;
        let [x, y, z] = events.axes_mut();
        if is_large {
            let (of_x, (of_y, of_z)) = join(|| sort(x), || join(|| sort(y), || sort(z)));
            work.comparisons += of_x + of_y + of_z;
        } else {
            work.comparisons += sort(x) + sort(y) + sort(z);
        }
        events
    }

    pub(crate) fn with_capacity(events: usize) -> Self {
        Self {
            all: Vec::with_capacity(events),
            ends: [0; 2],
        }
    }

    /// Adds an event along the axis not yet finished, in order.
    #[inline]
    pub(crate) fn push(&mut self, event: Event) {
        self.all.push(event);
    }

    /// What was added since the axis before belongs to this one.
    pub(crate) fn finish(&mut self, axis: Axis) {
        if let Some(end) = self.ends.get_mut(axis.index()) {
            *end = self.all.len();
        }
    }

    /// The events along `axis`.
    pub(crate) fn along(&self, axis: Axis) -> &[Event] {
        let [first, second] = self.ends;
        match axis {
            Axis::X => &self.all[..first],
            Axis::Y => &self.all[first..second],
            Axis::Z => &self.all[second..],
        }
    }

    fn axes_mut(&mut self) -> [&mut [Event]; 3] {
        let [first, second] = self.ends;
        let (x, rest) = self.all.split_at_mut(first);
        let (y, z) = rest.split_at_mut(second - first);
        [x, y, z]
    }

    pub(crate) fn len(&self) -> usize {
        self.all.len()
    }
}

/// Sorts, and tells how many comparisons that took.
pub(crate) fn sort(events: &mut [Event]) -> u64 {
    let mut comparisons = 0;
    events.sort_unstable_by(|a, b| {
        comparisons += 1;
        a.cmp(b)
    });
    comparisons
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_are_ordered_by_position_then_end_before_planar_before_start() {
        let mut events: Vec<Event> = [
            (1.0, EventKind::Start, 0),
            (1.0, EventKind::Planar, 7),
            (1.0, EventKind::End, 9),
            (-1.0, EventKind::Start, 9),
            (f32::MAX, EventKind::End, 1),
            (-f32::MAX, EventKind::Start, 1),
            (-0.0, EventKind::Start, 2),
            (0.0, EventKind::End, 3),
        ]
        .map(|(position, kind, part)| Event::new(position, kind, part))
        .to_vec();
        sort(&mut events);
        let order: Vec<u32> = events.iter().map(|event| event.part()).collect();
        assert_eq!(order, [1, 9, 3, 2, 9, 7, 0, 1]);
    }

    #[test]
    fn every_part_of_an_event_survives_coding() {
        let kinds = [EventKind::End, EventKind::Planar, EventKind::Start];
        for position in [-f32::MAX, -1e-40, 0.0, 0.1, 3e38] {
            for kind in kinds {
                for part in [0, MAX_PARTS as u32 - 1] {
                    let event = Event::new(position, kind, part);
                    assert_eq!((event.position(), event.kind()), (position, kind));
                    assert_eq!(event.part(), part);
                    assert_eq!(event.renumbered(5), Event::new(position, kind, 5));
                }
            }
        }
    }

    #[test]
    fn a_flat_part_is_planar_along_one_axis_and_has_an_extent_along_others() {
        let bounds = Aabb::new([0.0, 1.0, 2.0], [3.0, 1.0, 4.0]);
        let events = Events::of(&[Part { bounds, id: 5 }], &mut Work::default());
        assert_eq!(Axis::ALL.map(|axis| events.along(axis).len()), [2, 1, 2]);
        assert_eq!(events.along(Axis::Y)[0].kind(), EventKind::Planar);
        assert_eq!(events.along(Axis::Z)[1].position(), 4.0);
    }
}
