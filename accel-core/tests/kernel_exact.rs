//! The triangle kernel against exact rational arithmetic.
//!
//! What is claimed, and why. In the plane across the ray's main axis the kernel
//! sees each vertex, relative to the origin, at a place that is off by at most
//! `5 u M`, with `u` the unit roundoff of `f32` and `M` the largest coordinate of
//! a vertex relative to the origin: one rounding for the difference, three for
//! the shear. On these displaced vertices it decides exactly. So
//! - hit or miss is right for every ray that passes farther than a band of
//!   `8 u M` from every edge;
//! - the hit is a point of the exact plane at most that far aside, so its depth
//!   along the main axis is off by at most `8 u M (1 + g)`, `g` being the slope
//!   of the plane against the axis, and `t` by that over the direction's
//!   component.
//!
//! The default run takes 10,000 cases; the long one takes 10,000,000:
//! `cargo test --release -p accel-core --test kernel_exact -- --ignored`.

use accel_core::geometry::Axis;
use accel_core::glam::Vec3;
use accel_core::{PreparedRay, Primitive, RaySegment, Triangle};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const UNIT_ROUNDOFF: f64 = 1.0 / (1 << 24) as f64;

/// As many cases as `ACCEL_KERNEL_CASES` tells, 10,000 unless it does.
#[test]
fn decisions_are_right_outside_the_band_and_depths_within_their_bound() {
    let cases: usize = std::env::var("ACCEL_KERNEL_CASES")
        .map_or(10_000, |cases| cases.parse().expect("a number of cases"));
    let mut tally = Tally::default();
    for case in 0..cases {
        let mut generator = Pcg64Mcg::seed_from_u64(1 << 32 | case as u64);
        let (triangle, ray) = random_case(&mut generator);
        tally.add(&triangle, &ray);
    }
    // The claim is empty unless most cases are decided, and many hit.
    assert!(tally.hits * 10 > cases, "{tally:?}");
    assert!(tally.in_band * 2 < cases, "{tally:?}");
}

#[derive(Debug, Default)]
struct Tally {
    hits: usize,
    misses: usize,
    in_band: usize,
    /// The largest error of a depth, in units of its bound.
    worst_depth: f64,
}

impl Tally {
    fn add(&mut self, triangle: &Triangle, ray: &RaySegment) {
        let prepared = PreparedRay::new(ray).expect("cases are finite");
        let found = triangle.intersect(&prepared);
        let exact = Exact::new(triangle, ray);
        if exact.distance_from_edges() <= 8.0 * UNIT_ROUNDOFF * exact.reach {
            self.in_band += 1;
            return;
        }
        assert_eq!(found.is_some(), exact.is_hit(), "{triangle:?} {ray:?}");
        let Some(found) = found else {
            self.misses += 1;
            return;
        };
        self.hits += 1;
        let bound = 8.0 * UNIT_ROUNDOFF * exact.reach * (1.0 + exact.slope());
        let depth = f64::from(found.t) * exact.along;
        let error = (depth - exact.depth()).abs() / bound;
        assert!(
            error <= 1.0,
            "depth off by {error} bounds: {triangle:?} {ray:?}"
        );
        self.worst_depth = self.worst_depth.max(error);
    }
}

/// The triangle relative to the ray's origin and sheared onto its main axis, in
/// rational numbers.
struct Exact {
    x: [BigRational; 3],
    y: [BigRational; 3],
    z: [BigRational; 3],
    /// The direction's component along the main axis.
    along: f64,
    /// The largest coordinate of a vertex relative to the origin.
    reach: f64,
}

fn rational(x: f32) -> BigRational {
    BigRational::from_float(x).expect("cases are finite")
}

impl Exact {
    fn new(triangle: &Triangle, ray: &RaySegment) -> Self {
        let axis = Axis::largest(ray.direction);
        let direction = axis.rotate_last(ray.direction).to_array().map(rational);
        let origin = axis.rotate_last(ray.origin).to_array().map(rational);
        let relative = triangle.vertices().map(|vertex| {
            let [x, y, z] = axis.rotate_last(vertex).to_array().map(rational);
            [x - &origin[0], y - &origin[1], z - &origin[2]]
        });
        let [shear_x, shear_y] = [0, 1].map(|i| &direction[i] / &direction[2]);
        let largest = relative
            .iter()
            .flatten()
            .map(|c| to_f64(c).abs())
            .fold(0.0, f64::max);
        Self {
            x: relative.each_ref().map(|[x, _, z]| x - &shear_x * z),
            y: relative.each_ref().map(|[_, y, z]| y - &shear_y * z),
            z: relative.map(|[_, _, z]| z),
            along: to_f64(&direction[2]),
            reach: largest,
        }
    }

    /// Twice the signed areas opposite to each vertex.
    fn edges(&self) -> [BigRational; 3] {
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &self.x[j] * &self.y[i] - &self.y[j] * &self.x[i])
    }

    fn is_hit(&self) -> bool {
        let edges = self.edges();
        let determinant: BigRational = edges.iter().sum();
        let one_sign =
            edges.iter().all(|e| !e.is_negative()) || edges.iter().all(|e| !e.is_positive());
        one_sign && !determinant.is_zero()
    }

    /// How far the ray passes from the nearest edge line, or from degeneracy.
    fn distance_from_edges(&self) -> f64 {
        let edges = self.edges();
        let lengths = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
            let (dx, dy) = (&self.x[i] - &self.x[j], &self.y[i] - &self.y[j]);
            to_f64(&(&dx * &dx + &dy * &dy)).sqrt()
        });
        let distances = edges.iter().zip(lengths).map(|(edge, length)| {
            if length > 0.0 {
                to_f64(edge).abs() / length
            } else {
                0.0
            }
        });
        distances.fold(f64::INFINITY, f64::min)
    }

    fn depth(&self) -> f64 {
        let edges = self.edges();
        let determinant: BigRational = edges.iter().sum();
        let sum: BigRational = edges.iter().zip(&self.z).map(|(edge, z)| edge * z).sum();
        to_f64(&(sum / determinant))
    }

    /// How steeply the plane's depth rises across the ray's main axis.
    fn slope(&self) -> f64 {
        let side = |c: &[BigRational; 3], i: usize| &c[i] - &c[0];
        let cross = |a: &[BigRational; 3], b: &[BigRational; 3]| {
            to_f64(&(side(a, 1) * side(b, 2) - side(a, 2) * side(b, 1)))
        };
        let normal_z = cross(&self.x, &self.y);
        cross(&self.y, &self.z).hypot(cross(&self.z, &self.x)) / normal_z.abs()
    }
}

fn to_f64(x: &BigRational) -> f64 {
    x.to_f64().expect("a rational has a nearest f64")
}

/// Triangles of all shapes and scales, and rays at them, many near edges.
fn random_case(generator: &mut Pcg64Mcg) -> (Triangle, RaySegment) {
    let scale = 2.0_f32.powi(generator.random_range(-40..40));
    let offset = point(generator) * [0.0, 0.0, 1.0, 1000.0][generator.random_range(0..4)];
    let mut corners = [(); 3].map(|()| point(generator));
    if generator.random_bool(0.3) {
        // A sliver: the third corner close to the line of the first two.
        let thinness = 10.0_f32.powi(generator.random_range(-6..0));
        let along = generator.random_range(0.0..1.0);
        corners[2] = corners[0].lerp(corners[1], along) + point(generator) * thinness;
    }
    if generator.random_bool(0.2) {
        corners = corners.map(|corner| (corner * 4.0).round());
    }
    let triangle = Triangle::from(corners.map(|corner| (corner + offset) * scale));
    let target = target(&triangle, generator);
    let distance = 10.0_f32.powf(generator.random_range(-2.0..4.0)) * scale;
    let origin = target + point(generator) * distance;
    let direction = (target - origin) * 10.0_f32.powi(generator.random_range(-3..4));
    if direction == Vec3::ZERO || !direction.is_finite() {
        return (triangle, RaySegment::new(origin, Vec3::X));
    }
    (triangle, RaySegment::new(origin, direction))
}

/// A point in the triangle, near one of its edges, or somewhere about it.
fn target(triangle: &Triangle, generator: &mut Pcg64Mcg) -> Vec3 {
    let (mut u, mut v): (f32, f32) = (generator.random(), generator.random());
    match generator.random_range(0..4) {
        0 => v = 10.0_f32.powi(generator.random_range(-7..0)),
        1 => (u, v) = (u * 3.0 - 1.0, v * 3.0 - 1.0),
        _ if u + v > 1.0 => (u, v) = (1.0 - u, 1.0 - v),
        _ => {}
    }
    triangle.a + (triangle.b - triangle.a) * u + (triangle.c - triangle.a) * v
}

fn point(generator: &mut Pcg64Mcg) -> Vec3 {
    Vec3::from([(); 3].map(|()| generator.random_range(-1.0_f32..1.0)))
}
