//! The part of a primitive inside a cell, and how far a hit may lie off it.
//!
//! Why no hit is lost. Let `p` be the point of an accepted hit on the ray and `q`
//! the point of the primitive that it stands for. Along each axis `p` is off `q`
//! by a share of how far the ray has come, which the traversal's relative pad
//! covers, and by at most the primitive's *displacement*, about what the kernel
//! rounds vertices by. At a plane, `q` lies below or above:
//!
//! - Displacements up to the tree's *slack* are the traversal's: it visits each
//!   side a slack beyond the plane. Then it reaches the side of `q`, and a
//!   primitive needs to be referenced only where it really is: parts that end at a
//!   plane are below it alone, flat ones in the plane on either side.
//! - Larger displacements are the builder's: such a primitive is clipped to the
//!   cell enlarged by its displacement and padded by as much, so that the side
//!   where `p` lies references it as well.
//!
//! Either way each plane is judged against `q` itself, and nothing adds up from
//! level to level. The slack is one number for the whole tree, since nodes have
//! no room for their own. It follows the small primitives ([`Slack`]), so that a
//! few large ones do not make it large.

use accel_core::glam::Vec3;
use accel_core::{Aabb, Clip, Primitive};

/// A primitive, or the part of it inside a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Part {
    /// The smallest box around it, not padded unless its displacement is the
    /// builder's to care for.
    pub bounds: Aabb,
    /// The primitive's position in the builder's input.
    pub id: u32,
}

/// How far a hit may lie off a primitive of this extent, whatever the ray.
fn displacement(extent: f64) -> f64 {
    const RELATIVE: f64 = 1.0 / (1 << 20) as f64;
    RELATIVE * extent + f64::from(f32::MIN_POSITIVE)
}

/// How far beyond a plane the traversal visits each side, in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slack(pub f64);

impl Slack {
    /// Primitives up to so many times as large as small ones set the slack: it
    /// stays below a thousandth of the small ones' extent.
    const LARGEST_RATIO: f64 = 1024.0;

    /// The largest displacement of primitives with these bounds, leaving out
    /// those far larger than most others: the seven eighths beyond the smallest.
    pub(crate) fn of(bounds: impl Iterator<Item = Aabb>) -> Self {
        let mut extents: Vec<f64> = bounds
            .map(|bounds| bounds.largest_extent())
            .filter(|&extent| extent > 0.0)
            .collect();
        if extents.is_empty() {
            return Self(displacement(0.0));
        }
        let eighth = extents.len() / 8;
        let (_, &mut small, _) = extents.select_nth_unstable_by(eighth, f64::total_cmp);
        let usual = |extent: &f64| *extent <= small * Self::LARGEST_RATIO;
        let largest = extents.into_iter().filter(usual).fold(0.0, f64::max);
        Self(displacement(largest))
    }
}

/// Finds the parts of primitives inside cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clipper<'a, P> {
    pub primitives: &'a [P],
    pub slack: Slack,
    /// Whether parts are clipped (perfect splits) or boxes alone.
    pub clips_primitives: bool,
}

impl<P: Clip> Clipper<'_, P> {
    /// The whole primitive.
    pub(crate) fn whole(&self, id: u32, cell: &Aabb) -> Part {
        let bounds = self.primitives[id as usize].bounds();
        let bounds = match self.own_displacement(&bounds) {
            Some(pad) => clamped(&bounds.padded(pad), cell),
            None => bounds,
        };
        Part { bounds, id }
    }

    /// What is left of `part` in both halves of a cell; `None` in one that it
    /// does not reach, but never in both.
    pub(crate) fn halves(&self, part: &Part, cells: &[Aabb; 2]) -> [Option<Part>; 2] {
        let halves = cells.map(|cell| self.clipped(part, &cell));
        if halves == [None, None] {
            // Rounding hides a part that the cell around both had.
            return cells.map(|cell| Some(part.within(&cell)));
        }
        halves
    }

    fn clipped(&self, part: &Part, cell: &Aabb) -> Option<Part> {
        if !self.clips_primitives {
            return Some(part.within(cell));
        }
        let primitive = &self.primitives[part.id as usize];
        let tight = match self.own_displacement(&primitive.bounds()) {
            Some(pad) => primitive.clip(&cell.padded(pad))?.padded(pad),
            None => primitive.clip(cell)?.rounded_outward(),
        };
        Some(Part {
            bounds: clamped(&tight, cell),
            id: part.id,
        })
    }

    /// The displacement of a primitive with these bounds, if the traversal's
    /// slack does not cover it.
    fn own_displacement(&self, bounds: &Aabb) -> Option<f64> {
        let displacement = displacement(bounds.largest_extent());
        (displacement > self.slack.0).then_some(displacement)
    }
}

impl Part {
    fn within(&self, cell: &Aabb) -> Self {
        Self {
            bounds: clamped(&self.bounds, cell),
            id: self.id,
        }
    }
}

/// Both corners of `bounds` moved into `cell`: never empty, whatever rounding
/// did.
fn clamped(bounds: &Aabb, cell: &Aabb) -> Aabb {
    let into_cell = |corner: Vec3| corner.clamp(cell.min, cell.max);
    Aabb {
        min: into_cell(bounds.min),
        max: into_cell(bounds.max),
    }
}

/// How far a hit on `primitive` may lie off it.
pub(crate) fn displacement_of<P: Primitive>(primitive: &P) -> f64 {
    displacement(primitive.bounds().largest_extent())
}

#[cfg(test)]
mod tests {
    use super::*;
    use accel_core::Triangle;

    fn cube(extent: f32) -> Aabb {
        Aabb::new([0.0; 3], [extent; 3])
    }

    #[test]
    fn the_slack_follows_small_primitives_not_a_few_large_ones() {
        let usual = [1.0, 2.0, 500.0].map(cube);
        assert_eq!(Slack::of(usual.into_iter()).0, displacement(500.0));
        let stadium = [1.0, 2.0, 1e6].map(cube);
        assert_eq!(Slack::of(stadium.into_iter()).0, displacement(2.0));
        assert_eq!(Slack::of([cube(0.0)].into_iter()).0, displacement(0.0));
    }

    #[test]
    fn parts_are_tight_unless_their_displacement_exceeds_the_slack() {
        let triangles = [Triangle::new([0.0; 3], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0])];
        let cells = [
            Aabb::new([0.0; 3], [2.0, 8.0, 1.0]),
            Aabb::new([2.0, 0.0, 0.0], [8.0, 8.0, 1.0]),
        ];
        let clipper = |slack| Clipper {
            primitives: &triangles,
            slack: Slack(slack),
            clips_primitives: true,
        };
        let part = clipper(1.0).whole(0, &cube(8.0));
        let [below, above] = clipper(1.0).halves(&part, &cells).map(Option::unwrap);
        assert_eq!(below.bounds, Aabb::new([0.0; 3], [2.0, 8.0, 0.0]));
        assert_eq!(above.bounds, Aabb::new([2.0, 0.0, 0.0], [8.0, 6.0, 0.0]));
        let [_, above] = clipper(0.0).halves(&part, &cells).map(Option::unwrap);
        let above = above.bounds;
        assert!(above.max.y > 6.0 && above.max.y < 6.001 && above.max.z > 0.0);
    }

    #[test]
    fn a_part_that_a_half_does_not_hold_is_dropped_there() {
        let triangles = [Triangle::new([0.0; 3], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0])];
        let clipper = Clipper {
            primitives: &triangles,
            slack: Slack(1.0),
            clips_primitives: true,
        };
        let part = clipper.whole(0, &cube(8.0));
        let beyond_the_diagonal = Aabb::new([7.0, 7.0, 0.0], [8.0, 8.0, 1.0]);
        let around = Aabb::new([0.0; 3], [7.0, 8.0, 1.0]);
        let [kept, dropped] = clipper.halves(&part, &[around, beyond_the_diagonal]);
        assert!(kept.is_some() && dropped.is_none());
        let both = clipper.halves(&part, &[beyond_the_diagonal; 2]);
        assert!(both.iter().all(Option::is_some));
    }
}
