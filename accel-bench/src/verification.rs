//! Comparing structures with brute force, ray by ray, bit for bit.

use accel_core::{DynStructure, Hit, RaySegment};
use rayon::prelude::*;

use crate::rays::Question;

/// Rays that one task compares.
const CHUNK: usize = 64;

/// Brute force's answers to rays: computed once, shared by all structures.
pub struct Expected {
    question: Question,
    rays: Vec<RaySegment>,
    answers: Vec<Answer>,
}

/// What was asked, answered.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// The closest hit.
    Closest(Option<Hit>),
    /// Whether there is a hit.
    Any(bool),
    /// All hits.
    All(Vec<Hit>),
}

/// A ray that a structure answers differently from brute force.
#[derive(Clone, Debug)]
pub struct Disagreement {
    /// The ray, to full precision when printed.
    pub ray: RaySegment,
    /// Brute force's answer.
    pub expected: Answer,
    /// The structure's answer.
    pub actual: Answer,
}

impl Expected {
    /// Asks `oracle`, on all threads of the current pool; `tick` is called with
    /// the number of rays done.
    pub fn new(
        oracle: &dyn DynStructure,
        question: Question,
        rays: Vec<RaySegment>,
        tick: &(dyn Fn(usize) + Sync),
    ) -> Self {
        let answers = rays
            .par_chunks(CHUNK)
            .flat_map_iter(|rays| {
                let answers = answer(oracle, question, rays);
                tick(rays.len());
                answers
            })
            .collect();
        Self {
            question,
            rays,
            answers,
        }
    }

    /// The answers to whether there is any hit, from those to the closest-hit
    /// question: brute force tests everything either way.
    ///
    /// # Panics
    /// If another question was asked.
    #[must_use]
    pub fn into_any(self) -> Self {
        let any = |answer| match answer {
            Answer::Closest(hit) => Answer::Any(hit.is_some()),
            other => panic!("{other:?} does not answer the closest-hit question"),
        };
        Self {
            question: Question::Any,
            answers: self.answers.into_iter().map(any).collect(),
            rays: self.rays,
        }
    }

    /// How many rays there are.
    pub fn len(&self) -> usize {
        self.rays.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.rays.is_empty()
    }

    /// The rays that `structure` answers differently, in order.
    pub fn disagreements(&self, structure: &dyn DynStructure) -> Vec<Disagreement> {
        let chunks = self
            .rays
            .par_chunks(CHUNK)
            .zip(self.answers.par_chunks(CHUNK));
        chunks
            .flat_map_iter(|(rays, expected)| {
                let actual = answer(structure, self.question, rays);
                rays.iter()
                    .zip(expected)
                    .zip(actual)
                    .filter(|((_, expected), actual)| !is_same(expected, actual))
                    .map(|((&ray, expected), actual)| Disagreement {
                        ray,
                        expected: expected.clone(),
                        actual,
                    })
                    .collect::<Vec<_>>()
            })
            .collect()
    }
}

fn answer(structure: &dyn DynStructure, question: Question, rays: &[RaySegment]) -> Vec<Answer> {
    match question {
        Question::Closest => {
            let mut hits = vec![None; rays.len()];
            structure.trace_closest(rays, &mut hits);
            hits.into_iter().map(Answer::Closest).collect()
        }
        Question::Any => {
            let mut answers = vec![false; rays.len()];
            structure.trace_any(rays, &mut answers);
            answers.into_iter().map(Answer::Any).collect()
        }
        Question::All => {
            let mut hits = vec![Vec::new(); rays.len()];
            structure.trace_all(rays, &mut hits);
            hits.into_iter().map(Answer::All).collect()
        }
    }
}

/// Equal in every bit: t, u, v and id.
fn is_same(expected: &Answer, actual: &Answer) -> bool {
    let bits = |hit: &Hit| [hit.t.to_bits(), hit.u.to_bits(), hit.v.to_bits(), hit.id];
    match (expected, actual) {
        (Answer::Closest(a), Answer::Closest(b)) => a.as_ref().map(bits) == b.as_ref().map(bits),
        (Answer::Any(a), Answer::Any(b)) => a == b,
        (Answer::All(a), Answer::All(b)) => a.iter().map(bits).eq(b.iter().map(bits)),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use accel_core::{BruteForce, Triangle};

    #[test]
    fn a_structure_over_other_triangles_disagrees_where_they_differ() {
        let near = Triangle::new([0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]);
        let far = Triangle::new([0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]);
        let [oracle, other] = [near, far].map(|one| BruteForce::new(&[one]).unwrap());
        let rays = vec![
            RaySegment::new([0.2, 0.2, 0.0], [0.0, 0.0, 1.0]),
            RaySegment::new([0.9, 0.9, 0.0], [0.0, 0.0, 1.0]),
        ];
        for (question, different) in [
            (Question::Closest, 1),
            (Question::Any, 0),
            (Question::All, 1),
        ] {
            let expected = Expected::new(&oracle, question, rays.clone(), &|_| ());
            assert_eq!(expected.disagreements(&oracle).len(), 0);
            assert_eq!(
                expected.disagreements(&other).len(),
                different,
                "{question:?}"
            );
        }
        let empty = BruteForce::<Triangle>::new(&[]).unwrap();
        let any = Expected::new(&oracle, Question::Closest, rays, &|_| ()).into_any();
        assert_eq!(any.disagreements(&oracle).len(), 0);
        assert_eq!(any.disagreements(&empty).len(), 1);
    }
}
