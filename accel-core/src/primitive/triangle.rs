//! The triangle.

use glam::Vec3;

/// A triangle with corners `a`, `b`, `c`. The point of a hit with barycentric
/// coordinates `u`, `v` is `(1 - u - v) a + u b + v c`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// First corner.
    pub a: Vec3,
    /// Second corner, where `u` is 1.
    pub b: Vec3,
    /// Third corner, where `v` is 1.
    pub c: Vec3,
}

impl Triangle {
    /// A triangle of three corners; counter-clockwise seen from its front.
    pub fn new(a: impl Into<Vec3>, b: impl Into<Vec3>, c: impl Into<Vec3>) -> Self {
        Self {
            a: a.into(),
            b: b.into(),
            c: c.into(),
        }
    }

    /// The corners in order.
    pub fn vertices(&self) -> [Vec3; 3] {
        [self.a, self.b, self.c]
    }
}

impl From<[Vec3; 3]> for Triangle {
    fn from([a, b, c]: [Vec3; 3]) -> Self {
        Self { a, b, c }
    }
}
