//! Choosing a camera for a mesh that has none.
//!
//! Candidates frame the robust bounds of the triangles from outside in
//! three-quarter views. The largest triangles tell how many of a sample of
//! triangles each candidate sees: if walls hide most of them from everywhere
//! outside, candidates inside the bounds are tried as well.

use std::array;

use accel_core::glam::{DVec3, Vec3};

use super::{Camera, Frame};
use crate::scene::Mesh;

/// Triangles whose centres a candidate should see.
const SAMPLES: usize = 96;
/// The largest triangles, which may hide them.
const OCCLUDERS: usize = 2048;
/// One triangle in so many may be outside of the robust bounds on each side.
const OUTLIERS: usize = 100;
/// An outside view that sees less of the samples, in percent, may be before the
/// walls of a room: of a closed convex object it sees a half.
const OPEN: usize = 40;
/// How much an inside view has to see, in percent of what the outside view does.
const WITHIN: usize = 150;
/// The picture's width over its height that candidates are judged by.
const ASPECT: [u32; 2] = [4, 3];

pub(super) fn camera_seeing(mesh: &Mesh) -> Camera {
    let Some(bounds) = Bounds::robust(mesh) else {
        return outside(&Bounds::UNIT, OUTSIDE[0]);
    };
    let scene = Sample::new(mesh, &bounds);
    let views = OUTSIDE.map(|direction| outside(&bounds, direction));
    let (camera, seen) = scene.best_of(&views);
    if seen * 100 >= OPEN * scene.samples.len() {
        return camera;
    }
    let (within, seen_within) = scene.best_of(&inside(&bounds));
    if seen_within * 100 > WITHIN * seen {
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
#[derive(Clone, Copy, PartialEq)]
struct Facet {
    corners: [DVec3; 3],
    center: DVec3,
    /// The length of its longest edge.
    extent: f64,
}

impl Facet {
    /// `None` if a corner is not finite.
    fn of(mesh: &Mesh, triangle: [u32; 3]) -> Option<Self> {
        let position = |index: u32| mesh.positions.get(index as usize).copied();
        let corners = triangle.map(|index| position(index).unwrap_or(Vec3::NAN).as_dvec3());
        let [a, b, c] = corners;
        let is_finite = corners.iter().all(|corner| corner.is_finite());
        is_finite.then(|| Self {
            corners,
            center: (a + b + c) / 3.0,
            extent: a.distance(b).max(b.distance(c)).max(c.distance(a)),
        })
    }
}

/// The facets of a mesh, made anew each time: large meshes have too many to keep.
fn finite_facets(mesh: &Mesh) -> impl Iterator<Item = Facet> {
    let facet = |&triangle: &[u32; 3]| Facet::of(mesh, triangle);
    mesh.triangles.iter().filter_map(facet)
}

/// The box of the middle 98 % of the centres on each axis.
struct Bounds {
    center: DVec3,
    half: DVec3,
    /// The median extent of the triangles.
    usual: f64,
    /// Of a ball around the centre that holds the box and a usual triangle; never
    /// 0.
    radius: f64,
}

impl Bounds {
    const UNIT: Self = Self {
        center: DVec3::ZERO,
        half: DVec3::ONE,
        usual: 0.0,
        radius: 1.0,
    };

    /// `None` if no triangle is finite.
    fn robust(mesh: &Mesh) -> Option<Self> {
        let mut values: Vec<f64> = finite_facets(mesh).map(|facet| facet.extent).collect();
        let last = values.len().checked_sub(1)?;
        let usual = nth(&mut values, last / 2);
        let outermost = values.len() / OUTLIERS;
        let (mut low, mut high) = (DVec3::ZERO, DVec3::ZERO);
        for axis in 0..3 {
            let along = finite_facets(mesh).map(|facet| facet.center[axis]);
            values.clear();
            values.extend(along);
            low[axis] = nth(&mut values, outermost);
            high[axis] = nth(&mut values, last - outermost);
        }
        let (center, half) = ((low + high) / 2.0, (high - low) / 2.0);
        // A point far away still needs an eye that differs from it in f32.
        let least = center.abs().max_element() * 1e-4;
        let radius = (half.length() + usual * 0.5).max(least);
        Some(Self {
            center,
            half,
            usual,
            radius: if radius > 0.0 { radius } else { 1.0 },
        })
    }
}

fn nth(values: &mut [f64], n: usize) -> f64 {
    *values.select_nth_unstable_by(n, f64::total_cmp).1
}

/// Some of the triangles within the bounds, and the largest of all, which may
/// hide them.
struct Sample {
    samples: Vec<Facet>,
    occluders: Vec<Facet>,
}

impl Sample {
    fn new(mesh: &Mesh, bounds: &Bounds) -> Self {
        let is_within = |facet: &Facet| {
            let from_center = (facet.center - bounds.center).abs();
            from_center.cmple(bounds.half * (1.0 + 1e-9)).all()
        };
        let within = finite_facets(mesh).filter(is_within).count();
        let samples = finite_facets(mesh)
            .filter(is_within)
            .step_by(within.div_ceil(SAMPLES).max(1));
        let mut extents: Vec<f64> = finite_facets(mesh).map(|facet| facet.extent).collect();
        let rank = extents.len().saturating_sub(OCCLUDERS);
        let least = nth(&mut extents, rank);
        let occluders = finite_facets(mesh).filter(|facet| facet.extent >= least);
        Self {
            samples: samples.collect(),
            // Of many equally large ones, any will do.
            occluders: occluders.take(OCCLUDERS).collect(),
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
        let is_seen = |facet: &&Facet| {
            let in_frame = frame.project(facet.center.as_vec3());
            in_frame.is_some_and(|[x, y]| x.abs() <= 1.0 && y.abs() <= 1.0)
                && !is_edge_on(facet, eye)
                && !self.is_hidden(facet, eye)
        };
        self.samples.iter().filter(is_seen).count()
    }

    fn is_hidden(&self, facet: &Facet, eye: DVec3) -> bool {
        let to = facet.center - eye;
        let mut others = self.occluders.iter().filter(|&other| other != facet);
        others.any(|other| is_between(&other.corners, eye, to))
    }
}

/// Whether a triangle is seen as a line. One without area looks alike from
/// everywhere, and speaks against no view.
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

/// A view from `direction`, as near as all corners of the bounds are in a square
/// picture.
fn outside(bounds: &Bounds, direction: [f64; 3]) -> Camera {
    let degrees: f32 = 45.0;
    let towards = DVec3::from(direction).normalize();
    let frame = Frame::new(&Camera::upright(towards.as_vec3(), [0.0; 3], degrees), 1, 1);
    let needed = corners(bounds.half * 1.1 + bounds.usual / 2.0).map(|corner| {
        let reach = |half: DVec3| corner.dot(half).abs() / half.length_squared();
        reach(frame.right).max(reach(frame.up)) - corner.dot(frame.forward)
    });
    let distance = needed.into_iter().fold(bounds.radius, f64::max);
    let eye = bounds.center + towards * distance;
    Camera::upright(rounded(eye), rounded(bounds.center), degrees)
}

/// The corners of a box around the origin.
fn corners(half: DVec3) -> [DVec3; 8] {
    array::from_fn(|i| {
        let side = |bit: usize| if i & bit == 0 { -1.0 } else { 1.0 };
        half * DVec3::new(side(1), side(2), side(4))
    })
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
        let facets: Vec<_> = finite_facets(mesh).collect();
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
        assert!(!is_edge_on(
            &finite_facets(&mesh).next().unwrap(),
            camera.eye.as_dvec3()
        ));
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
