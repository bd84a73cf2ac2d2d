//! The closed meshes.

use std::collections::HashMap;
use std::f32::consts::{PI, TAU};

use glam::Vec3;

use super::ClosedMesh;

/// Finer spheres would not be told apart in f32 tests, and fill memory.
const FINEST_LEVEL: u32 = 8;

impl ClosedMesh {
    /// A unit sphere of `20 * 4^level` nearly equal triangles; `level` counts
    /// as 8 at most.
    pub fn icosphere(level: u32) -> Self {
        let (mut positions, mut triangles) = icosahedron();
        for _ in 0..level.min(FINEST_LEVEL) {
            triangles = quartered(&mut positions, &triangles);
        }
        Self::around(positions, triangles, &[Vec3::ZERO])
    }

    /// An icosphere whose radius varies by up to `height` (0 to 0.5) above and
    /// below 1.
    pub fn bumpy_sphere(level: u32, height: f32) -> Self {
        let height = height.clamp(0.0, 0.5);
        let sphere = Self::icosphere(level);
        let bumpy = |&position: &Vec3| {
            let wave = |x: f32| (7.0 * x).sin();
            position * (1.0 + height * wave(position.x) * wave(position.y) * wave(position.z))
        };
        let positions = sphere.positions.iter().map(bumpy).collect();
        Self::around(positions, sphere.triangles, &[Vec3::ZERO])
    }

    /// A unit sphere of `segments` meridians and `rings` bands between its
    /// poles (each at least 3): skinny triangles fan around the poles.
    pub fn latitude_longitude(segments: u32, rings: u32) -> Self {
        let (segments, rings) = (segments.max(3), rings.max(3));
        let profile: Vec<_> = (1..rings)
            .map(|ring| {
                let (sine, cosine) = (ring as f32 / rings as f32 * PI).sin_cos();
                let circle = (0..segments).map(|segment| {
                    let turn = segment as f32 / segments as f32 * TAU;
                    Vec3::new(sine * turn.cos(), sine * turn.sin(), cosine)
                });
                circle.collect()
            })
            .collect();
        let (positions, triangles) = capped_rings(Vec3::Z, &profile, Vec3::NEG_Z);
        Self::around(positions, triangles, &[Vec3::ZERO])
    }

    /// A room with a square section, `length` long, whose four long walls are
    /// `strips` strips each, one unit wide and as long as the room. Its ends
    /// are fans. It has 16 triangles a strip.
    pub fn room_of_strips(length: f32, strips: u32) -> Self {
        let strips = strips.max(1);
        let half = strips as f32 / 2.0;
        let square = |z: f32| -> Vec<Vec3> {
            let sides = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
            let side = |(x, y): (f32, f32)| {
                (0..strips).map(move |strip| {
                    let along = strip as f32 - half;
                    // From the corner at the side's start, counter-clockwise.
                    Vec3::new(x * along + y * half, y * along - x * half, z)
                })
            };
            sides.into_iter().flat_map(side).collect()
        };
        let ends = [square(length), square(0.0)];
        let (positions, triangles) = capped_rings(Vec3::Z * length, &ends, Vec3::ZERO);
        let centers = [0.1, 0.5, 0.9].map(|along| Vec3::Z * length * along);
        Self::around(positions, triangles, &centers)
    }

    /// A ring of radius 1 with a tube of radius 0.4, of `major` sections
    /// around its axis and `minor` around its tube (each at least 3).
    pub fn torus(major: u32, minor: u32) -> Self {
        let (major, minor) = (major.max(3), minor.max(3));
        let on_ring = |turn: f32| Vec3::new(turn.cos(), turn.sin(), 0.0);
        let angle = |index: u32, count: u32| index as f32 / count as f32 * TAU;
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        for section in 0..major {
            let outward = on_ring(angle(section, major));
            for around in 0..minor {
                let (sine, cosine) = angle(around, minor).sin_cos();
                positions.push(outward * (1.0 + 0.4 * cosine) + 0.4 * sine * Vec3::Z);
                let next = (section + 1) % major;
                let up = (around + 1) % minor;
                let index = |section, around| section * minor + around;
                let near = [index(section, around), index(section, up)];
                let far = [index(next, around), index(next, up)];
                triangles.push([near[0], far[0], far[1]]);
                triangles.push([near[0], far[1], near[1]]);
            }
        }
        let centers = [0, major / 3, 2 * major / 3].map(|section| on_ring(angle(section, major)));
        Self::around(positions, triangles, &centers)
    }
}

/// A tube through `rings` of equally many vertices each, counter-clockwise
/// seen from `first`, closed by fans around `first` and `last`.
fn capped_rings(first: Vec3, rings: &[Vec<Vec3>], last: Vec3) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let segments = rings[0].len() as u32;
    let positions: Vec<_> = [first]
        .into_iter()
        .chain(rings.iter().flatten().copied())
        .chain([last])
        .collect();
    let bottom = rings.len() as u32 - 1;
    let vertex = |ring: u32, segment: u32| 1 + ring * segments + segment % segments;
    let mut triangles = Vec::new();
    for segment in 0..segments {
        let next = segment + 1;
        triangles.push([0, vertex(0, segment), vertex(0, next)]);
        for ring in 0..bottom {
            let [a, b] = [vertex(ring, segment), vertex(ring, next)];
            let [c, d] = [vertex(ring + 1, segment), vertex(ring + 1, next)];
            triangles.push([a, c, d]);
            triangles.push([a, d, b]);
        }
        let pole = positions.len() as u32 - 1;
        triangles.push([pole, vertex(bottom, next), vertex(bottom, segment)]);
    }
    (positions, triangles)
}

/// The unit icosahedron: three golden rectangles' corners.
fn icosahedron() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let golden = (1.0 + 5f32.sqrt()) / 2.0;
    let mut positions = Vec::new();
    for axis in 0..3 {
        for (short, long) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
            let mut corner = [0.0; 3];
            corner[(axis + 1) % 3] = short;
            corner[(axis + 2) % 3] = long * golden;
            positions.push(Vec3::from_array(corner).normalize());
        }
    }
    let triangles = faces_of_neighbours(&positions);
    (positions, triangles)
}

/// All triples of mutual nearest neighbours, facing away from the origin.
fn faces_of_neighbours(positions: &[Vec3]) -> Vec<[u32; 3]> {
    let count = positions.len();
    let near = |i: usize, j: usize| positions[i].dot(positions[j]) > 0.4;
    let mut faces = Vec::new();
    for i in 0..count {
        for j in (i + 1..count).filter(|&j| near(i, j)) {
            for k in (j + 1..count).filter(|&k| near(i, k) && near(j, k)) {
                let volume = positions[i].dot(positions[j].cross(positions[k]));
                let face = if volume > 0.0 { [i, j, k] } else { [i, k, j] };
                faces.push(face.map(|index| index as u32));
            }
        }
    }
    faces
}

/// Each triangle in four, with the new vertices on the unit sphere.
fn quartered(positions: &mut Vec<Vec3>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let sum = positions[a as usize] + positions[b as usize];
            positions.push(sum.normalize());
            positions.len() as u32 - 1
        })
    };
    triangles
        .iter()
        .flat_map(|&[a, b, c]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        })
        .collect()
}
