//! Building blocks of the embedded scenes. The vertical axis is y; fronts of
//! solid shapes face outwards.

use std::f32::consts::{PI, TAU};

use accel_core::glam::{Affine3A, Quat, Vec3};

use crate::scene::Mesh;

/// Collects shapes into a mesh.
#[derive(Default)]
pub(super) struct MeshBuilder {
    mesh: Mesh,
}

impl MeshBuilder {
    /// The mesh, without positions that no triangle uses, such as the spare ones
    /// of a pole.
    pub(super) fn finish(self) -> Mesh {
        let Mesh {
            positions,
            mut triangles,
        } = self.mesh;
        let mut is_used = vec![false; positions.len()];
        for &index in triangles.iter().flatten() {
            is_used[index as usize] = true;
        }
        let numbers: Vec<u32> = is_used
            .iter()
            .scan(0, |next, &is_used| {
                let number = *next;
                *next += u32::from(is_used);
                Some(number)
            })
            .collect();
        for index in triangles.iter_mut().flatten() {
            *index = numbers[*index as usize];
        }
        let kept = positions.into_iter().zip(is_used);
        let positions = kept.filter(|kept| kept.1).map(|kept| kept.0).collect();
        Mesh {
            positions,
            triangles,
        }
    }

    pub(super) fn triangle_count(&self) -> usize {
        self.mesh.triangles.len()
    }

    /// A triangle of its own.
    pub(super) fn triangle(&mut self, corners: [Vec3; 3]) {
        let first = self.mesh.positions.len() as u32;
        self.mesh.positions.extend(corners);
        self.mesh.triangles.push([first, first + 1, first + 2]);
    }

    /// Two triangles with the edge from `from` to `to` in common.
    pub(super) fn folded_pair(&mut self, from: Vec3, to: Vec3, left: Vec3, right: Vec3) {
        let first = self.mesh.positions.len() as u32;
        self.mesh.positions.extend([from, to, left, right]);
        let pair = [[first, first + 1, first + 2], [first + 1, first, first + 3]];
        self.mesh.triangles.extend(pair);
    }

    /// `columns` by `rows` quads with shared vertices, placed by fractions of
    /// both in 0 ..= 1. Where a row shrinks to a point, as at a pole, the
    /// triangles without area are left out.
    pub(super) fn grid(&mut self, [columns, rows]: [usize; 2], place: impl Fn(f32, f32) -> Vec3) {
        let first = self.mesh.positions.len() as u32;
        for row in 0..=rows {
            for column in 0..=columns {
                let (u, v) = (column as f32 / columns as f32, row as f32 / rows as f32);
                self.mesh.positions.push(place(u, v));
            }
        }
        let width = columns as u32 + 1;
        for row in 0..rows as u32 {
            for column in 0..columns as u32 {
                let a = first + row * width + column;
                let (b, c, d) = (a + 1, a + width + 1, a + width);
                self.indexed_triangle([a, b, c]);
                self.indexed_triangle([a, c, d]);
            }
        }
    }

    fn indexed_triangle(&mut self, indices: [u32; 3]) {
        let [a, b, c] = indices.map(|index| self.mesh.positions[index as usize]);
        if a != b && b != c && c != a {
            self.mesh.triangles.push(indices);
        }
    }

    /// A flat parallelogram from `corner` along both sides.
    pub(super) fn quad(&mut self, corner: Vec3, along: Vec3, up: Vec3, cells: [usize; 2]) {
        self.grid(cells, |u, v| corner + along * u + up * v);
    }

    /// An axis-aligned box: 12 triangles.
    pub(super) fn cuboid(&mut self, min: Vec3, max: Vec3) {
        self.placed_cuboid(&Affine3A::IDENTITY, min, max);
    }

    /// A box that is axis-aligned before `placement` turns and moves it.
    pub(super) fn placed_cuboid(&mut self, placement: &Affine3A, min: Vec3, max: Vec3) {
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
            self.quad(
                placement.transform_point3(corner),
                placement.transform_vector3(along),
                placement.transform_vector3(up),
                [1, 1],
            );
        }
    }

    /// A body of revolution about the vertical axis through `base`: `profile`
    /// gives radius and height above `base` for fractions from 0 at the bottom
    /// to 1 at the top. `cells` counts around and up.
    pub(super) fn revolution(
        &mut self,
        base: Vec3,
        cells: [usize; 2],
        profile: impl Fn(f32) -> (f32, f32),
    ) {
        self.grid(cells, |u, v| {
            let (radius, height) = profile(v);
            let (sin, cos) = full_turn(u);
            base + Vec3::new(radius * cos, height, -radius * sin)
        });
    }

    /// An ellipsoid with its poles above and below.
    pub(super) fn ellipsoid(&mut self, center: Vec3, radii: Vec3, cells: [usize; 2]) {
        self.grid(cells, |u, v| {
            let (sin, cos) = full_turn(u);
            let ring = arc_height(v);
            center + radii * Vec3::new(ring * cos, -(v * PI).cos(), -ring * sin)
        });
    }

    /// A sphere.
    pub(super) fn sphere(&mut self, center: Vec3, radius: f32, cells: [usize; 2]) {
        self.ellipsoid(center, Vec3::splat(radius), cells);
    }

    /// An open tube along a polyline. `radius` is asked for fractions of the
    /// number of segments from 0 to 1; the path's points must differ.
    pub(super) fn tube(&mut self, path: &[Vec3], radius: impl Fn(f32) -> f32, sides: usize) {
        let last = path.len() - 1;
        let frames = frames_along(path);
        self.grid([sides, last], |u, v| {
            let point = (v * last as f32).round() as usize;
            let (side, other) = frames[point];
            let (sin, cos) = full_turn(u);
            path[point] + (side * cos + other * sin) * radius(v)
        });
    }

    /// Drops the triangles whose corners `keep` refuses.
    pub(super) fn retain(&mut self, keep: impl Fn(&[Vec3; 3]) -> bool) {
        let Mesh {
            positions,
            triangles,
        } = &mut self.mesh;
        triangles.retain(|triangle| keep(&triangle.map(|index| positions[index as usize])));
    }

    /// Moves every vertex so far by what `offset` says of it.
    pub(super) fn displace(&mut self, offset: impl Fn(Vec3) -> Vec3) {
        for position in &mut self.mesh.positions {
            *position += offset(*position);
        }
    }

    /// Turns and moves everything so far.
    pub(super) fn transform(&mut self, placement: &Affine3A) {
        for position in &mut self.mesh.positions {
            *position = placement.transform_point3(*position);
        }
    }
}

/// The count of triangles a scene is asked for, handed out to its parts by
/// weight: what one part rounds away, the parts after it get.
pub(super) struct TriangleBudget {
    total: usize,
    weight_left: f32,
}

impl TriangleBudget {
    /// `weight` is the sum of the weights of all parts to come.
    pub(super) fn new(total: usize, weight: f32) -> Self {
        Self {
            total,
            weight_left: weight,
        }
    }

    /// The triangles for the next part of `weight` when `so_far` are built.
    pub(super) fn share(&mut self, so_far: usize, weight: f32) -> usize {
        let fraction = (weight / self.weight_left).clamp(0.0, 1.0);
        self.weight_left -= weight;
        (self.total.saturating_sub(so_far) as f32 * fraction).round() as usize
    }
}

/// Columns and rows of a grid of about `triangles` triangles with `aspect` times
/// as many columns as rows, but at least `least` of each.
pub(super) fn cells(triangles: usize, aspect: f32, least: [usize; 2]) -> [usize; 2] {
    let quads = triangles as f32 / 2.0;
    let columns = ((quads * aspect).sqrt().round() as usize).max(least[0]);
    let rows = ((quads / columns as f32).round() as usize).max(least[1]);
    [columns, rows]
}

/// Sine and cosine of a fraction of the full turn; the end is bit for bit the
/// beginning, so that seams are closed.
pub(super) fn full_turn(fraction: f32) -> (f32, f32) {
    if fraction < 1.0 {
        (fraction * TAU).sin_cos()
    } else {
        (0.0, 1.0)
    }
}

/// The sine of a fraction of the half turn, exactly 0 at both ends, so that
/// poles are points.
pub(super) fn arc_height(fraction: f32) -> f32 {
    if fraction > 0.0 && fraction < 1.0 {
        (fraction * PI).sin()
    } else {
        0.0
    }
}

/// Turns by 45 degrees about x, then y, then z.
pub(super) fn turned_about_all_axes() -> Affine3A {
    use std::f32::consts::FRAC_PI_4;
    let turn = Quat::from_rotation_z(FRAC_PI_4)
        * Quat::from_rotation_y(FRAC_PI_4)
        * Quat::from_rotation_x(FRAC_PI_4);
    Affine3A::from_quat(turn)
}

/// Two axes across the path at each point, carried along from the first by the
/// smallest turns, so that a tube doesn't twist.
fn frames_along(path: &[Vec3]) -> Vec<(Vec3, Vec3)> {
    let last = path.len() - 1;
    let heading = |i: usize| {
        let (before, here) = (path[i.saturating_sub(1)], path[i]);
        let after = path[(i + 1).min(last)];
        let sum = (here - before).normalize_or_zero() + (after - here).normalize_or_zero();
        sum.normalize_or((after - here).normalize_or(Vec3::Y))
    };
    let mut ahead = heading(0);
    let mut side = ahead.any_orthonormal_vector();
    let mut frames = vec![(side, ahead.cross(side))];
    for i in 1..=last {
        let next = heading(i);
        let carried = Quat::from_rotation_arc(ahead, next) * side;
        side = carried.reject_from_normalized(next).normalize_or(side);
        ahead = next;
        frames.push((side, ahead.cross(side)));
    }
    frames
}
