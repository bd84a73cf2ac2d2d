//! Splitting primitives before a plain BVH is built over the parts: the methods
//! that Stich 2009 compares with (section 3).
//!
//! Both look at one primitive at a time and need a threshold; the SBVH looks at
//! all primitives of a node together and needs none.

mod early_split_clipping;
mod edge_volume;
mod threshold;

use std::sync::atomic::{AtomicUsize, Ordering};

use accel_bvh::{Bvh, BvhBuilder, NodeRules};
use accel_core::build::map_each;
use accel_core::geometry::DAabb;
use accel_core::reference::{Reference, gather};
use accel_core::{Aabb, BuildError, BuildObserver, Primitive};

use crate::ReferenceLimit;

pub use early_split_clipping::EarlySplitClipping;
pub use edge_volume::EdgeVolumeHeuristic;
pub use threshold::Threshold;

/// More than any threshold worth having makes: the count is asked for, not left
/// to a heuristic.
const DEFAULT_LIMIT: ReferenceLimit = ReferenceLimit::Factor(4.0);

/// What a presplit made.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PresplitStatistics {
    /// Primitives in the tree.
    pub primitives: usize,
    /// References that the tree was built over.
    pub references: usize,
    /// References in its leaves: fewer, where duplicates were removed.
    pub references_in_leaves: usize,
    /// The threshold used, given or found.
    pub threshold: f64,
    /// The number of references that a threshold was searched for, if one was.
    pub target: Option<usize>,
}

impl PresplitStatistics {
    /// Whether the number of references is what was asked for, within 0.5 %: it
    /// is not where no threshold makes it, as where many parts have the same
    /// size.
    pub fn is_target_met(&self) -> bool {
        self.target
            .is_none_or(|target| threshold::is_close(self.references, target))
    }
}

/// A way to divide one primitive into parts.
trait Subdivision<P>: Sync {
    /// Calls `part` with the bounds of each part of `primitive`, of which there is
    /// at least one, until it answers that there are too many.
    fn divide(&self, primitive: &P, threshold: f64, part: &mut dyn FnMut(DAabb) -> bool);

    /// The largest threshold that divides nothing of a scene with these bounds
    /// is at most this.
    fn largest_threshold(&self, scene: &Aabb) -> f64;
}

/// What both methods are told besides how to divide.
struct Pipeline<'a, S> {
    subdivision: S,
    threshold: Threshold,
    limit: ReferenceLimit,
    remove_duplicates: bool,
    bvh: &'a BvhBuilder,
}

/// The error of a threshold that makes too many references; how many is not
/// counted to the end.
fn too_many(most: usize) -> BuildError {
    BuildError::BudgetExceeded {
        what: "references",
        needed: most + 1,
        limit: most,
    }
}

/// Primitives that one task divides.
const CHUNK: usize = 4096;

impl<S> Pipeline<'_, S> {
    fn build<P: Primitive>(
        &self,
        primitives: &[P],
        observer: &dyn BuildObserver,
    ) -> Result<(Bvh<P>, PresplitStatistics), BuildError>
    where
        S: Subdivision<P>,
    {
        self.bvh.validate()?;
        self.limit.validate()?;
        self.threshold.validate()?;
        let budget = &self.bvh.budget;
        budget.check_bytes(primitives.len().saturating_mul(size_of::<Reference>()))?;
        let gathered = gather(primitives, self.bvh.invalid_primitives)?;
        let whole = gathered.references.len();
        budget.check_bytes(self.bvh.working_bytes(whole))?;
        let most = self.limit.references(whole, size_of::<P>())?;
        let target = self.threshold.target(whole, most)?;
        if whole == 0 {
            return Ok((self.bvh.build(primitives)?, PresplitStatistics::default()));
        }
        let scene = Presplit {
            subdivision: &self.subdivision,
            primitives,
            wholes: &gathered.references,
            observer,
        };
        let largest = self.subdivision.largest_threshold(&gathered.bounds);
        let threshold = self.threshold.resolve(&scene, target, largest, most)?;
        let references = scene
            .count(threshold, most)?
            .ok_or_else(|| too_many(most))?;
        let bytes_of_parts = 2 * references * size_of::<Reference>();
        budget.check_bytes(self.bvh.working_bytes(references) + bytes_of_parts)?;
        let parts = scene.parts(threshold);
        let rules = NodeRules::new(self.bvh, references);
        let ids: Vec<u32> = parts.iter().map(|part| part.id).collect();
        // While the tree is built each part needs a name of its own.
        let numbered = (0..)
            .zip(&parts)
            .map(|(id, part)| Reference { id, ..*part });
        let bounds = gathered.bounds;
        let mut tree = self
            .bvh
            .build_tree(&rules, numbered.collect(), bounds, observer)?;
        tree.map_ids(|part| ids[part as usize]);
        if self.remove_duplicates {
            tree.remove_duplicates_in_leaves();
        }
        let statistics = PresplitStatistics {
            primitives: gathered.references.len(),
            references,
            references_in_leaves: tree.references(),
            threshold,
            target,
        };
        let bvh = Bvh::from_build_tree(primitives, &tree, bounds, gathered.skipped, budget)?;
        Ok((bvh, statistics))
    }
}

/// A scene to be divided.
struct Presplit<'a, P, S> {
    subdivision: &'a S,
    primitives: &'a [P],
    /// The references of all valid primitives, undivided.
    wholes: &'a [Reference],
    observer: &'a dyn BuildObserver,
}

impl<P: Primitive, S: Subdivision<P>> Presplit<'_, P, S> {
    /// How many parts there are; `None` if there are more than `most`.
    ///
    /// # Errors
    /// [`BuildError::Cancelled`] if the observer asked for it.
    fn count(&self, threshold: f64, most: usize) -> Result<Option<usize>, BuildError> {
        let total = AtomicUsize::new(0);
        map_each(
            self.wholes.chunks(CHUNK).collect(),
            |wholes: &[Reference]| {
                for whole in wholes {
                    if total.load(Ordering::Relaxed) > most || self.observer.is_cancelled() {
                        return;
                    }
                    let room = most.saturating_sub(total.load(Ordering::Relaxed));
                    let mut count = 0;
                    self.divide(whole, threshold, &mut |_| {
                        count += 1;
                        count <= room
                    });
                    total.fetch_add(count, Ordering::Relaxed);
                }
            },
        );
        if self.observer.is_cancelled() {
            return Err(BuildError::Cancelled);
        }
        Ok(Some(total.into_inner()).filter(|&count| count <= most))
    }

    /// References to all parts, in order of primitives.
    fn parts(&self, threshold: f64) -> Vec<Reference> {
        let chunks = self.wholes.chunks(CHUNK).collect();
        let parts = map_each(chunks, |wholes: &[Reference]| {
            let mut parts = Vec::with_capacity(wholes.len());
            for whole in wholes {
                self.push_parts(whole, threshold, &mut parts);
            }
            parts
        });
        parts.concat()
    }

    fn push_parts(&self, whole: &Reference, threshold: f64, parts: &mut Vec<Reference>) {
        let primitive = &self.primitives[whole.id as usize];
        let first = parts.len();
        self.divide(whole, threshold, &mut |tight| {
            let mut part = Reference::to_part(primitive, whole.id, &tight);
            // No hit lies outside the whole's own box.
            part.bounds = part.bounds.intersection(&whole.bounds);
            parts.push(part);
            true
        });
        if parts.len() - first <= 1 {
            parts.truncate(first);
            parts.push(*whole);
        }
    }

    fn divide(&self, whole: &Reference, threshold: f64, part: &mut dyn FnMut(DAabb) -> bool) {
        let primitive = &self.primitives[whole.id as usize];
        self.subdivision.divide(primitive, threshold, part);
    }
}
