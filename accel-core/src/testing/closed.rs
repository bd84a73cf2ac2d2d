//! Closed meshes, for watertightness: a ray from inside must hit.

use std::collections::HashMap;
use std::f32::consts::TAU;

use glam::{Mat3, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::{cube_point, direction};
use crate::{RaySegment, Triangle};

/// A closed mesh with shared vertices, and places strictly inside it.
#[derive(Clone, Debug)]
pub struct ClosedMesh {
    /// Vertex positions.
    pub positions: Vec<Vec3>,
    /// Three indices into `positions` per triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Balls wholly inside, as middle and radius.
    pub inside: Vec<(Vec3, f32)>,
}

impl ClosedMesh {
    /// The unit sphere from an icosahedron, each triangle divided into four
    /// `level` times.
    pub fn icosphere(level: u32) -> Self {
        let (mut positions, mut triangles) = icosahedron();
        for _ in 0..level {
            let mut middles = HashMap::new();
            let mut middle = |a: u32, b: u32| {
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    let between = positions[a as usize] + positions[b as usize];
                    positions.push(between.normalize());
                    positions.len() as u32 - 1
                })
            };
            let mut divided = Vec::with_capacity(triangles.len() * 4);
            for [a, b, c] in triangles {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                divided.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
            }
            triangles = divided;
        }
        Self {
            positions,
            triangles,
            inside: vec![(Vec3::ZERO, 0.5)],
        }
    }

    /// A torus around the y axis, of radii 1 and 0.4.
    pub fn torus(around: usize, across: usize) -> Self {
        let angle = |i: usize, count: usize| i as f32 / count as f32 * TAU;
        let ring = |i: usize| Vec3::new(angle(i, around).cos(), 0.0, angle(i, around).sin());
        let positions = (0..around * across)
            .map(|i| {
                let (outward, turn) = (ring(i / across), angle(i % across, across));
                outward + (outward * turn.cos() + Vec3::Y * turn.sin()) * 0.4
            })
            .collect();
        let vertex = |i: usize, j: usize| (i % around * across + j % across) as u32;
        let cells = (0..around).flat_map(|i| (0..across).map(move |j| (i, j)));
        let triangles = cells.flat_map(|(i, j)| {
            let [a, b] = [vertex(i, j), vertex(i + 1, j)];
            let [c, d] = [vertex(i + 1, j + 1), vertex(i, j + 1)];
            [[a, c, b], [a, d, c]]
        });
        Self {
            triangles: triangles.collect(),
            positions,
            inside: (0..around)
                .step_by(around.div_ceil(7))
                .map(|i| (ring(i), 0.1))
                .collect(),
        }
    }

    /// A room of length `aspect` whose four long walls are `strips` strips of
    /// 1 x `aspect` each, and whose two ends are fans.
    pub fn room(strips: usize, aspect: f32) -> Self {
        let half = strips as f32 / 2.0;
        // The outline of the ends, once around; one strip between neighbours.
        let outline = (0..4 * strips).map(|i| {
            let along = (i % strips) as f32 - half;
            match i / strips {
                0 => (along, -half),
                1 => (half, along),
                2 => (-along, half),
                _ => (-half, -along),
            }
        });
        let count = 4 * strips as u32;
        let mut positions: Vec<Vec3> = outline.map(|(x, y)| Vec3::new(x, y, 0.0)).collect();
        positions.extend_from_within(..);
        for far in &mut positions[count as usize..] {
            far.z = aspect;
        }
        let [near_end, far_end] = [2 * count, 2 * count + 1];
        positions.extend([Vec3::ZERO, Vec3::Z * aspect]);
        let triangles = (0..count).flat_map(|a| {
            let b = (a + 1) % count;
            let (far_a, far_b) = (a + count, b + count);
            [
                [a, b, far_b],
                [a, far_b, far_a],
                [near_end, b, a],
                [far_end, far_a, far_b],
            ]
        });
        Self {
            triangles: triangles.collect(),
            positions,
            inside: [0.1, 0.5, 0.83]
                .map(|z| (Vec3::Z * aspect * z, half.min(aspect * 0.1) * 0.9))
                .to_vec(),
        }
    }

    /// Every position multiplied by `scale`.
    #[must_use]
    pub fn scaled(self, scale: f32) -> Self {
        let inside = self
            .inside
            .iter()
            .map(|&(middle, radius)| (middle * scale, radius * scale));
        Self {
            inside: inside.collect(),
            positions: self.positions.iter().map(|&p| p * scale).collect(),
            triangles: self.triangles,
        }
    }

    /// Every position moved by `offset`; the places inside shrink, since
    /// rounding moves the walls.
    #[must_use]
    pub fn translated(self, offset: Vec3) -> Self {
        let inside = self
            .inside
            .iter()
            .map(|&(middle, radius)| (middle + offset, radius * 0.5));
        Self {
            inside: inside.collect(),
            positions: self.positions.iter().map(|&p| p + offset).collect(),
            triangles: self.triangles,
        }
    }

    /// Every position turned.
    #[must_use]
    pub fn rotated(self, rotation: Mat3) -> Self {
        let inside = self
            .inside
            .iter()
            .map(|&(middle, radius)| (rotation * middle, radius * 0.9));
        Self {
            inside: inside.collect(),
            positions: self.positions.iter().map(|&p| rotation * p).collect(),
            triangles: self.triangles,
        }
    }

    /// The triangles with their corners.
    pub fn triangle_list(&self) -> Vec<Triangle> {
        let corners = self
            .triangles
            .iter()
            .map(|t| t.map(|index| self.positions[index as usize]));
        corners.map(Triangle::from).collect()
    }

    /// Rays from inside, every one of which must hit: a quarter anywhere, a
    /// quarter exactly at points of edges, a quarter 1e-8 to 1e-6 of the edge's
    /// length beside edges, a quarter exactly at vertices.
    pub fn interior_rays(&self, seed: u64, count: usize) -> Vec<RaySegment> {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        (0..count)
            .map(|i| {
                let (middle, radius) = self.inside[random.random_range(0..self.inside.len())];
                let origin = middle + direction(&mut random) * radius * random.random::<f32>();
                let target = self.target(i % 4, origin, radius, &mut random);
                RaySegment::new(origin, target - origin)
            })
            .collect()
    }

    fn target(&self, kind: usize, origin: Vec3, radius: f32, random: &mut Pcg64Mcg) -> Vec3 {
        let triangle = self.triangles[random.random_range(0..self.triangles.len())];
        let corner = random.random_range(0..3);
        let [from, to] = [corner, (corner + 1) % 3].map(|c| self.positions[triangle[c] as usize]);
        let on_edge = from.lerp(to, random.random());
        match kind {
            0 => origin + direction(random) * radius,
            1 => on_edge,
            2 => {
                let exponent = random.random_range(-8.0_f32..-6.0);
                on_edge + cube_point(random) * from.distance(to) * 10.0_f32.powf(exponent)
            }
            _ => from,
        }
    }
}

fn icosahedron() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let golden = (1.0 + 5.0_f32.sqrt()) / 2.0;
    let positions = [
        (-1.0, golden, 0.0),
        (1.0, golden, 0.0),
        (-1.0, -golden, 0.0),
        (1.0, -golden, 0.0),
        (0.0, -1.0, golden),
        (0.0, 1.0, golden),
        (0.0, -1.0, -golden),
        (0.0, 1.0, -golden),
        (golden, 0.0, -1.0),
        (golden, 0.0, 1.0),
        (-golden, 0.0, -1.0),
        (-golden, 0.0, 1.0),
    ];
    let triangles = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    let positions = positions.map(|(x, y, z)| Vec3::new(x, y, z).normalize());
    (positions.to_vec(), triangles.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_edge_has_two_triangles_that_run_along_it_in_opposite_directions() {
        let meshes = [
            ClosedMesh::icosphere(2),
            ClosedMesh::torus(9, 7),
            ClosedMesh::room(3, 100.0),
            ClosedMesh::room(1, 30.0).scaled(1e-3).translated(Vec3::ONE),
        ];
        for mesh in meshes {
            let mut edges = HashMap::new();
            for [a, b, c] in &mesh.triangles {
                for edge in [(*a, *b), (*b, *c), (*c, *a)] {
                    *edges.entry(edge).or_insert(0) += 1;
                }
            }
            for (&(a, b), &count) in &edges {
                assert_eq!((count, edges.get(&(b, a))), (1, Some(&1)), "edge {a} {b}");
            }
        }
    }

    #[test]
    fn inside_is_inside() {
        for mesh in [
            ClosedMesh::icosphere(1),
            ClosedMesh::torus(12, 12),
            ClosedMesh::room(4, 50.0),
        ] {
            for &(middle, _) in &mesh.inside {
                let solid_angle: f64 = mesh
                    .triangle_list()
                    .iter()
                    .map(|t| seen_angle(t, middle))
                    .sum();
                let turns = solid_angle / (4.0 * std::f64::consts::PI);
                assert!((turns.abs() - 1.0).abs() < 1e-6, "{turns}");
            }
        }
    }

    /// The solid angle of a triangle (van Oosterom and Strackee 1983).
    fn seen_angle(triangle: &Triangle, from: Vec3) -> f64 {
        let [a, b, c] = triangle
            .vertices()
            .map(|v| (v.as_dvec3() - from.as_dvec3()).normalize());
        2.0 * a
            .dot(b.cross(c))
            .atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
    }
}
