//! `verify`: every structure against brute force.

use std::io::Write;

use accel_core::testing::rays as adversarial;
use accel_core::{Primitive, RaySegment, Triangle};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::arguments::VerifyOptions;
use super::{build, interrupt, load, ray_finder, ray_source, with_threads};
use crate::progress;
use crate::rays::{Question, RayKind};
use crate::registry::{self, Row, Structure};
use crate::scene::Scene;
use crate::verification::Expected;

/// Disagreements printed in full, per structure and kind of ray.
const PRINTED: usize = 5;

/// Verifies all scenes; false if anything disagreed.
pub(super) fn run(options: &VerifyOptions) -> anyhow::Result<bool> {
    let rows = registry::select(&options.structures).map_err(anyhow::Error::msg)?;
    check_kinds(&options.kinds)?;
    with_threads(options.scene.threads, || {
        let mut total = Tally::default();
        for name in &options.scenes {
            if interrupt::is_requested() {
                break;
            }
            let scene = load(name, &options.scene)?;
            total.add(&verify_scene(&scene, &rows, options)?);
        }
        say(&format!(
            "{} rays compared with brute force, {} disagreements",
            total.rays, total.disagreements
        ))?;
        Ok(total.disagreements == 0)
    })
}

#[derive(Default)]
struct Tally {
    rays: usize,
    disagreements: usize,
}

impl Tally {
    fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.disagreements += other.disagreements;
    }
}

/// A set of rays with the question asked of them.
struct Trial {
    name: String,
    question: Question,
    rays: Vec<RaySegment>,
    /// Asked for any hit as well.
    is_adversarial: bool,
}

fn verify_scene(scene: &Scene, rows: &[&Row], options: &VerifyOptions) -> anyhow::Result<Tally> {
    let names: Vec<&str> = rows.iter().map(|row| row.name).collect();
    say(&format!(
        "{} ({} triangles): {}",
        scene.name,
        scene.triangles.len(),
        names.join(", ")
    ))?;
    let invalid = options.scene.invalid();
    let oracle = registry::oracle(&scene.triangles, invalid)?;
    let structures = rows
        .iter()
        .map(|row| build(row, scene, invalid))
        .collect::<anyhow::Result<Vec<Structure>>>()?;
    let structures: Vec<(&str, Structure)> = names.into_iter().zip(structures).collect();
    let mut tally = Tally::default();
    for trial in trials(scene, options)? {
        if interrupt::is_requested() {
            break;
        }
        let what = format!("{}: brute force, {}", scene.name, trial.name);
        let bar = progress::bar(&what, trial.rays.len() as u64);
        let tick = |rays: usize| bar.inc(rays as u64);
        let expected = Expected::new(&oracle, trial.question, trial.rays, &tick);
        bar.finish_and_clear();
        tally.add(&compare(&structures, &trial.name, &expected)?);
        if trial.is_adversarial {
            let name = format!("{} (any hit)", trial.name);
            tally.add(&compare(&structures, &name, &expected.into_any())?);
        }
    }
    Ok(tally)
}

/// Compares all structures on one set of rays: a line for the set, and one for
/// each structure that disagrees.
fn compare(
    structures: &[(&str, Structure)],
    trial: &str,
    expected: &Expected,
) -> anyhow::Result<Tally> {
    let mut tally = Tally::default();
    let mut disagreeing = Vec::new();
    for (name, structure) in structures {
        let disagreements = expected.disagreements(structure.as_ref());
        tally.add(&Tally {
            rays: expected.len(),
            disagreements: disagreements.len(),
        });
        if !disagreements.is_empty() {
            disagreeing.push((name, disagreements));
        }
    }
    say(&format!(
        "  {trial:<28} {:>9} rays x {:>2} structures  {:>6} disagreements",
        expected.len(),
        structures.len(),
        tally.disagreements
    ))?;
    for (name, disagreements) in disagreeing {
        say(&format!(
            "    {name}: {} disagreements",
            disagreements.len()
        ))?;
        for found in disagreements.iter().take(PRINTED) {
            say(&format!(
                "      {:?}\n        expected {:?}\n        got      {:?}",
                found.ray, found.expected, found.actual
            ))?;
        }
    }
    Ok(tally)
}

/// Refuses names that no kind of rays has.
fn check_kinds(names: &[String]) -> anyhow::Result<()> {
    let of_bench = RayKind::ALL.iter().map(|kind| kind.name());
    let adversarial = adversarial::RayKind::FINITE.iter().map(|kind| kind.name());
    let known: Vec<&str> = of_bench.chain(adversarial).collect();
    for name in names {
        anyhow::ensure!(
            known.contains(&name.as_str()),
            "there is no kind of rays named `{name}`; there are {}",
            known.join(", ")
        );
    }
    Ok(())
}

/// Every kind of rays of the bench with its own question, and the adversarial
/// kinds; those asked for.
fn trials(scene: &Scene, options: &VerifyOptions) -> anyhow::Result<Vec<Trial>> {
    let is_wanted =
        |name: &str| options.kinds.is_empty() || options.kinds.iter().any(|kind| kind == name);
    let mut trials = Vec::new();
    let finder = ray_finder(scene, options.scene.invalid())?;
    for kind in RayKind::ALL {
        if is_wanted(kind.name()) {
            trials.push(Trial {
                name: kind.name().to_owned(),
                question: kind.question(),
                rays: rays_of_bench(kind, scene, &finder, options),
                is_adversarial: false,
            });
        }
    }
    let valid: Vec<Triangle> = scene
        .triangles
        .iter()
        .filter(|triangle| triangle.bounds().is_valid())
        .copied()
        .collect();
    for family in adversarial::RayKind::FINITE {
        if is_wanted(family.name()) {
            let mut random = Pcg64Mcg::seed_from_u64(options.scene.seed);
            trials.push(Trial {
                name: family.name().to_owned(),
                question: Question::Closest,
                rays: adversarial::rays(family, &valid, &mut random, options.rays),
                is_adversarial: true,
            });
        }
    }
    Ok(trials)
}

/// As many as asked for: of as many pixels as that takes, since not every kind makes
/// a ray at each.
fn rays_of_bench(
    kind: RayKind,
    scene: &Scene,
    finder: &Structure,
    options: &VerifyOptions,
) -> Vec<RaySegment> {
    let mut side = (options.rays as f64).sqrt().ceil() as u32;
    let mut rays = Vec::new();
    for _ in 0..4 {
        let source = ray_source(scene, finder, (side, side), options.scene.seed);
        rays = source
            .map(|source| source.rays(kind).rays)
            .unwrap_or_default();
        if rays.len() >= options.rays || rays.is_empty() {
            break;
        }
        side *= 2;
    }
    spread(rays, options.rays)
}

/// `count` of the rays, evenly spread; all if there are fewer.
fn spread(rays: Vec<RaySegment>, count: usize) -> Vec<RaySegment> {
    if rays.len() <= count {
        return rays;
    }
    (0..count)
        .map(|index| rays[index * rays.len() / count])
        .collect()
}

fn say(line: &str) -> anyhow::Result<()> {
    writeln!(std::io::stdout(), "{line}")?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use accel_core::BruteForce;

    #[test]
    fn a_structure_that_lies_is_counted() {
        let triangle = |z: f32| Triangle::new([0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]);
        let boxed = |z: f32| -> Structure { Box::new(BruteForce::new(&[triangle(z)]).unwrap()) };
        let rays = vec![RaySegment::new([0.2, 0.2, 0.0], [0.0, 0.0, 1.0]); 7];
        let oracle = boxed(1.0);
        let expected = Expected::new(oracle.as_ref(), Question::Closest, rays, &|_| ());
        let structures = [("honest", boxed(1.0)), ("lying", boxed(2.0))];
        let tally = compare(&structures, "rays", &expected).unwrap();
        assert_eq!((tally.rays, tally.disagreements), (14, 7));
    }

    #[test]
    fn rays_are_spread_over_all_of_them() {
        let rays: Vec<_> = (0..100)
            .map(|i| RaySegment::new([i as f32, 0.0, 0.0], [1.0, 0.0, 0.0]))
            .collect();
        let picked = spread(rays, 10);
        assert_eq!(picked.len(), 10);
        assert_eq!((picked[0].origin.x, picked[9].origin.x), (0.0, 90.0));
    }
}
