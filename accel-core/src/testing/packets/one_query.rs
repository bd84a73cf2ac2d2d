//! All queries as one type: packet traversals take long to compile, and so there
//! is one instance of each for all queries.

use std::ops::ControlFlow;

use crate::query::{AllHits, AnyHit, ClosestHit, Filtered, Hit, Query};
use crate::ray::PreparedRay;
use crate::testing::agreement::{HitBits, bits};

/// Which query.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Closest,
    Any,
    All,
    /// The closest hit of a primitive with an odd id.
    ClosestOdd,
}

impl Kind {
    pub(super) const ALL: [Self; 4] = [Self::Closest, Self::Any, Self::All, Self::ClosestOdd];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Closest => "closest hit",
            Self::Any => "any hit",
            Self::All => "all hits",
            Self::ClosestOdd => "filtered closest hit",
        }
    }

    /// The expected and the actual hits where they differ. Those expected follow
    /// from all hits, which are sorted.
    pub(super) fn difference(
        self,
        all: &[HitBits],
        actual: &[HitBits],
    ) -> Option<(String, String)> {
        let expected: Vec<&HitBits> = match self {
            Self::Any => {
                // Which hit is found is left to the traversal.
                let is_expected = all.is_empty() == actual.is_empty();
                let text = |hits: &[HitBits]| (!hits.is_empty()).to_string();
                return (!is_expected).then(|| (text(all), text(actual)));
            }
            Self::Closest => all.iter().take(1).collect(),
            Self::All => all.iter().collect(),
            Self::ClosestOdd => all
                .iter()
                .filter(|(_, id, ..)| id % 2 == 1)
                .take(1)
                .collect(),
        };
        let is_expected = expected.iter().copied().eq(actual);
        (!is_expected).then(|| (format!("{expected:?}"), format!("{actual:?}")))
    }
}

pub(super) enum OneQuery {
    Closest(ClosestHit),
    Any(AnyHit),
    All(AllHits),
    ClosestOdd(Filtered<ClosestHit, fn(&Hit) -> bool>),
}

impl OneQuery {
    pub(super) fn new(kind: Kind, ray: &PreparedRay) -> Self {
        match kind {
            Kind::Closest => Self::Closest(ClosestHit::new(ray)),
            Kind::Any => Self::Any(AnyHit::new(ray)),
            Kind::All => Self::All(AllHits::new(ray)),
            Kind::ClosestOdd => {
                Self::ClosestOdd(Filtered::new(ClosestHit::new(ray), |hit| hit.id % 2 == 1))
            }
        }
    }

    /// What it found; of [`AnyHit`], which tells no hit, one that stands for any.
    pub(super) fn into_hits(self) -> Vec<HitBits> {
        match self {
            Self::Closest(query) => query.best().iter().map(bits).collect(),
            Self::Any(query) => query.found().then_some((0, 0, 0, 0)).into_iter().collect(),
            Self::All(query) => query.into_sorted().iter().map(bits).collect(),
            Self::ClosestOdd(query) => query.into_inner().best().iter().map(bits).collect(),
        }
    }
}

impl Query for OneQuery {
    fn t_max(&self) -> f32 {
        match self {
            Self::Closest(query) => query.t_max(),
            Self::Any(query) => query.t_max(),
            Self::All(query) => query.t_max(),
            Self::ClosestOdd(query) => query.t_max(),
        }
    }

    fn offer(&mut self, hit: &Hit) -> ControlFlow<()> {
        match self {
            Self::Closest(query) => query.offer(hit),
            Self::Any(query) => query.offer(hit),
            Self::All(query) => query.offer(hit),
            Self::ClosestOdd(query) => query.offer(hit),
        }
    }
}
