//! Settings, and the way from primitives to a tree.

use accel_core::build::build_top_down;
use accel_core::reference::gather;
use accel_core::{
    BuildBudget, BuildError, BuildObserver, Clip, InvalidPrimitives, SurfaceAreaHeuristic,
};

use crate::binned::MAX_BINS;
use crate::division::DividedParts;
use crate::event::{Events, MAX_PARTS};
use crate::part::{Clipper, Slack};
use crate::splitting::Splitting;
use crate::{KdTree, Termination, Work};

/// Builds a [`KdTree`]. All settings have defaults:
///
/// ```
/// use accel_kdtree::{KdTreeBuilder, PlaneSearch, Sphere};
/// # fn main() -> Result<(), accel_kdtree::BuildError> {
/// let spheres = [Sphere::new([0.0; 3], 1.0), Sphere::new([4.0, 0.0, 0.0], 1.0)];
/// let builder = KdTreeBuilder {
///     search: PlaneSearch::binned(),
///     ..KdTreeBuilder::default()
/// };
/// let tree = builder.build(&spheres)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KdTreeBuilder {
    /// How the best plane of a node is searched for.
    pub search: PlaneSearch,
    /// Whether primitives that straddle a plane are clipped to both cells
    /// (*perfect splits*). Without it their boxes are, and leaves reference
    /// primitives that do not reach into them.
    pub clips_primitives: bool,
    /// The costs of visiting a node, K_T, and of testing a primitive, K_I.
    pub heuristic: SurfaceAreaHeuristic,
    /// By which share splits that cut off empty space are made cheaper: 0 to
    /// below 1.
    pub empty_bonus: f64,
    /// When a node becomes a leaf.
    pub termination: Termination,
    /// How many references all splits together may add, for each primitive;
    /// shared out from the root down. Finite and at least 0.
    pub max_duplication: f64,
    /// Whether primitives without finite bounds are refused or left out.
    pub invalid_primitives: InvalidPrimitives,
    /// Limits on memory and depth. The limit on bytes bounds the references, too:
    /// a tree has as many as fit.
    pub budget: BuildBudget,
}

/// How the best plane of a node is searched for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaneSearch {
    /// Every plane that touches a primitive, in O(n log n) time for the whole
    /// tree: the best trees (Wald and Havran 2006).
    Sweep,
    /// Planes at equal distances, until nodes are small enough for the sweep:
    /// faster, in parallel also near the root, and nearly as good.
    Binned {
        /// Bins along each axis, 2 to 256.
        bins: usize,
        /// Nodes of fewer references than this are swept.
        exact_below: usize,
    },
}

impl PlaneSearch {
    /// Binned, with the default number of bins.
    pub const fn binned() -> Self {
        Self::Binned {
            bins: 64,
            exact_below: 1024,
        }
    }
}

impl Default for KdTreeBuilder {
    /// Costs and bonus as in Wald and Havran 2006, sections 3.2 and 5.
    fn default() -> Self {
        Self {
            search: PlaneSearch::Sweep,
            clips_primitives: true,
            heuristic: SurfaceAreaHeuristic {
                traversal_cost: 15.0,
                intersection_cost: 20.0,
            },
            empty_bonus: 0.2,
            termination: Termination::Automatic,
            max_duplication: 16.0,
            invalid_primitives: InvalidPrimitives::default(),
            budget: BuildBudget::default(),
        }
    }
}

impl KdTreeBuilder {
    /// Builds the tree of `primitives`; hits name them by their position there.
    ///
    /// # Errors
    /// Any [`BuildError`] but `Cancelled`.
    pub fn build<P: Clip>(&self, primitives: &[P]) -> Result<KdTree<P>, BuildError> {
        self.build_with(primitives, &())
    }

    /// As [`build`](Self::build), telling `observer` how far it is and stopping
    /// when told to.
    ///
    /// # Errors
    /// Any [`BuildError`].
    pub fn build_with<P: Clip>(
        &self,
        primitives: &[P],
        observer: &dyn BuildObserver,
    ) -> Result<KdTree<P>, BuildError> {
        Ok(self.build_counting(primitives, observer)?.0)
    }

    /// As [`build_with`](Self::build_with), with a count of what was done.
    ///
    /// # Errors
    /// Any [`BuildError`].
    pub fn build_counting<P: Clip>(
        &self,
        primitives: &[P],
        observer: &dyn BuildObserver,
    ) -> Result<(KdTree<P>, Work), BuildError> {
        self.validate()?;
        let duplicates = self.duplicates_within_budget(primitives.len())?;
        let gathered = gather(primitives, self.invalid_primitives)?;
        let (cell, skipped) = (gathered.bounds, gathered.skipped);
        if gathered.references.is_empty() {
            return Ok((KdTree::empty(primitives, skipped), Work::default()));
        }
        let ids = || gathered.references.iter().map(|reference| reference.id);
        let slack = Slack::of(ids().map(|id| primitives[id as usize].bounds()));
        let clipper = Clipper {
            primitives,
            slack,
            clips_primitives: self.clips_primitives,
        };
        let parts = ids().map(|id| clipper.whole(id, &cell)).collect();
        let splitting = Splitting::new(*self, clipper);
        let task = splitting.root(parts, cell, duplicates);
        drop(gathered.references);
        let tree = build_top_down(&splitting, task, 0, observer)?;
        let packed = KdTree::pack(&self.budget, primitives, &tree, cell, slack, skipped)?;
        Ok((packed, splitting.work()))
    }

    /// Checks the settings.
    ///
    /// # Errors
    /// [`BuildError::InvalidSetting`] names the first that is out of its range.
    pub fn validate(&self) -> Result<(), BuildError> {
        self.heuristic.validate()?;
        self.termination.validate()?;
        self.budget.validate()?;
        let reject = |setting, value: String, allowed| {
            Err(BuildError::InvalidSetting {
                setting,
                value,
                allowed,
            })
        };
        if let PlaneSearch::Binned { bins, .. } = self.search
            && !(2..=MAX_BINS).contains(&bins)
        {
            return reject("bins", bins.to_string(), "2 to 256");
        }
        if !(0.0..1.0).contains(&self.empty_bonus) {
            return reject("empty_bonus", self.empty_bonus.to_string(), "0 to below 1");
        }
        if !(0.0..f64::INFINITY).contains(&self.max_duplication) {
            return reject(
                "max_duplication",
                self.max_duplication.to_string(),
                "a finite number, 0 or more",
            );
        }
        Ok(())
    }

    /// Bytes that a build of this many references in leaves takes at most, the
    /// copies of primitives in the tree aside: parts and events of the nodes not
    /// yet divided, and of the children of those being divided.
    pub fn working_bytes(&self, references: usize) -> usize {
        references.saturating_mul(DividedParts::BYTES_PER_PART + Events::BYTES_PER_PART)
    }

    /// How many references may be added over this many primitives.
    fn duplicates_within_budget(&self, primitives: usize) -> Result<usize, BuildError> {
        self.budget.check_bytes(self.working_bytes(primitives))?;
        let within_bytes = self.budget.max_bytes.map_or(usize::MAX, |bytes| {
            bytes / self.working_bytes(1).max(1) - primitives
        });
        let by_setting = (self.max_duplication * primitives as f64) as usize;
        let by_events = MAX_PARTS.saturating_sub(primitives);
        Ok(by_setting.min(within_bytes).min(by_events))
    }
}
