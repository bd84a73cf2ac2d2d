//! Rays that aim at what goes wrong: vertices, edges, faces of boxes, zero
//! and tiny direction components, extreme distances, lengths and intervals.
//!
//! Everything is drawn in f64 relative to the scene and only then rounded, so
//! that scenes of any scale get rays that meet them. All rays are finite,
//! those of [`RayKind::NonFinite`] excepted.

mod aligned;
mod bounded;
mod directed;
mod exhaustive;
mod non_finite;
mod targets;

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

pub use exhaustive::at_every_vertex;

use crate::{Ray, RaySegment, Triangle};
use targets::Targets;

/// What a set of rays aims at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RayKind {
    /// From around the scene in every direction.
    Random,
    /// Between two points of the scene's box, unbounded.
    Inside,
    /// Exactly towards a vertex: the direction is vertex minus origin.
    ThroughVertices,
    /// Exactly towards a point on an edge, as f32 holds it.
    ThroughEdges,
    /// 1e-8 to 1e-6 of the edge's length beside a point on an edge.
    BesideEdges,
    /// Within a plane through a vertex and along two axes, such as faces of
    /// boxes: one or two direction components are +0 or -0.
    BoxPlanes,
    /// Along an axis towards a point of a triangle, with zeros of both signs.
    AxisParallel,
    /// From a thousand to a million times the scene's extent away.
    FarOrigins,
    /// With a bounded interval that ends or starts near a surface, or on it.
    ShortSegments,
    /// From a point on a triangle: a corner, on an edge, or within.
    OnSurface,
    /// Directions 1e-20 to 1e20 times as long as the way to a triangle.
    ScaledDirections,
    /// Direction components that are all but zero, down to subnormals.
    TinyComponents,
    /// Nearly or exactly within a triangle's plane.
    Grazing,
    /// NaN or infinite in some field, without direction, or with an interval
    /// that is inverted: none of them may hit anything.
    NonFinite,
}

impl RayKind {
    /// Every kind that is finite.
    pub const FINITE: [Self; 13] = [
        Self::Random,
        Self::Inside,
        Self::ThroughVertices,
        Self::ThroughEdges,
        Self::BesideEdges,
        Self::BoxPlanes,
        Self::AxisParallel,
        Self::FarOrigins,
        Self::ShortSegments,
        Self::OnSurface,
        Self::ScaledDirections,
        Self::TinyComponents,
        Self::Grazing,
    ];

    /// A short name for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "around",
            Self::Inside => "inside",
            Self::ThroughVertices => "vertices",
            Self::ThroughEdges => "edges",
            Self::BesideEdges => "beside edges",
            Self::BoxPlanes => "box planes",
            Self::AxisParallel => "axis-parallel",
            Self::FarOrigins => "far origins",
            Self::ShortSegments => "short segments",
            Self::OnSurface => "on surface",
            Self::ScaledDirections => "scaled directions",
            Self::TinyComponents => "tiny components",
            Self::Grazing => "grazing",
            Self::NonFinite => "not finite",
        }
    }

    fn draw(self, targets: &Targets, rng: &mut Pcg64Mcg) -> RaySegment {
        match self {
            Self::Random => directed::random(targets, rng),
            Self::Inside => directed::inside(targets, rng),
            Self::ThroughVertices => directed::through_vertex(targets, rng),
            Self::ThroughEdges => directed::through_edge(targets, rng),
            Self::BesideEdges => directed::beside_edge(targets, rng),
            Self::BoxPlanes => aligned::box_plane(targets, rng),
            Self::AxisParallel => aligned::axis_parallel(targets, rng),
            Self::FarOrigins => directed::far_origin(targets, rng),
            Self::ShortSegments => bounded::short_segment(targets, rng),
            Self::OnSurface => bounded::on_surface(targets, rng),
            Self::ScaledDirections => directed::scaled(targets, rng),
            Self::TinyComponents => aligned::tiny_component(targets, rng),
            Self::Grazing => directed::grazing(targets, rng),
            Self::NonFinite => non_finite::spoiled(directed::random(targets, rng), rng),
        }
    }
}

/// `count` rays of one kind at `triangles`, of which those with non-finite
/// coordinates are no targets. Scenes without any target get rays around the
/// origin.
pub fn rays(
    kind: RayKind,
    triangles: &[Triangle],
    rng: &mut Pcg64Mcg,
    count: usize,
) -> Vec<RaySegment> {
    let targets = Targets::of(triangles);
    (0..count).map(|_| kind.draw(&targets, rng)).collect()
}

/// `count` rays of all finite kinds in turn.
pub fn mixed(triangles: &[Triangle], seed: u64, count: usize) -> Vec<RaySegment> {
    let targets = Targets::of(triangles);
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let kinds = RayKind::FINITE.iter().cycle().take(count);
    kinds.map(|kind| kind.draw(&targets, &mut rng)).collect()
}

/// `count` rays of all finite kinds, and each again from a thousand and from a hundred
/// thousand times its direction further away, where the rounding of hits grows.
pub fn mixed_near_and_far(triangles: &[Triangle], seed: u64, count: usize) -> Vec<RaySegment> {
    let near = mixed(triangles, seed, count);
    let from_afar = |distance: f32| {
        near.iter().map(move |ray| {
            let (origin, direction) = (ray.origin(), ray.direction());
            RaySegment::new(origin - direction * distance, direction)
        })
    };
    let far = from_afar(1e3).chain(from_afar(1e5));
    near.iter().copied().chain(far).collect()
}

/// Tiny scenes, each with rays from so far along an axis that the kernel's shear has no
/// digits left.
pub fn with_subnormal_ratios() -> impl Iterator<Item = (Vec<Triangle>, Vec<RaySegment>)> {
    const SCALES: [i32; 6] = [-30, -36, -42, -48, -54, -60];
    let family = super::families::find("closed-bumpy-sphere").expect("the family is there");
    (0..).zip(SCALES).map(move |(seed, exponent)| {
        let scale = 2.0_f32.powi(exponent);
        let scaled = |triangle: Triangle| {
            let [a, b, c] = triangle.vertices().map(|corner| corner * scale);
            Triangle::new(a, b, c)
        };
        let scene: Vec<Triangle> = family.scene(seed, 300).into_iter().map(scaled).collect();
        let targets = Targets::of(&scene);
        let mut rng = Pcg64Mcg::seed_from_u64(seed);
        let rays = (0..1500).map(|_| aligned::subnormal_ratio(&targets, &mut rng));
        let rays = rays.collect();
        (scene, rays)
    })
}

#[cfg(test)]
mod tests;
