//! The agreement check: a structure against brute force, bit for bit.

use std::fmt;

use crate::build::InvalidPrimitives;
use crate::error::BuildError;
use crate::layout::TriangleBlocks;
use crate::query::Hit;
use crate::ray::RaySegment;
use crate::{AccelerationStructure, BruteForce, Triangle};

/// Brute force over triangles, sixteen at a time; invalid ones are left out.
pub type Oracle = BruteForce<Triangle, TriangleBlocks>;

/// What brute force answers to rays: computed once, compared with many
/// structures.
#[derive(Clone, Debug)]
pub struct Expected {
    /// The rays.
    pub rays: Vec<RaySegment>,
    answers: Vec<Answers>,
}

/// The answers of all queries to one ray.
#[derive(Clone, Debug, PartialEq)]
struct Answers {
    closest: Option<HitBits>,
    any: bool,
    all: Vec<HitBits>,
}

/// A hit, compared bit for bit.
pub(super) type HitBits = (u32, u32, u32, u32);

/// A ray that a structure answers differently from brute force.
#[derive(Clone, Debug)]
pub struct Disagreement {
    /// Which of the rays.
    pub index: usize,
    /// The ray.
    pub ray: RaySegment,
    /// Which query: "closest hit", "any hit" or "all hits".
    pub query: &'static str,
    /// Brute force's answer.
    pub expected: String,
    /// The structure's answer.
    pub actual: String,
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} of ray {} ({:?}): expected {}, got {}",
            self.query, self.index, self.ray, self.expected, self.actual
        )
    }
}

/// The oracle over `triangles`.
///
/// # Errors
/// As [`BruteForce::with_storage`].
pub fn oracle(triangles: &[Triangle]) -> Result<Oracle, BuildError> {
    Oracle::with_storage(triangles, InvalidPrimitives::Skip)
}

impl Expected {
    /// Brute force's answers to `rays`.
    ///
    /// # Errors
    /// As [`oracle`].
    pub fn new(triangles: &[Triangle], rays: Vec<RaySegment>) -> Result<Self, BuildError> {
        Ok(Self::by(&oracle(triangles)?, rays))
    }

    /// What `structure` answers to `rays`, one by one.
    pub fn by<A: AccelerationStructure>(structure: &A, rays: Vec<RaySegment>) -> Self {
        let answers = rays.iter().map(|ray| Answers::of(structure, ray)).collect();
        Self { rays, answers }
    }

    /// All hits of ray `index`, sorted.
    pub(super) fn all_hits(&self, index: usize) -> &[HitBits] {
        &self.answers[index].all
    }

    /// How many rays hit anything.
    pub fn hits(&self) -> usize {
        self.answers.iter().filter(|answers| answers.any).count()
    }

    /// The rays that `structure` answers differently: closest hit, any hit, all
    /// hits.
    pub fn disagreements<A: AccelerationStructure>(&self, structure: &A) -> Vec<Disagreement> {
        self.rays
            .iter()
            .zip(&self.answers)
            .enumerate()
            .filter_map(|(index, (ray, expected))| {
                let actual = Answers::of(structure, ray);
                let (query, expected, actual) = expected.difference(&actual)?;
                Some(Disagreement {
                    index,
                    ray: *ray,
                    query,
                    expected,
                    actual,
                })
            })
            .collect()
    }
}

impl Answers {
    fn of<A: AccelerationStructure>(structure: &A, ray: &RaySegment) -> Self {
        Self {
            closest: structure.closest_hit(ray).as_ref().map(bits),
            any: structure.any_hit(ray),
            all: structure.all_hits(ray).iter().map(bits).collect(),
        }
    }

    fn difference(&self, actual: &Self) -> Option<(&'static str, String, String)> {
        let show = |a: &dyn fmt::Debug, b: &dyn fmt::Debug| (format!("{a:?}"), format!("{b:?}"));
        let (query, (expected, actual)) = if self.closest != actual.closest {
            ("closest hit", show(&self.closest, &actual.closest))
        } else if self.any != actual.any {
            ("any hit", show(&self.any, &actual.any))
        } else if self.all != actual.all {
            ("all hits", show(&self.all, &actual.all))
        } else {
            return None;
        };
        Some((query, expected, actual))
    }
}

pub(super) fn bits(hit: &Hit) -> HitBits {
    (hit.t.to_bits(), hit.id, hit.u.to_bits(), hit.v.to_bits())
}
