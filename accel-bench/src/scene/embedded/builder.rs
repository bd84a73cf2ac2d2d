//! Building blocks of the embedded scenes.

use std::f32::consts::TAU;

use accel_core::glam::{Mat3, Vec3};

use crate::scene::Mesh;

/// Collects shapes into a mesh.
#[derive(Default)]
pub(super) struct MeshBuilder {
    mesh: Mesh,
}

impl MeshBuilder {
    pub(super) fn finish(self) -> Mesh {
        self.mesh
    }

    pub(super) fn triangles(&self) -> usize {
        self.mesh.triangles.len()
    }

    fn vertex(&mut self, position: Vec3) -> u32 {
        self.mesh.positions.push(position);
        self.mesh.positions.len() as u32 - 1
    }

    /// A triangle of its own.
    pub(super) fn triangle(&mut self, corners: [Vec3; 3]) {
        let indices = corners.map(|corner| self.vertex(corner));
        self.mesh.triangles.push(indices);
    }

    /// `columns` by `rows` quads with shared vertices, placed by fractions of
    /// both in 0 .. 1.
    pub(super) fn grid(&mut self, columns: usize, rows: usize, place: impl Fn(f32, f32) -> Vec3) {
        let first = self.mesh.positions.len() as u32;
        for row in 0..=rows {
            for column in 0..=columns {
                let position = place(column as f32 / columns as f32, row as f32 / rows as f32);
                self.vertex(position);
            }
        }
        let width = columns as u32 + 1;
        for row in 0..rows as u32 {
            for column in 0..columns as u32 {
                let a = first + row * width + column;
                let (b, c, d) = (a + 1, a + width + 1, a + width);
                self.mesh.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }

    /// A flat quad from `corner` along both sides, of `divisions` squared cells.
    pub(super) fn quad(&mut self, corner: Vec3, along: Vec3, up: Vec3, divisions: usize) {
        self.grid(divisions, divisions, |u, v| corner + along * u + up * v);
    }

    /// An axis-aligned box, 12 triangles.
    pub(super) fn cuboid(&mut self, min: Vec3, max: Vec3) {
        let size = max - min;
        let [x, y, z] = [Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z];
        for (corner, along, up) in [
            (min, y, x),
            (min + z, x, y),
            (min, z, y),
            (min + x, y, z),
            (min, x, z),
            (min + y, z, x),
        ] {
            self.quad(corner, along, up, 1);
        }
    }

    /// A body of revolution about the vertical axis through `base`: `profile`
    /// gives radius and height for fractions from 0 at the bottom to 1.
    pub(super) fn revolution(
        &mut self,
        base: Vec3,
        around: usize,
        up: usize,
        profile: impl Fn(f32) -> (f32, f32),
    ) {
        self.grid(around, up, |u, v| {
            let (radius, height) = profile(v);
            let angle = if u < 1.0 { u * TAU } else { 0.0 };
            base + Vec3::new(radius * angle.cos(), height, -radius * angle.sin())
        });
    }

    /// A sphere.
    pub(super) fn sphere(&mut self, center: Vec3, radius: f32, divisions: usize) {
        self.revolution(center, divisions * 2, divisions, |v| {
            let angle = v * TAU / 2.0;
            (radius * angle.sin(), -radius * angle.cos())
        });
    }

    /// A tube along a polyline.
    pub(super) fn tube(&mut self, path: &[Vec3], radius: impl Fn(f32) -> f32, sides: usize) {
        let last = path.len() - 1;
        let frames: Vec<(Vec3, Vec3)> = (0..=last)
            .map(|i| {
                let ahead = path[(i + 1).min(last)] - path[i.saturating_sub(1)];
                let side = ahead.any_orthogonal_vector().normalize_or_zero();
                (side, ahead.normalize_or_zero().cross(side))
            })
            .collect();
        self.grid(sides, last, |u, v| {
            let i = (v * last as f32).round() as usize;
            let angle = if u < 1.0 { u * TAU } else { 0.0 };
            let (side, other) = frames[i];
            path[i] + (side * angle.cos() + other * angle.sin()) * radius(v)
        });
    }

    /// Turns everything so far.
    pub(super) fn rotate(&mut self, rotation: Mat3) {
        for position in &mut self.mesh.positions {
            *position = rotation * *position;
        }
    }
}

/// Turns by 45 degrees about x, then y, then z.
pub(super) fn turned() -> Mat3 {
    use std::f32::consts::FRAC_PI_4;
    Mat3::from_rotation_z(FRAC_PI_4)
        * Mat3::from_rotation_y(FRAC_PI_4)
        * Mat3::from_rotation_x(FRAC_PI_4)
}
