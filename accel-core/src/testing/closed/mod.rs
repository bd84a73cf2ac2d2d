//! Closed meshes and rays from inside them, for tests of watertightness.
//!
//! A closed mesh has no border and its triangles share vertices bit for bit,
//! so a ray that starts inside must hit. Rounding of moved vertices bends
//! the surface, but never opens it.

mod interior;
mod shapes;

use glam::{DVec3, Quat, Vec3};

pub use interior::interior_rays;

use crate::Triangle;

/// A triangle mesh without border, and places that are certainly inside it.
#[derive(Clone, Debug)]
pub struct ClosedMesh {
    /// The vertices.
    pub positions: Vec<Vec3>,
    /// Indices of each triangle's corners in `positions`, counter-clockwise
    /// seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Balls that lie strictly inside. One that a transform's rounding might
    /// have pushed through the surface is dropped, so there may be none left.
    pub inside: Vec<Ball>,
}

/// All points within `radius` of `center`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// The middle.
    pub center: Vec3,
    /// The radius, in scene units.
    pub radius: f32,
}

impl ClosedMesh {
    /// The mesh as separate triangles, in the order of `triangles`.
    pub fn to_triangles(&self) -> Vec<Triangle> {
        let corners = self.triangles.iter();
        corners
            .map(|corners| corners.map(|index| self.positions[index as usize]).into())
            .collect()
    }

    /// The mesh `scale` times as large, about the origin.
    #[must_use]
    pub fn scaled(&self, scale: f32) -> Self {
        self.moved(|position| position * scale, scale)
    }

    /// The mesh shifted by `offset`. Far offsets coarsen its shape.
    #[must_use]
    pub fn translated(&self, offset: impl Into<Vec3>) -> Self {
        let offset = offset.into();
        self.moved(|position| position + offset, 1.0)
    }

    /// The mesh turned about the origin.
    #[must_use]
    pub fn rotated(&self, rotation: Quat) -> Self {
        self.moved(|position| rotation * position, 1.0)
    }

    /// Moves all vertices by a map that changes distances by the factor
    /// `scale`, but for rounding.
    fn moved(&self, map: impl Fn(Vec3) -> Vec3, scale: f32) -> Self {
        let positions: Vec<_> = self
            .positions
            .iter()
            .map(|&position| map(position))
            .collect();
        let largest = |positions: &[Vec3]| {
            let coordinates = positions
                .iter()
                .map(|position| position.abs().max_element());
            coordinates.fold(0.0, f32::max)
        };
        // A vertex or center is off by the rounding of the result and of some
        // operations before it; subnormal results lose a fixed amount.
        let rounding = f32::EPSILON
            * (largest(&positions) + 8.0 * scale * largest(&self.positions))
            + 8.0 * f32::from_bits(1);
        let shrunk = |ball: &Ball| Ball {
            center: map(ball.center),
            radius: scale * ball.radius - 2.0 * rounding,
        };
        let inside = self.inside.iter().map(shrunk);
        Self {
            inside: inside.filter(|ball| ball.radius > 0.0).collect(),
            triangles: self.triangles.clone(),
            positions,
        }
    }

    /// A mesh with the largest balls around `centers`, points inside it, for
    /// which a simple bound shows that they don't reach the surface.
    fn around(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>, centers: &[Vec3]) -> Self {
        let mut mesh = Self {
            positions,
            triangles,
            inside: Vec::new(),
        };
        let surface = mesh.to_triangles();
        mesh.inside = centers
            .iter()
            .map(|&center| {
                let distances = surface.iter().map(|triangle| clearance(center, triangle));
                let nearest = distances.fold(f64::INFINITY, f64::min);
                let radius = (0.9 * nearest) as f32;
                Ball { center, radius }
            })
            .collect();
        mesh
    }
}

/// A lower bound of the distance from `point` to `triangle`: that to its
/// plane, or that to a ball around it.
fn clearance(point: Vec3, triangle: &Triangle) -> f64 {
    let [a, b, c] = triangle.vertices().map(Vec3::as_dvec3);
    let point = point.as_dvec3();
    let middle = (a + b + c) / 3.0;
    let reach = |corner: DVec3| corner.distance(middle);
    let to_ball = point.distance(middle) - reach(a).max(reach(b)).max(reach(c));
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let to_plane = normal.dot(point - a).abs();
    to_ball.max(to_plane)
}

#[cfg(test)]
mod tests;
