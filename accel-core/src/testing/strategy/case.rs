//! Drawing a scene with its rays, and shrinking both.

use glam::Vec3;
use proptest::strategy::{NewTree, Strategy, ValueTree};
use proptest::test_runner::TestRunner;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::super::families;
use super::super::random::{log_uniform, sign};
use super::super::rays::mixed;
use super::Scene;
use super::subset::Subset;
use crate::{RaySegment, Triangle};

#[derive(Debug)]
pub(super) struct Cases {
    pub(super) max_triangles: usize,
    pub(super) rays: usize,
}

impl Strategy for Cases {
    type Tree = CaseTree;
    type Value = (Scene, Vec<RaySegment>);

    fn new_tree(&self, runner: &mut TestRunner) -> NewTree<Self> {
        let mut rng = Pcg64Mcg::from_rng(runner.rng());
        let scene = draw_scene(&mut rng, self.max_triangles);
        let rays = mixed(&scene.triangles, rng.random(), self.rays);
        Ok(CaseTree {
            family: scene.family,
            rays: Subset::of(rays),
            triangles: Subset::of(scene.triangles),
            last: Shrunk::Rays,
        })
    }
}

/// Shrinks the rays as far as possible, then the triangles.
#[derive(Debug)]
pub(super) struct CaseTree {
    family: &'static str,
    rays: Subset<RaySegment>,
    triangles: Subset<Triangle>,
    last: Shrunk,
}

#[derive(Clone, Copy, Debug)]
enum Shrunk {
    Rays,
    Triangles,
}

impl ValueTree for CaseTree {
    type Value = (Scene, Vec<RaySegment>);

    fn current(&self) -> Self::Value {
        let scene = Scene {
            family: self.family,
            triangles: self.triangles.current().to_vec(),
        };
        (scene, self.rays.current().to_vec())
    }

    fn simplify(&mut self) -> bool {
        if self.rays.leave_out_more() {
            self.last = Shrunk::Rays;
            return true;
        }
        self.last = Shrunk::Triangles;
        self.triangles.leave_out_more()
    }

    fn complicate(&mut self) -> bool {
        match self.last {
            Shrunk::Rays => self.rays.put_back(),
            Shrunk::Triangles => self.triangles.put_back(),
        }
    }
}

/// Half of the scenes are as large as allowed, the others of any size.
fn draw_scene(rng: &mut Pcg64Mcg, max_triangles: usize) -> Scene {
    let size = if rng.random() {
        max_triangles
    } else {
        rng.random_range(0..=max_triangles)
    };
    let families = families::all();
    match families.get(rng.random_range(0..=families.len())) {
        Some(family) => Scene {
            family: family.name,
            triangles: family.scene(rng.random(), size),
        },
        None => Scene {
            family: "arbitrary",
            triangles: (0..size).map(|_| arbitrary_triangle(rng)).collect(),
        },
    }
}

fn arbitrary_triangle(rng: &mut Pcg64Mcg) -> Triangle {
    let mut corner = || Vec3::from_array([(); 3].map(|()| arbitrary_coordinate(rng)));
    [(); 3].map(|()| corner()).into()
}

/// A finite coordinate: an ordinary one, a small integer, one of any
/// magnitude, of any bits, or of a special value.
fn arbitrary_coordinate(rng: &mut Pcg64Mcg) -> f32 {
    const SPECIAL: [f32; 8] = [
        -0.0,
        f32::MAX,
        f32::MIN,
        f32::MIN_POSITIVE,
        -f32::MIN_POSITIVE,
        f32::from_bits(1),
        1.0 + f32::EPSILON,
        1.0 - f32::EPSILON / 2.0,
    ];
    match rng.random_range(0..16) {
        0..6 => 2.0 * rng.random::<f32>() - 1.0,
        6..11 => rng.random_range(-3..=3) as f32,
        11..13 => sign(rng) * log_uniform(rng, 1e-38, 1e38) as f32,
        13 => {
            let bits = f32::from_bits(rng.random());
            if bits.is_finite() { bits } else { 0.0 }
        }
        _ => SPECIAL[rng.random_range(0..SPECIAL.len())],
    }
}
