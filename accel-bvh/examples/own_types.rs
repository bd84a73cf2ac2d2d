//! A renderer's own ray and primitive types, with one dependency: accel-bvh.

use accel_bvh::glam::Vec3;
use accel_bvh::{
    Aabb, AccelerationStructure, BuildError, BvhBuilder, Hit, Intersection, LeafOrdered,
    PreparedRay, Primitive, Ray, RaySegment, Sphere, TraversalCounters, Triangle,
};

/// The renderer's ray.
struct CameraRay {
    from: Vec3,
    towards: Vec3,
    wavelength_nanometres: f32,
}

impl Ray for CameraRay {
    fn origin(&self) -> Vec3 {
        self.from
    }
    fn direction(&self) -> Vec3 {
        self.towards
    }
}

/// The renderer's primitive: a horizontal disc.
#[derive(Clone)]
struct Disc {
    center: Vec3,
    radius: f32,
}

impl Primitive for Disc {
    type Storage = LeafOrdered<Self>;

    fn bounds(&self) -> Aabb {
        let reach = Vec3::new(self.radius, 0.0, self.radius);
        Aabb::new(self.center - reach, self.center + reach)
    }

    fn intersect(&self, ray: &PreparedRay) -> Option<Intersection> {
        let t = (self.center.y - ray.origin().y) / ray.direction().y;
        let inside = (ray.at(t) - self.center).length_squared() <= self.radius * self.radius;
        inside.then_some(Intersection { t, u: 0.0, v: 0.0 })
    }

    fn geometric_normal(&self, _: &Hit, _: Vec3) -> Vec3 {
        Vec3::Y
    }
}

fn main() -> Result<(), BuildError> {
    let down = CameraRay {
        from: Vec3::new(0.1, 9.0, 0.1),
        towards: Vec3::NEG_Y,
        wavelength_nanometres: 550.0,
    };
    assert!(down.wavelength_nanometres > 0.0);

    // Own triangles.
    let triangles =
        [0.0, 1.0].map(|y| Triangle::new([-1.0, y, -1.0], [3.0, y, -1.0], [-1.0, y, 3.0]));
    let bvh = BvhBuilder::default().build(&triangles)?;
    let hit = bvh.closest_hit(&down).expect("both triangles lie below");
    assert_eq!((hit.id, hit.t), (1, 8.0));

    // Skip the primitive that a ray starts on; cull backfaces.
    let next = bvh.closest_hit_where(&down, |other| other.id != hit.id);
    assert_eq!(next.map(|hit| hit.id), Some(0));
    let front = bvh.closest_hit_where(&down, |hit| bvh.is_front(&down, hit));
    assert_eq!(front, None, "both triangles turn their backs upwards");

    // A bounce: normal, side and a safe origin come with the hit.
    let surface = bvh.surface(&down, &hit).expect("the hit is of this tree");
    let bounce = RaySegment::new(surface.origin_towards(Vec3::Y), [0.0, 1.0, 0.0]);
    assert!(
        !bvh.any_hit(&bounce),
        "the bounce does not meet the surface it leaves"
    );

    // Spheres, counting what the traversal does.
    let spheres: Vec<Sphere> = (0..100)
        .map(|i| Sphere::new([i as f32 * 3.0, 0.0, 0.0], 1.0))
        .collect();
    let bvh = BvhBuilder::default().build(&spheres)?;
    let mut counters = TraversalCounters::default();
    let hit = bvh.closest_hit_with(&down, &mut counters);
    assert_eq!(hit.map(|hit| hit.id), Some(0));
    assert!(
        counters.primitive_tests.sum < 10,
        "99 of 100 spheres are far off"
    );

    // The renderer's own primitives.
    let discs: Vec<Disc> = (0..10)
        .map(|i| Disc {
            center: Vec3::Y * i as f32 * 0.5,
            radius: 1.0,
        })
        .collect();
    let bvh = BvhBuilder::default().build(&discs)?;
    let hits = bvh.all_hits(&down);
    assert_eq!(hits.len(), 10);
    assert_eq!(hits[0].id, 9);
    Ok(())
}
