//! Adversarial scene families: each gathers one way in which scenes break
//! builders and traversals.
//!
//! A scene follows from its family, a seed and a size alone, so a failure is
//! reported by these three and found again by
//! `find(name).unwrap().scene(seed, triangles)`.
//!
//! ```
//! use accel_core::testing::{families, rays};
//!
//! for family in families::all() {
//!     let triangles = family.scene(7, 100);
//!     let rays = rays::mixed(&triangles, 7, 26);
//!     // Build a structure over the triangles, trace the rays, and compare.
//!     assert!(triangles.len() <= 100 && rays.len() == 26);
//! }
//! ```

mod bsp;
mod coplanar;
mod deep;
mod degenerate;
mod duplicates;
mod enclosed;
mod grids;
mod natural;
mod non_finite;
mod scales;
mod shapes;
mod slivers;
pub mod stadium;

use std::sync::LazyLock;

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use crate::Triangle;

/// Draws about as many triangles as it is asked for; [`Family::scene`] cuts
/// off what is too many.
type Generator = fn(&mut Pcg64Mcg, usize) -> Vec<Triangle>;

/// A named kind of scene, of any size and any number of variations.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// A short name in kebab case, unique among [`all`].
    pub name: &'static str,
    /// What the scene looks like and what it strains, in one sentence.
    pub about: &'static str,
    /// The number of triangles at which the family shows its full force:
    /// tests build it once at this size and often at smaller ones.
    pub full_size: usize,
    /// Whether scenes of at least one triangle hold triangles with NaN or
    /// infinite coordinates.
    pub has_invalid: bool,
    generate: Generator,
}

impl Family {
    const fn new(
        name: &'static str,
        about: &'static str,
        full_size: usize,
        generate: Generator,
    ) -> Self {
        Self {
            name,
            about,
            full_size,
            has_invalid: false,
            generate,
        }
    }

    const fn with_invalid(self) -> Self {
        Self {
            has_invalid: true,
            ..self
        }
    }

    /// The scene of this family for `seed`, of at most `triangles` triangles.
    ///
    /// Families of regular shapes stay below the number they are given, and
    /// one below their smallest form (a box has 12) yields a part of it.
    pub fn scene(&self, seed: u64, triangles: usize) -> Vec<Triangle> {
        let mut rng = Pcg64Mcg::seed_from_u64(seed);
        let mut scene = (self.generate)(&mut rng, triangles);
        scene.truncate(triangles);
        scene
    }
}

/// Every family, always in the same order.
pub fn all() -> &'static [Family] {
    static ALL: LazyLock<Vec<Family>> = LazyLock::new(|| {
        [
            degenerate::FAMILIES,
            duplicates::FAMILIES,
            coplanar::FAMILIES,
            grids::FAMILIES,
            slivers::FAMILIES,
            scales::FAMILIES,
            deep::FAMILIES,
            enclosed::FAMILIES,
            natural::FAMILIES,
            stadium::FAMILIES,
            bsp::FAMILIES,
            non_finite::FAMILIES,
        ]
        .concat()
    });
    &ALL
}

/// The family called `name`.
pub fn find(name: &str) -> Option<&'static Family> {
    all().iter().find(|family| family.name == name)
}

#[cfg(test)]
mod claims;
#[cfg(test)]
mod tests;
