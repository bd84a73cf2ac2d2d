//! Splitting a polygon in space into triangles.
//!
//! A convex polygon becomes the fan of its first corner. A concave one is
//! split by ear clipping (Meisters 1975), with exact orientation tests
//! (Shewchuk 1997): a corner is an *ear* if it turns left and no other corner
//! lies in the triangle of it and its neighbours; ears are cut off until a
//! triangle remains.
//!
//! Why not the earcut crate: it first removes corners that lie on a straight
//! edge. A neighbouring face that keeps such a corner then no longer shares
//! the edge, and rays leak through the seam. Here n corners always give n - 2
//! triangles over all of them.

use std::collections::VecDeque;

use glam::{DVec2, DVec3, Vec3};

/// Splits polygons; keeps its memory from one to the next.
#[derive(Default)]
pub(super) struct Triangulator {
    outline: Vec<DVec2>,
    ring: Ring,
    obstacles: Vec<usize>,
    candidates: VecDeque<usize>,
}

impl Triangulator {
    /// Appends `corners.len() - 2` triangles in the orientation of the polygon,
    /// whose corners (at least three) are indices into `positions`. False if
    /// it is found to cross itself, has no area or is not finite: what cannot
    /// be split properly is cut as a fan.
    pub fn split(
        &mut self,
        corners: &[u32],
        positions: &[Vec3],
        triangles: &mut Vec<[u32; 3]>,
    ) -> bool {
        let mut emit = |triangle: [usize; 3]| triangles.push(triangle.map(|at| corners[at]));
        if corners.len() == 3 {
            emit([0, 1, 2]);
            return true;
        }
        let flat = project(corners, positions, &mut self.outline);
        if !flat || is_convex(&self.outline) {
            (2..corners.len()).for_each(|third| emit([0, third - 1, third]));
            return flat;
        }
        self.clip_ears(&mut emit)
    }

    /// Each cut can only turn the two neighbours into ears, so that these are
    /// all that is looked at again: time is corners times obstacles.
    fn clip_ears(&mut self, emit: &mut impl FnMut([usize; 3])) -> bool {
        let count = self.outline.len();
        self.ring.reset(count);
        self.obstacles.clear();
        self.candidates.clear();
        let mut notched = false;
        for corner in 0..count {
            self.candidates.push_back(corner);
            let turn = self.turn(corner);
            if turn <= 0.0 {
                self.obstacles.push(corner);
            }
            notched |= turn < 0.0;
        }
        if !notched {
            // Only left turns and yet not convex: it winds round twice.
            return self.cut_the_rest(count, emit);
        }
        let mut left = count;
        while left > 3 {
            let Some(tip) = self.candidates.pop_front() else {
                return self.cut_the_rest(left, emit);
            };
            if !self.ring.contains(tip) || !self.is_ear(tip) {
                continue;
            }
            let (before, after) = self.ring.neighbours(tip);
            emit([before, tip, after]);
            self.ring.remove(tip);
            self.candidates.extend([before, after]);
            left -= 1;
        }
        self.cut_the_rest(left, emit)
    }

    /// The fan of what remains: one triangle, or a polygon without an ear. True
    /// if it is a triangle of the right orientation; else the outline crosses
    /// itself.
    fn cut_the_rest(&self, left: usize, emit: &mut impl FnMut([usize; 3])) -> bool {
        let first = self.ring.first();
        let mut second = self.ring.neighbours(first).1;
        for _ in 2..left {
            let third = self.ring.neighbours(second).1;
            emit([first, second, third]);
            second = third;
        }
        left == 3 && self.turn(first) >= 0.0
    }

    /// Positive where the outline turns left, zero where it runs straight.
    fn turn(&self, corner: usize) -> f64 {
        let (before, after) = self.ring.neighbours(corner);
        let point = |at: usize| self.outline[at];
        orientation(point(before), point(corner), point(after))
    }

    fn is_ear(&self, tip: usize) -> bool {
        if self.turn(tip) <= 0.0 {
            return false;
        }
        let (before, after) = self.ring.neighbours(tip);
        let triangle = [before, tip, after].map(|at| self.outline[at]);
        let [a, b, c] = triangle;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        // Equal points are the two sides of a slit, by which writers connect a
        // hole to its outline. They lie on the border and block nothing.
        !self.obstacles.iter().any(|&corner| {
            let point = self.outline[corner];
            point.cmpge(low).all()
                && point.cmple(high).all()
                && self.ring.contains(corner)
                && !triangle.contains(&point)
                && orientation(a, b, point) >= 0.0
                && orientation(b, c, point) >= 0.0
                && orientation(c, a, point) >= 0.0
        })
    }
}

/// Projects a polygon along the largest component of its normal, such that it
/// runs counter-clockwise. False if it has no normal.
fn project(corners: &[u32], positions: &[Vec3], outline: &mut Vec<DVec2>) -> bool {
    let point = |corner: u32| positions[corner as usize].as_dvec3();
    let origin = point(corners[0]);
    let mut normal = DVec3::ZERO;
    for pair in corners.windows(2) {
        normal += (point(pair[0]) - origin).cross(point(pair[1]) - origin);
    }
    if !normal.is_finite() || normal == DVec3::ZERO {
        return false;
    }
    let axis = normal.abs().max_position();
    let (mut horizontal, mut vertical) = ((axis + 1) % 3, (axis + 2) % 3);
    if normal[axis] < 0.0 {
        std::mem::swap(&mut horizontal, &mut vertical);
    }
    outline.clear();
    outline.extend(corners.iter().map(|&corner| {
        let point = point(corner);
        DVec2::new(point[horizontal], point[vertical])
    }));
    true
}

/// Whether an outline turns left at every corner that is not straight, and
/// goes round only once: it then changes its horizontal direction twice.
fn is_convex(outline: &[DVec2]) -> bool {
    let count = outline.len();
    let mut reversals = 0;
    let mut heading = 0.0;
    for at in 0..=count {
        let [before, here, after] = [0, 1, 2].map(|step| outline[(at + step) % count]);
        if orientation(before, here, after) < 0.0 {
            return false;
        }
        let step = here.x - before.x;
        if step * heading < 0.0 {
            reversals += 1;
        }
        if step != 0.0 {
            heading = step.signum();
        }
    }
    reversals <= 2
}

/// Twice the signed area of a triangle; its sign is exact.
fn orientation(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let coord = |point: DVec2| robust::Coord {
        x: point.x,
        y: point.y,
    };
    robust::orient2d(coord(a), coord(b), coord(c))
}

/// The corners that are left, as a doubly linked circle.
#[derive(Default)]
struct Ring {
    previous: Vec<usize>,
    next: Vec<usize>,
    present: Vec<bool>,
}

impl Ring {
    fn reset(&mut self, count: usize) {
        self.previous.clear();
        self.previous
            .extend((0..count).map(|at| (at + count - 1) % count));
        self.next.clear();
        self.next.extend((0..count).map(|at| (at + 1) % count));
        self.present.clear();
        self.present.resize(count, true);
    }

    fn first(&self) -> usize {
        self.present
            .iter()
            .position(|&present| present)
            .unwrap_or(0)
    }

    fn contains(&self, at: usize) -> bool {
        self.present[at]
    }

    fn neighbours(&self, at: usize) -> (usize, usize) {
        (self.previous[at], self.next[at])
    }

    fn remove(&mut self, at: usize) {
        let (before, after) = self.neighbours(at);
        self.next[before] = after;
        self.previous[after] = before;
        self.present[at] = false;
    }
}
