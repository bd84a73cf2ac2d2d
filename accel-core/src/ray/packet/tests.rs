use super::*;
use crate::geometry::Aabb;
use crate::ray::RaySegment;
use crate::simd::{F32x4, InstructionSet, SimdLevel, SimdWork};
use crate::testing::families;
use crate::testing::rays::{self, RayKind};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// Packets of `VECTORS` vectors against boxes: every lane, and the bounds.
struct CompareWithSlabs<'a> {
    rays: &'a [PacketRay],
    boxes: &'a [Aabb],
}

impl CompareWithSlabs<'_> {
    #[inline(always)]
    fn compare<L: Lanes, const VECTORS: usize>(&self) -> usize {
        let mut culled = 0;
        for rays in self.rays.chunks(VECTORS * L::COUNT) {
            let t_max = |index: usize| rays[index].segment().t_max;
            let Some(packet) = RayPacket::<L, VECTORS>::new(rays, t_max) else {
                assert!(rays.iter().all(|ray| ray.prepared().is_none()));
                continue;
            };
            for (index, ray) in rays.iter().enumerate() {
                let (lanes, lane) = (packet.lanes(index / L::COUNT), index % L::COUNT);
                let expected = ray.prepared().map(numbers_of);
                let actual = numbers_in(lanes, lane);
                assert!(
                    expected.is_none_or(|expected| expected == actual),
                    "{ray:?}"
                );
            }
            let packet_bounds = packet.bounds();
            for bounds in self.boxes {
                let plane = |axis: usize, high| {
                    if high {
                        bounds.max[axis]
                    } else {
                        bounds.min[axis]
                    }
                };
                let whole = packet_bounds.slab(bounds);
                for vector in 0..VECTORS {
                    let (near, mask) = packet.meets(vector, plane);
                    for lane in 0..L::COUNT {
                        let met = mask >> lane & 1 == 1;
                        let ray = rays.get(vector * L::COUNT + lane);
                        let Some(ray) = ray.and_then(PacketRay::prepared) else {
                            assert!(!met, "an empty lane meets nothing");
                            continue;
                        };
                        let slab = ray.slab(bounds);
                        let enters = slab.near.max(ray.t_min());
                        let leaves = slab.far.min(ray.t_max());
                        assert_eq!(met, enters <= leaves, "{ray:?} {bounds:?}");
                        assert_eq!(near.lanes()[lane], enters, "{ray:?} {bounds:?}");
                        assert!(
                            !met || (whole.near <= enters && leaves <= whole.far),
                            "{ray:?}"
                        );
                    }
                }
                culled += usize::from(whole.is_empty());
            }
        }
        culled
    }
}

impl SimdWork for CompareWithSlabs<'_> {
    type Output = usize;
    #[inline(always)]
    fn run<I: InstructionSet>(self) -> usize {
        self.compare::<F32x4, 1>()
            + self.compare::<I::Eight, 1>()
            + self.compare::<I::Sixteen, 1>()
            + self.compare::<I::Eight, 8>()
    }
}

/// All that a lane holds, by its bits.
fn numbers_in<L: Lanes>(lanes: &RayLanes<L>, lane: usize) -> [[u32; 3]; 4] {
    let bits = |numbers: &[L; 3]| numbers.map(|number| number.lanes()[lane].to_bits());
    let [x, y] = lanes.shear;
    [
        bits(&lanes.near_reciprocal),
        bits(&lanes.far_reciprocal),
        bits(&[x, y, lanes.along]),
        bits(&[lanes.origin[0], lanes.origin[1], lanes.t_min]),
    ]
}

/// What a lane should hold.
fn numbers_of(ray: &PreparedRay) -> [[u32; 3]; 4] {
    let (shear, origin) = (ray.shear(), ray.origin());
    [
        ray.near_reciprocal().to_array(),
        ray.far_reciprocal().to_array(),
        [shear.x, shear.y, shear.along],
        [origin.x, origin.y, ray.t_min()],
    ]
    .map(|numbers| numbers.map(f32::to_bits))
}

fn packet_rays(rays: &[RaySegment]) -> Vec<PacketRay> {
    rays.iter().map(PacketRay::new).collect()
}

#[test]
fn every_lane_holds_and_meets_what_its_ray_does_and_bounds_contain_all() {
    let scene = families::find("axis-grid").unwrap().scene(1, 200);
    let boxes: Vec<Aabb> = scene.iter().map(|t| Aabb::around(&t.vertices())).collect();
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let mut rays = rays::mixed(&scene, 2, 600);
    rays.extend(rays::rays(RayKind::NonFinite, &scene, &mut random, 40));
    for kind in [
        RayKind::AxisParallel,
        RayKind::BoxPlanes,
        RayKind::TinyComponents,
    ] {
        rays.extend(rays::rays(kind, &scene, &mut random, 192));
    }
    // Rays of one origin and nearly one direction.
    for step in 0..192 {
        let direction = [1.0, step as f32 * 1e-3, 0.5 - step as f32 * 2e-3];
        rays.push(RaySegment::new([-5.0, 0.1, 0.2], direction));
    }
    let rays = packet_rays(&rays);
    for level in SimdLevel::available() {
        let culled = level.run(CompareWithSlabs {
            rays: &rays,
            boxes: &boxes,
        });
        assert!(culled > 1000, "{}: {culled}", level.name());
    }
}

#[test]
fn shared_facts_are_those_of_all_rays() {
    let along = |direction: [f32; 3]| RaySegment::new([1.0, 2.0, 3.0], direction);
    let facts = |rays: &[RaySegment]| {
        let rays = packet_rays(rays);
        let packet = RayPacket::<F32x4, 1>::new(&rays, |_| 1.0);
        *packet.expect("rays that can hit").shared()
    };
    let [first, second] = [along([2.0, -1.0, 0.0]), along([3.0, -0.5, 1.0])];
    let shared = facts(&[first, second]);
    assert_eq!(shared.origin, Some(first.origin));
    assert_eq!(shared.signs, Some([false, true, false]));
    assert_eq!(shared.shear_axis, Some(Axis::X));
    let shared = facts(&[first, along([0.0, 5.0, 0.0])]);
    assert_eq!((shared.signs, shared.shear_axis), (None, None));
    let shared = facts(&[first, RaySegment::new([0.0; 3], second.direction)]);
    assert_eq!((shared.origin, shared.signs.is_some()), (None, true));
}

#[test]
fn lanes_come_lowest_first() {
    assert_eq!(lanes_of(0b1010_0001).collect::<Vec<_>>(), [0, 5, 7]);
    assert_eq!(lanes_of(0).count(), 0);
}
