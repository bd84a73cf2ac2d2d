//! Rays that break acceleration structures.

use glam::Vec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::{cube_point, direction};
use crate::geometry::{Aabb, Axis};
use crate::primitive::Primitive;
use crate::{RaySegment, Triangle};

/// A kind of rays at a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RayFamily {
    /// Between points on a sphere around the scene.
    Random,
    /// From points in the scene's box, anywhere.
    Inside,
    /// Exactly towards vertices.
    ThroughVertices,
    /// Exactly towards points of edges.
    ThroughEdges,
    /// 1e-8 to 1e-6 of the edge's length beside edges.
    BesideEdges,
    /// In the planes of triangles' boxes, with zero components of either sign.
    BoxPlanes,
    /// Along an axis, through vertices or middles.
    AxisParallel,
    /// From a thousand to a million scene sizes away.
    FarOrigins,
    /// With short intervals, of which triangles may touch the ends.
    ShortSegments,
    /// From points of triangles.
    OnSurface,
    /// With tiny direction components, and directions of all lengths.
    OddDirections,
}

impl RayFamily {
    /// All kinds.
    pub const ALL: [Self; 11] = [
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
        Self::OddDirections,
    ];

    /// A name for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Random => "sphere",
            Self::Inside => "inside",
            Self::ThroughVertices => "vertices",
            Self::ThroughEdges => "edges",
            Self::BesideEdges => "beside edges",
            Self::BoxPlanes => "box planes",
            Self::AxisParallel => "axis-parallel",
            Self::FarOrigins => "far origins",
            Self::ShortSegments => "short",
            Self::OnSurface => "on surface",
            Self::OddDirections => "odd directions",
        }
    }
}

/// `count` rays of one kind. Triangles that are not finite are no targets. All
/// rays are finite, with a direction.
pub fn rays(family: RayFamily, triangles: &[Triangle], seed: u64, count: usize) -> Vec<RaySegment> {
    let mut aim = Aim::new(triangles, seed ^ (family as u64) << 40);
    (0..count).map(|_| aim.finite_ray(family)).collect()
}

/// `count` rays of all kinds in turn.
pub fn mixed(triangles: &[Triangle], seed: u64, count: usize) -> Vec<RaySegment> {
    let mut aim = Aim::new(triangles, seed);
    let kinds = RayFamily::ALL.into_iter().cycle().take(count);
    kinds.map(|family| aim.finite_ray(family)).collect()
}

/// Rays that can hit nothing: a NaN or an infinity somewhere, no direction, no
/// interval.
pub fn without_answer() -> Vec<RaySegment> {
    let good = RaySegment::new([0.1, 0.2, -5.0], [0.01, 0.02, 1.0]);
    let mut rays = vec![
        RaySegment {
            direction: Vec3::ZERO,
            ..good
        },
        RaySegment {
            direction: -Vec3::ZERO,
            ..good
        },
        good.with_interval(2.0, 1.0),
        good.with_interval(f32::NAN, 1.0),
        good.with_interval(0.0, f32::NAN),
        good.with_interval(0.0, -1.0),
    ];
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for axis in 0..3 {
            let mut bad = [good; 2];
            bad[0].origin[axis] = value;
            bad[1].direction[axis] = value;
            rays.extend(bad);
        }
    }
    rays
}

/// A scene to aim at.
struct Aim {
    targets: Vec<Triangle>,
    bounds: Aabb,
    random: Pcg64Mcg,
}

impl Aim {
    fn new(triangles: &[Triangle], seed: u64) -> Self {
        let is_valid = |triangle: &&Triangle| triangle.bounds().is_valid();
        let targets: Vec<Triangle> = triangles.iter().filter(is_valid).copied().collect();
        let around = |all: Aabb, triangle: &Triangle| all.union(&triangle.bounds());
        let bounds = targets.iter().fold(Aabb::EMPTY, around);
        let bounds = if targets.is_empty() {
            Aabb::new([-1.0; 3], [1.0; 3])
        } else {
            bounds
        };
        Self {
            targets,
            bounds,
            random: Pcg64Mcg::seed_from_u64(seed),
        }
    }

    /// A ray of the family, or if it overflows some other one.
    fn finite_ray(&mut self, family: RayFamily) -> RaySegment {
        for _ in 0..8 {
            let ray = self.ray(family);
            let is_finite = ray.origin.is_finite() && ray.direction.is_finite();
            if is_finite && ray.direction != Vec3::ZERO {
                return ray;
            }
        }
        RaySegment::new(self.bounds.center(), direction(&mut self.random))
    }

    fn ray(&mut self, family: RayFamily) -> RaySegment {
        let size = self.size();
        let outside = self.bounds.center() + direction(&mut self.random) * size;
        let triangle = self.triangle();
        let corner = self.random.random_range(0..3);
        let [from, to] = [corner, (corner + 1) % 3].map(|i| triangle.vertices()[i]);
        let on_edge = from.lerp(to, self.random.random());
        let at = |target: Vec3| RaySegment::new(outside, target - outside);
        match family {
            RayFamily::Random => at(self.bounds.center() + direction(&mut self.random) * size),
            RayFamily::Inside => RaySegment::new(self.inside(), direction(&mut self.random)),
            RayFamily::ThroughVertices => at(from),
            RayFamily::ThroughEdges => at(on_edge),
            RayFamily::BesideEdges => {
                let exponent = self.random.random_range(-8.0_f32..-6.0);
                let aside = cube_point(&mut self.random) * 10.0_f32.powf(exponent);
                at(on_edge + aside * from.distance(to))
            }
            RayFamily::BoxPlanes => self.in_box_plane(&triangle, outside),
            RayFamily::AxisParallel => self.along_axis(&triangle, from),
            RayFamily::FarOrigins => {
                let distance = 10.0_f32.powf(self.random.random_range(3.0..6.0)) * size;
                let origin = self.bounds.center() + direction(&mut self.random) * distance;
                let inside = self.inside();
                let target = [from, on_edge, inside][self.random.random_range(0..3)];
                RaySegment::new(origin, target - origin)
            }
            RayFamily::ShortSegments => {
                let [start, end] =
                    [(); 2].map(|()| [0.0, 0.5, 1.0, 1.5][self.random.random_range(0..4)]);
                at(on_edge).with_interval(start, start + end)
            }
            RayFamily::OnSurface => RaySegment::new(on_edge, direction(&mut self.random)),
            RayFamily::OddDirections => self.oddly(at(on_edge)),
        }
    }

    /// A radius around the scene, at least the smallest normal number.
    fn size(&self) -> f32 {
        (self.bounds.extent().length() as f32).clamp(f32::MIN_POSITIVE, f32::MAX / 4.0)
    }

    fn triangle(&mut self) -> Triangle {
        if self.targets.is_empty() {
            return Triangle::from([Vec3::X, Vec3::Y, Vec3::Z]);
        }
        self.targets[self.random.random_range(0..self.targets.len())]
    }

    fn inside(&mut self) -> Vec3 {
        let weight = Vec3::from([(); 3].map(|()| self.random.random::<f32>()));
        self.bounds.min * (Vec3::ONE - weight) + self.bounds.max * weight
    }

    fn signed_zero(&mut self) -> f32 {
        if self.random.random() { 0.0 } else { -0.0 }
    }

    /// In one, two or three planes of a triangle's box: a corner's coordinate as
    /// origin and a zero as direction.
    fn in_box_plane(&mut self, triangle: &Triangle, outside: Vec3) -> RaySegment {
        let bounds = triangle.bounds();
        let corner = bounds.corner([(); 3].map(|()| self.random.random()));
        let inside = self.inside();
        let mut ray = RaySegment::new(outside, inside - outside);
        let first = self.random.random_range(0..3);
        for axis in [first, (first + self.random.random_range(0..3)) % 3] {
            ray.origin[axis] = corner[axis];
            ray.direction[axis] = self.signed_zero();
        }
        ray
    }

    fn along_axis(&mut self, triangle: &Triangle, vertex: Vec3) -> RaySegment {
        let axis = Axis::ALL[self.random.random_range(0..3)].index();
        let middle = triangle.bounds().center();
        let mut origin = if self.random.random() { vertex } else { middle };
        let size = self.size();
        let forward: bool = self.random.random();
        origin[axis] = self.bounds.center()[axis] + if forward { -size } else { size };
        let mut direction = Vec3::from([(); 3].map(|()| self.signed_zero()));
        direction[axis] = if forward { 1.0 } else { -1.0 };
        RaySegment::new(origin, direction)
    }

    /// The same ray with a direction of another length, or nearly along an axis.
    fn oddly(&mut self, ray: RaySegment) -> RaySegment {
        let length = 10.0_f32.powi(self.random.random_range(-20..20));
        let mut direction = ray.direction.normalize_or_zero() * length;
        if self.random.random() {
            let tiny = [1e-30, -1e-30, 1e-40, -1e-40, 1e-7, -0.0][self.random.random_range(0..6)];
            direction[self.random.random_range(0..3)] = tiny;
        }
        RaySegment { direction, ..ray }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PreparedRay;
    use crate::testing::families;

    #[test]
    fn rays_at_every_scene_can_be_traced_and_the_others_cannot() {
        for family in families::all() {
            for kind in RayFamily::ALL {
                for ray in rays(kind, &family.scene(1, 50), 2, 20) {
                    assert!(
                        PreparedRay::new(&ray).is_some(),
                        "{} {kind:?} {ray:?}",
                        family.name
                    );
                }
            }
        }
        for ray in without_answer() {
            assert!(PreparedRay::new(&ray).is_none(), "{ray:?}");
        }
    }

    #[test]
    fn most_aimed_rays_hit_an_ordinary_scene() {
        let scene = families::find("soup-dense").unwrap().scene(1, 200);
        let expected =
            super::super::agreement::Expected::new(&scene, mixed(&scene, 3, 1100)).unwrap();
        assert!(expected.hits() > 500, "{}", expected.hits());
    }
}
