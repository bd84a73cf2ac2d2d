//! One call that checks a structure on every scene family.

use std::fmt;

use super::agreement::{Disagreement, Expected};
use super::families::{self, Family};
use super::rays;
use crate::build::join;
use crate::error::BuildError;
use crate::{AccelerationStructure, Triangle};

/// How much to check.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Scenes per family at the small size, each from a seed of its own.
    pub seeds: u64,
    /// The small size, in triangles; some seeds take a half or a quarter of it.
    pub triangles: usize,
    /// Rays per small scene.
    pub rays: usize,
    /// Rays per scene at the family's full size, of which there is one; none if
    /// this is 0.
    pub full_size_rays: usize,
}

impl Default for Effort {
    /// 24 small scenes of at most 2,000 triangles with 200 rays each, and one of
    /// full size with 16 rays, per family.
    fn default() -> Self {
        Self {
            seeds: 24,
            triangles: 2000,
            rays: 200,
            full_size_rays: 16,
        }
    }
}

/// What was checked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Checked {
    /// Scene families.
    pub families: usize,
    /// Scenes.
    pub scenes: usize,
    /// Rays.
    pub rays: usize,
    /// Rays that hit something.
    pub hits: usize,
}

/// A scene that a structure does not handle as brute force does.
#[derive(Clone, Debug)]
pub struct FamilyFailure {
    /// The family's name.
    pub family: &'static str,
    /// The seed of the scene.
    pub seed: u64,
    /// The size asked for, in triangles.
    pub triangles: usize,
    /// What went wrong.
    pub problem: Problem,
}

/// What went wrong with a scene.
#[derive(Clone, Debug)]
pub enum Problem {
    /// The structure was not built.
    Build(BuildError),
    /// Rays are answered differently; the first of them.
    Disagreement(usize, Box<Disagreement>),
}

impl fmt::Display for FamilyFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            family,
            seed,
            triangles,
            problem,
        } = self;
        write!(f, "family {family}, seed {seed}, {triangles} triangles: ")?;
        match problem {
            Problem::Build(error) => write!(f, "{error}"),
            Problem::Disagreement(count, first) => {
                write!(
                    f,
                    "{count} rays are answered differently; the first: {first}"
                )
            }
        }
    }
}

/// Checks the structures that `build` makes of a scene against brute force on
/// every scene family: closest hit, any hit and all hits of every kind of ray,
/// equal in every bit. `build` must leave invalid primitives out. Brute force's
/// answers are computed once for all structures.
///
/// # Errors
/// A scene that fails, reproducible from its family, seed and size.
pub fn check_families<A, B>(effort: &Effort, build: B) -> Result<Checked, FamilyFailure>
where
    A: AccelerationStructure,
    B: Fn(&[Triangle]) -> Result<Vec<A>, BuildError> + Sync,
{
    check_part(families::all(), effort, &build)
}

/// Checks some families, on all cores.
fn check_part<A, B>(
    families: &[Family],
    effort: &Effort,
    build: &B,
) -> Result<Checked, FamilyFailure>
where
    A: AccelerationStructure,
    B: Fn(&[Triangle]) -> Result<Vec<A>, BuildError> + Sync,
{
    match families {
        [] => Ok(Checked::default()),
        [family] => check_family(family, effort, build),
        _ => {
            let (left, right) = families.split_at(families.len() / 2);
            let (left, right) = join(
                || check_part(left, effort, build),
                || check_part(right, effort, build),
            );
            Ok(left?.plus(right?))
        }
    }
}

fn check_family<A, B>(family: &Family, effort: &Effort, build: &B) -> Result<Checked, FamilyFailure>
where
    A: AccelerationStructure,
    B: Fn(&[Triangle]) -> Result<Vec<A>, BuildError>,
{
    let mut checked = Checked {
        families: 1,
        ..Checked::default()
    };
    let full_size_scenes = u64::from(effort.full_size_rays > 0);
    for seed in 0..effort.seeds + full_size_scenes {
        // The last scene is the one at full size.
        let (triangles, rays) = if seed < effort.seeds {
            let triangles = effort.triangles >> (seed % 3);
            (triangles.min(family.full_size), effort.rays)
        } else {
            (family.full_size, effort.full_size_rays)
        };
        let fail = |problem| FamilyFailure {
            family: family.name,
            seed,
            triangles,
            problem,
        };
        let scene = family.scene(seed, triangles);
        let rays = rays::mixed(&scene, seed, rays);
        let expected = Expected::new(&scene, rays).map_err(|error| fail(Problem::Build(error)))?;
        for structure in build(&scene).map_err(|error| fail(Problem::Build(error)))? {
            let disagreements = expected.disagreements(&structure);
            if let Some(first) = disagreements.first() {
                let first = Box::new(first.clone());
                return Err(fail(Problem::Disagreement(disagreements.len(), first)));
            }
        }
        checked.scenes += 1;
        checked.rays += expected.rays.len();
        checked.hits += expected.hits();
    }
    Ok(checked)
}

impl Checked {
    fn plus(self, other: Self) -> Self {
        Self {
            families: self.families + other.families,
            scenes: self.scenes + other.scenes,
            rays: self.rays + other.rays,
            hits: self.hits + other.hits,
        }
    }
}
