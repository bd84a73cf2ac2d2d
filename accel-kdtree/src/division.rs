//! Carrying a split out: which parts go where, straddling ones clipped to both
//! cells (*perfect splits*, Wald and Havran 2006, section 4.3; Havran 2000).

use accel_core::build::map_each;
use accel_core::{Aabb, Clip};

use crate::part::{Clipper, Part};
use crate::plane::{Plane, Side};

/// Where a part of a node went, with its number there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Destination {
    Below(u32),
    Above(u32),
    Straddling,
}

/// The parts of one child.
#[derive(Clone, Debug, Default)]
pub(crate) struct SideParts {
    pub parts: Vec<Part>,
    /// The numbers of those that straddled the plane and have been clipped.
    pub clipped: Vec<u32>,
}

/// The parts of both children, in the order of the parts of the node.
#[derive(Clone, Debug, Default)]
pub(crate) struct DividedParts {
    /// Below and above.
    pub sides: [SideParts; 2],
    pub destinations: Vec<Destination>,
}

impl DividedParts {
    /// Bytes for each part while a node is divided: the part and its children's,
    /// and its destination.
    pub(crate) const BYTES_PER_PART: usize =
        2 * size_of::<Part>() + size_of::<Destination>() + size_of::<u32>();

    /// Divides `parts` by `plane` into `cells`, below and above it.
    pub(crate) fn new<P: Clip>(
        clipper: &Clipper<'_, P>,
        parts: &[Part],
        plane: &Plane,
        cells: &[Aabb; 2],
    ) -> Self {
        let mut divided = Self::default();
        divided.destinations.reserve_exact(parts.len());
        for part in parts {
            let destination = divided.place(clipper, part, plane, cells);
            divided.destinations.push(destination);
        }
        divided
    }

    fn place<P: Clip>(
        &mut self,
        clipper: &Clipper<'_, P>,
        part: &Part,
        plane: &Plane,
        cells: &[Aabb; 2],
    ) -> Destination {
        match plane.side(&part.bounds) {
            Side::Below => Destination::Below(self.sides[0].push(*part)),
            Side::Above => Destination::Above(self.sides[1].push(*part)),
            Side::Straddling => {
                let halves = clipper.halves(part, cells);
                for (side, half) in self.sides.iter_mut().zip(halves) {
                    if let Some(half) = half {
                        let number = side.push(half);
                        side.clipped.push(number);
                    }
                }
                Destination::Straddling
            }
        }
    }
}

impl SideParts {
    fn push(&mut self, part: Part) -> u32 {
        self.parts.push(part);
        self.parts.len() as u32 - 1
    }
}

/// Larger nodes are divided in parallel, so many parts at a time.
const CHUNK: usize = 1 << 14;

/// As [`DividedParts::new`], the parts alone, in parallel for large nodes.
pub(crate) fn divide_parts<P: Clip>(
    clipper: &Clipper<'_, P>,
    parts: &[Part],
    plane: &Plane,
    cells: &[Aabb; 2],
) -> [Vec<Part>; 2] {
    let divide = |chunk: &[Part]| {
        let divided = DividedParts::new(clipper, chunk, plane, cells);
        divided.sides.map(|side| side.parts)
    };
    if parts.len() <= CHUNK {
        return divide(parts);
    }
    let mut sides = [Vec::new(), Vec::new()];
    for chunk in map_each(parts.chunks(CHUNK).collect(), divide) {
        for (side, of_chunk) in sides.iter_mut().zip(chunk) {
            side.extend_from_slice(&of_chunk);
        }
    }
    sides
}
