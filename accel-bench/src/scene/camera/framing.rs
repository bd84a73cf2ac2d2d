//! Choosing a camera for a mesh that has none.
//!
//! Candidates frame the robust bounds of the triangles from outside in
//! three-quarter views. The largest triangles tell how many of a sample of
//! triangles each candidate sees: if walls hide most of them from everywhere
//! outside, candidates inside the bounds are tried as well.

use std::cmp::Reverse;

use accel_core::glam::{DVec3, Vec3};

use super::{Camera, Frame};
use crate::scene::Mesh;

/// Triangles whose centres a candidate should see.
const SAMPLES: usize = 96;
/// The largest triangles, which may hide them.
const OCCLUDERS: usize = 2048;
/// The part of the triangles outside of the robust bounds on each side.
const OUTLIERS: usize = 100;
/// An outside view that sees less than a quarter of the samples may be before a
/// closed room: of a closed convex object it sees a half.
const CLOSED: usize = 4;
/// The picture's width over its height that candidates are judged by.
const ASPECT: [u32; 2] = [4, 3];

pub(super) fn camera_seeing(mesh: &Mesh) -> Camera {
    let facets = finite_facets(mesh);
    if facets.is_empty() {
        return outside(&Bounds::UNIT, OUTSIDE[0]);
    }
    let bounds = Bounds::robust(&facets);
    let scene = Sample::new(facets, &bounds);
    let views = OUTSIDE.map(|direction| outside(&bounds, direction));
    let (camera, seen) = scene.best_of(&views);
    if seen * CLOSED >= scene.samples.len() {
        return camera;
    }
    let (within, seen_within) = scene.best_of(&inside(&bounds));
    if seen_within > 2 * seen {
        within
    } else {
        camera
    }
}

/// From where to look: from the right and the front first, then from the other
/// sides, then steeply.
const OUTSIDE: [[f64; 3]; 6] = [
    [0.55, 0.42, 1.0],
    [-0.55, 0.42, 1.0],
    [0.7, 0.5, -0.8],
    [-0.7, 0.5, -0.8],
    [0.3, 1.0, 0.5],
    [0.9, -0.4, 0.6],
];

/// A triangle by what framing needs of it.
struct Facet {
    corners: [DVec3; 3],
    center: DVec3,
    /// The length of its longest edge.
    extent: f64,
}

fn finite_facets(mesh: &Mesh) -> Vec<Facet> {
    let facet = |triangle: &[u32; 3]| {
        let position = |index: u32| mesh.positions.get(index as usize).copied();
        let [a, b, c] = triangle.map(|index| position(index).unwrap_or(Vec3::NAN));
        let corners = [a, b, c].map(Vec3::as_dvec3);
        let [a, b, c] = corners;
        let is_finite = corners.iter().all(|corner| corner.is_finite());
        is_finite.then(|| Facet {
            corners,
            center: (a + b + c) / 3.0,
            extent: a.distance(b).max(b.distance(c)).max(c.distance(a)),
        })
    };
    mesh.triangles.iter().filter_map(facet).collect()
}

/// The box of the middle 98 % of the centres on each axis, and the radius of a
/// ball around its middle that holds them and a usual triangle.
struct Bounds {
    center: DVec3,
    half: DVec3,
    radius: f64,
}

impl Bounds {
    const UNIT: Self = Self {
        center: DVec3::ZERO,
        half: DVec3::ONE,
        radius: 1.0,
    };

    fn robust(facets: &[Facet]) -> Self {
        let outermost = facets.len() / OUTLIERS;
        let (mut low, mut high) = (DVec3::ZERO, DVec3::ZERO);
        for axis in 0..3 {
            let mut along: Vec<f64> = facets.iter().map(|facet| facet.center[axis]).collect();
            low[axis] = nth(&mut along, outermost);
            high[axis] = nth(&mut along, facets.len() - 1 - outermost);
        }
        let mut extents: Vec<f64> = facets.iter().map(|facet| facet.extent).collect();
        let usual = nth(&mut extents, facets.len() / 2);
        let (center, half) = ((low + high) / 2.0, (high - low) / 2.0);
        // A point far away still needs an eye that differs from it in f32.
        let least = center.abs().max_element() * 1e-4;
        let radius = (half.length() + usual * 0.5).max(least);
        Self {
            center,
            half,
            radius: if radius > 0.0 { radius } else { 1.0 },
        }
    }
}

fn nth(values: &mut [f64], n: usize) -> f64 {
    *values.select_nth_unstable_by(n, f64::total_cmp).1
}

/// Samples of the triangles within the bounds, and what may hide them.
struct Sample {
    facets: Vec<Facet>,
    samples: Vec<usize>,
    occluders: Vec<usize>,
}

impl Sample {
    fn new(facets: Vec<Facet>, bounds: &Bounds) -> Self {
        let is_within = |&i: &usize| {
            let from_center = (facets[i].center - bounds.center).abs();
            from_center.cmple(bounds.half * (1.0 + 1e-9)).all()
        };
        let within: Vec<usize> = (0..facets.len()).filter(is_within).collect();
        let count = within.len().min(SAMPLES);
        let samples = (0..count).map(|i| within[i * within.len() / count]);
        let mut by_extent: Vec<usize> = (0..facets.len()).collect();
        let count = by_extent.len().min(OCCLUDERS);
        by_extent.select_nth_unstable_by_key(count - 1, |&i| Reverse(facets[i].extent.to_bits()));
        by_extent.truncate(count);
        Self {
            samples: samples.collect(),
            occluders: by_extent,
            facets,
        }
    }

    /// The first of the candidates that see the most, and how many samples.
    fn best_of(&self, candidates: &[Camera]) -> (Camera, usize) {
        let mut best = (candidates[0], self.seen(&candidates[0]));
        for &camera in &candidates[1..] {
            let seen = self.seen(&camera);
            // A view further down the list has to be clearly better.
            if 4 * seen > 5 * best.1 {
                best = (camera, seen);
            }
        }
        best
    }

    fn seen(&self, camera: &Camera) -> usize {
        let frame = Frame::new(camera, ASPECT[0], ASPECT[1]);
        let eye = camera.eye.as_dvec3();
        let is_seen = |&&sample: &&usize| {
            let facet = &self.facets[sample];
            let in_frame = frame.project(facet.center.as_vec3());
            in_frame.is_some_and(|[x, y]| x.abs() <= 1.0 && y.abs() <= 1.0)
                && !is_edge_on(facet, eye)
                && !self.is_hidden(sample, eye)
        };
        self.samples.iter().filter(is_seen).count()
    }

    fn is_hidden(&self, sample: usize, eye: DVec3) -> bool {
        let to = self.facets[sample].center - eye;
        let others = self.occluders.iter().filter(|&&other| other != sample);
        others
            .map(|&other| &self.facets[other].corners)
            .any(|corners| is_between(corners, eye, to))
    }
}

/// Whether a triangle is seen as a line. One without area is always a line.
fn is_edge_on(facet: &Facet, eye: DVec3) -> bool {
    let [a, b, c] = facet.corners;
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let view = (facet.center - eye).normalize_or_zero();
    normal != DVec3::ZERO && normal.dot(view).abs() < 0.05
}

/// Whether the triangle cuts the way from `eye` to `eye + to` before its end
/// (Moeller and Trumbore 1997). Only for choosing a view: no hit depends on it.
fn is_between(&[a, b, c]: &[DVec3; 3], eye: DVec3, to: DVec3) -> bool {
    let (ab, ac, from) = (b - a, c - a, eye - a);
    let p = to.cross(ac);
    let q = from.cross(ab);
    let scale = 1.0 / ab.dot(p);
    let (u, v, t) = (from.dot(p) * scale, to.dot(q) * scale, ac.dot(q) * scale);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < 0.999
}

/// A view from `direction`, far enough for the bounds' ball to fit with room.
fn outside(bounds: &Bounds, direction: [f64; 3]) -> Camera {
    let degrees: f32 = 45.0;
    let half_angle = f64::from(degrees).to_radians() / 2.0;
    let distance = 1.05 * bounds.radius / half_angle.sin();
    let eye = bounds.center + DVec3::from(direction).normalize() * distance;
    Camera::upright(rounded(eye), rounded(bounds.center), degrees)
}

/// Views from between the middle and the bounds' corners and faces, to the middle.
fn inside(bounds: &Bounds) -> Vec<Camera> {
    let sides = [-1.0, 0.0, 1.0];
    let places = sides.map(|x| sides.map(|y| sides.map(|z| DVec3::new(x, y, z))));
    let places = places.as_flattened().as_flattened();
    let away = places
        .iter()
        .filter(|&&place| place.x != 0.0 || place.z != 0.0);
    away.flat_map(|&place| [0.8, 0.5].map(|reach| place * reach))
        .map(|place| {
            let eye = bounds.center + place * bounds.half;
            Camera::upright(rounded(eye), rounded(bounds.center), 65.0)
        })
        .filter(|camera| camera.validated().is_ok())
        .chain([outside(bounds, OUTSIDE[0])])
        .collect()
}

/// In f32, and finite: scenes may be as large as its range.
fn rounded(point: DVec3) -> Vec3 {
    let limit = DVec3::splat(f64::from(f32::MAX));
    point.clamp(-limit, limit).as_vec3()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::embedded;

    /// The part of the finite triangles' centres in the frame, in percent.
    fn framed(mesh: &Mesh, camera: &Camera) -> usize {
        let camera = camera.validated().unwrap();
        let frame = Frame::new(&camera, ASPECT[0], ASPECT[1]);
        let facets = finite_facets(mesh);
        let is_framed = |facet: &&Facet| {
            let place = frame.project(facet.center.as_vec3());
            place.is_some_and(|[x, y]| x.abs() <= 1.0 && y.abs() <= 1.0)
        };
        facets.iter().filter(is_framed).count() * 100 / facets.len()
    }

    fn is_within(mesh: &Mesh, camera: &Camera) -> bool {
        let [low, high] =
            [Vec3::min, Vec3::max].map(|pick| mesh.positions.iter().copied().reduce(pick).unwrap());
        camera.eye.cmpge(low).all() && camera.eye.cmple(high).all()
    }

    fn scene(name: &str) -> Mesh {
        embedded::find(name).unwrap().mesh_of(3000)
    }

    #[test]
    fn objects_and_open_scenes_are_seen_whole_from_outside() {
        for name in [
            "cylinder", "figure", "pipes", "foliage", "hairball", "city", "stadium",
        ] {
            let mesh = scene(name);
            let camera = Camera::seeing(&mesh);
            let percent = framed(&mesh, &camera);
            assert!(percent >= 95, "{name}: {percent} % in {camera}");
            assert!(!is_within(&mesh, &camera), "{name}: {camera}");
        }
    }

    #[test]
    fn closed_rooms_are_seen_from_inside() {
        for name in ["room", "colonnade", "colonnade-45"] {
            let mesh = scene(name);
            let camera = Camera::seeing(&mesh);
            let percent = framed(&mesh, &camera);
            assert!(percent >= 50, "{name}: {percent} % in {camera}");
            assert!(is_within(&mesh, &camera), "{name}: {camera}");
        }
    }

    #[test]
    fn outliers_and_vertices_that_are_not_finite_do_not_matter() {
        let mut mesh = scene("figure");
        let spoil = mesh.positions.len() as u32;
        let far = [Vec3::splat(1e30), Vec3::splat(-2e30), Vec3::splat(f32::MAX)];
        mesh.positions.extend([Vec3::NAN, Vec3::INFINITY]);
        mesh.positions.extend(far);
        mesh.triangles.push([spoil, spoil + 1, 0]);
        mesh.triangles.push([0, spoil, 1]);
        mesh.triangles.push([spoil + 2, spoil + 3, spoil + 4]);
        let camera = Camera::seeing(&mesh);
        assert!(framed(&mesh, &camera) >= 95, "{camera}");
        assert!(camera.eye.length() < 20.0, "{camera}");
    }

    #[test]
    fn small_flat_and_extreme_meshes_are_framed() {
        let single = |corners: [[f32; 3]; 3]| Mesh {
            positions: corners.map(Vec3::from).to_vec(),
            triangles: vec![[0, 1, 2]],
        };
        for corners in [
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            [[5e8, 1.0, 2.0], [5e8, 1.0, 2.0], [5e8, 1.0, 2.0]],
            [[0.0; 3]; 3],
            [[1e-40, 0.0, 0.0], [0.0, 1e-40, 0.0], [0.0, 0.0, 1e-40]],
            [[1e38, 0.0, 0.0], [0.0, 1e38, 0.0], [0.0, 0.0, -1e38]],
            [[f32::MAX; 3], [-f32::MAX; 3], [0.0, f32::MAX, 0.0]],
            // Seen as a line from the first direction tried.
            [[0.0; 3], [0.55, 0.42, 1.0], [0.0, 1.0, 0.0]],
        ] {
            let mesh = single(corners);
            let camera = Camera::seeing(&mesh);
            assert_eq!(framed(&mesh, &camera), 100, "{corners:?}: {camera}");
        }
    }

    #[test]
    fn a_sheet_is_not_seen_edge_on() {
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::new(0.55, 0.42, 1.0), Vec3::Y],
            triangles: vec![[0, 1, 2]],
        };
        let camera = Camera::seeing(&mesh);
        assert!(!is_edge_on(&finite_facets(&mesh)[0], camera.eye.as_dvec3()));
    }

    #[test]
    fn a_mesh_without_usable_triangles_still_has_a_camera() {
        let nothing = Mesh::default();
        let spoilt = Mesh {
            positions: vec![Vec3::NAN],
            triangles: vec![[0, 0, 0], [0, 0, 7]],
        };
        for mesh in [nothing, spoilt] {
            assert_eq!(Camera::seeing(&mesh).validated(), Ok(Camera::seeing(&mesh)));
        }
    }
}
