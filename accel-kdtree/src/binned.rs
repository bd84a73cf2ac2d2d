//! The quick search for large nodes: planes at equal distances, counted by
//! *min-max binning*. Each part is counted in the bin where it begins and in the
//! bin where it ends; sums over bins then tell exactly how many parts lie below
//! and above each plane (Popov et al. 2006; Shevtsov et al. 2007).

use accel_core::Aabb;
use accel_core::build::map_each;
use accel_core::geometry::Axis;

use crate::part::Part;
use crate::plane::Cheapest;
use crate::work::Work;

/// The most bins along an axis.
pub(crate) const MAX_BINS: usize = 256;

/// Larger nodes are counted in parallel, so many parts at a time.
const CHUNK: usize = 1 << 14;

/// Planes at equal distances along an axis of a cell.
struct Planes {
    axis: Axis,
    low: f64,
    bins_per_unit: f64,
    /// One fewer than there are bins.
    positions: Vec<f32>,
}

impl Planes {
    /// `None` where the cell is too flat.
    fn new(cell: &Aabb, axis: Axis, bins: usize) -> Option<Self> {
        let low = f64::from(axis.of(cell.min));
        let width = f64::from(axis.of(cell.max)) - low;
        let bins_per_unit = bins as f64 / width;
        let is_usable = width > 0.0 && bins_per_unit.is_finite();
        is_usable.then(|| Self {
            axis,
            low,
            bins_per_unit,
            positions: (1..bins)
                .map(|plane| (low + width * (plane as f64 / bins as f64)) as f32)
                .collect(),
        })
    }

    /// How many planes lie at or before `position`: a guess by arithmetic, put
    /// right by comparing, so that counting and dividing never disagree.
    #[inline]
    fn at_or_before(&self, position: f32) -> usize {
        let guess = ((f64::from(position) - self.low) * self.bins_per_unit) as usize;
        let mut planes = guess.min(self.positions.len());
        while planes > 0 && self.positions[planes - 1] > position {
            planes -= 1;
        }
        while planes < self.positions.len() && self.positions[planes] <= position {
            planes += 1;
        }
        planes
    }

    /// How many planes lie before `position`.
    #[inline]
    fn before(&self, position: f32) -> usize {
        let mut planes = self.at_or_before(position);
        while planes > 0 && self.positions[planes - 1] == position {
            planes -= 1;
        }
        planes
    }
}

/// Along one axis, how many parts begin and end in each bin, and the range of
/// all together.
#[derive(Clone)]
struct Bins {
    begins: Vec<u32>,
    ends: Vec<u32>,
    range: [f32; 2],
}

impl Bins {
    fn empty(bins: usize) -> Self {
        Self {
            begins: vec![0; bins],
            ends: vec![0; bins],
            range: [f32::INFINITY, f32::NEG_INFINITY],
        }
    }

    fn of(parts: &[Part], planes: &Planes) -> Self {
        let mut bins = Self::empty(planes.positions.len() + 1);
        for part in parts {
            let bounds = &part.bounds;
            let (low, high) = (planes.axis.of(bounds.min), planes.axis.of(bounds.max));
            bins.begins[planes.at_or_before(low)] += 1;
            // A flat part in a plane counts as above it, where it will go.
            let last = if low == high {
                planes.at_or_before(high)
            } else {
                planes.before(high)
            };
            bins.ends[last] += 1;
            bins.range = [bins.range[0].min(low), bins.range[1].max(high)];
        }
        bins
    }

    fn add(&mut self, other: &Self) {
        for (sum, more) in self.begins.iter_mut().zip(&other.begins) {
            *sum += more;
        }
        for (sum, more) in self.ends.iter_mut().zip(&other.ends) {
            *sum += more;
        }
        self.range = [
            self.range[0].min(other.range[0]),
            self.range[1].max(other.range[1]),
        ];
    }
}

/// Weighs the planes between `bins` bins along each axis of `cell`, and the
/// planes at the ends of what the parts take up, which cut off empty space.
pub(crate) fn weigh_some(
    parts: &[Part],
    cell: &Aabb,
    bins: usize,
    cheapest: &mut Cheapest,
    work: &mut Work,
) {
    let planes = Axis::ALL.map(|axis| Planes::new(cell, axis, bins));
    let count = |chunk: &[Part]| {
        planes
            .each_ref()
            .map(|planes| planes.as_ref().map(|planes| Bins::of(chunk, planes)))
    };
    let chunks: Vec<&[Part]> = parts.chunks(CHUNK).collect();
    let mut sums = planes
        .each_ref()
        .map(|planes| planes.as_ref().map(|_| Bins::empty(bins)));
    for chunk in map_each(chunks, count) {
        for (sum, more) in sums.iter_mut().zip(&chunk) {
            if let (Some(sum), Some(more)) = (sum, more) {
                sum.add(more);
            }
        }
    }
    for (planes, bins) in planes.iter().zip(&sums) {
        if let (Some(planes), Some(bins)) = (planes, bins) {
            weigh_along(planes, bins, parts.len(), cheapest);
        }
    }
    work.comparisons += 6 * parts.len() as u64;
}

fn weigh_along(planes: &Planes, bins: &Bins, count: usize, cheapest: &mut Cheapest) {
    let areas = cheapest.areas(planes.axis);
    let (mut below, mut above) = (0, count);
    for (bin, &position) in planes.positions.iter().enumerate() {
        below += bins.begins[bin] as usize;
        above -= bins.ends[bin] as usize;
        cheapest.weigh_placed(&areas, position, false, [below, above]);
    }
    let [low, high] = bins.range;
    cheapest.weigh_placed(&areas, low, false, [0, count]);
    cheapest.weigh_placed(&areas, high, true, [count, 0]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::{Plane, Side};

    #[test]
    fn counts_are_those_of_dividing_by_each_plane() {
        let cell = Aabb::new([0.0; 3], [10.0, 1.0, 1.0]);
        let planes = Planes::new(&cell, Axis::X, 5).unwrap();
        assert_eq!(planes.positions, [2.0, 4.0, 6.0, 8.0]);
        let ranges = [
            (0.0, 2.0),
            (2.0, 2.0),
            (2.0, 4.0),
            (1.9, 8.1),
            (8.0, 10.0),
            (10.0, 10.0),
            (0.0, 0.0),
            (4.0, 4.5),
        ];
        let parts = ranges.map(|(low, high)| Part {
            bounds: Aabb::new([low, 0.0, 0.0], [high, 1.0, 1.0]),
            id: 0,
        });
        let bins = Bins::of(&parts, &planes);
        assert_eq!(bins.range, [0.0, 10.0]);
        let (mut below, mut above) = (0, parts.len());
        for (bin, &position) in planes.positions.iter().enumerate() {
            below += bins.begins[bin] as usize;
            above -= bins.ends[bin] as usize;
            let plane = Plane {
                axis: Axis::X,
                position,
                planar_below: false,
            };
            let sides = parts.map(|part| plane.side(&part.bounds));
            let not_on = |side| sides.iter().filter(|&&other| other != side).count();
            assert_eq!((below, above), (not_on(Side::Above), not_on(Side::Below)));
        }
    }

    #[test]
    fn flat_cells_have_no_planes() {
        let flat = Aabb::new([1.0; 3], [1.0, 2.0, 2.0]);
        assert!(Planes::new(&flat, Axis::X, 8).is_none());
        let thin = Aabb::new([0.0; 3], [f32::from_bits(1), 1.0, 1.0]);
        let planes = Planes::new(&thin, Axis::X, 8);
        assert!(planes.is_none_or(|planes| planes.at_or_before(0.0) <= 7));
    }
}
