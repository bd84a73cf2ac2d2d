//! Families of scenes that break acceleration structures: degenerate, coplanar,
//! duplicated, huge, tiny, deep, closed, not finite; and some natural ones.

mod coplanar;
mod deep;
mod degenerate;
mod enclosed;
mod invalid;
mod natural;
mod planes;
mod scales;
mod shapes;
mod slivers;

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use crate::Triangle;

/// A family of scenes: one per seed and size.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Its name.
    pub name: &'static str,
    /// What is special about it.
    pub about: &'static str,
    /// The size at which it is tested in full, in triangles.
    pub full_size: usize,
    /// Whether some triangles have corners that are not finite.
    pub has_invalid: bool,
    generate: fn(&mut Pcg64Mcg, usize) -> Vec<Triangle>,
}

impl Family {
    /// The scene of this seed, of at most `triangles` triangles.
    pub fn scene(&self, seed: u64, triangles: usize) -> Vec<Triangle> {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut scene = (self.generate)(&mut random, triangles);
        scene.truncate(triangles);
        scene
    }
}

/// All families.
pub fn all() -> impl Iterator<Item = &'static Family> {
    let themes: [&[Family]; 9] = [
        degenerate::FAMILIES,
        coplanar::FAMILIES,
        slivers::FAMILIES,
        scales::FAMILIES,
        invalid::FAMILIES,
        deep::FAMILIES,
        enclosed::FAMILIES,
        planes::FAMILIES,
        natural::FAMILIES,
    ];
    themes.into_iter().flatten()
}

/// The family called `name`.
pub fn find(name: &str) -> Option<&'static Family> {
    all().find(|family| family.name == name)
}

/// A family without invalid triangles, 20,000 at full size.
const fn family(
    name: &'static str,
    about: &'static str,
    generate: fn(&mut Pcg64Mcg, usize) -> Vec<Triangle>,
) -> Family {
    Family {
        name,
        about,
        full_size: 20_000,
        has_invalid: false,
        generate,
    }
}

/// The same family with another full size.
const fn sized(full_size: usize, family: Family) -> Family {
    Family {
        full_size,
        ..family
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Primitive;

    #[test]
    fn there_are_forty_families_with_names_of_their_own() {
        let mut names: Vec<_> = all().map(|family| family.name).collect();
        assert!(names.len() >= 40, "{}", names.len());
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), all().count());
    }

    #[test]
    fn scenes_keep_to_their_size_and_seed_and_tell_the_truth_about_invalid_triangles() {
        for family in all() {
            let mut has_invalid = false;
            for seed in 0..4 {
                let scene = family.scene(seed, 300);
                assert!(scene.len() <= 300, "{}", family.name);
                assert_eq!(
                    format!("{scene:?}"),
                    format!("{:?}", family.scene(seed, 300)),
                    "{}",
                    family.name
                );
                has_invalid |= scene.iter().any(|triangle| !triangle.bounds().is_valid());
            }
            assert_eq!(has_invalid, family.has_invalid, "{}", family.name);
        }
    }

    #[test]
    fn scenes_are_as_large_as_asked_where_the_family_allows() {
        let small = ["empty", "one-triangle"];
        for family in all().filter(|family| !small.contains(&family.name)) {
            let count = family.scene(1, 1000).len();
            assert!(count >= 300, "{} has {count} of 1000", family.name);
        }
    }
}
