//! Settings, and the way from primitives to a tree.

use accel_core::build::{Division, TopDown, build_top_down};
use accel_core::reference::gather;
use accel_core::{BuildBudget, BuildError, BuildObserver, InvalidPrimitives, Polygonal};

use crate::BspTree;
use crate::allowance::Allowance;
use crate::candidates::CandidatePlanes;
use crate::cost::BspCosts;
use crate::layout::bytes_per_reference;
use crate::pieces::Pieces;
use crate::polytope::{Polytope, Reach};
use crate::search::Search;
use crate::split_plane::SplitPlane;

/// Builds a [`BspTree`]. All settings have defaults; [`original`](Self::original)
/// and [`with_planar_leaves`](Self::with_planar_leaves) give the paper's variants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BspBuilder {
    /// The costs of visiting nodes and of testing primitives.
    pub costs: BspCosts,
    /// Whether nodes split orthogonally to an axis are traversed by the fast path
    /// of a kd-tree. Without it every node costs as much as a general one.
    pub axis_aligned_nodes: bool,
    /// What leaves of one primitive know of its plane: BSP-tri (section 4.3).
    pub single_leaves: SingleLeaves,
    /// How far primitives may reach over a plane and still be on one side of it,
    /// relative to the extent of what the node holds: 2^-24 to 2^-14. Larger
    /// values need fewer planes for surfaces that are almost flat, but traversal
    /// visits both sides more often.
    pub epsilon: f64,
    /// Which planes are tried.
    pub candidate_planes: CandidatePlanes,
    /// In larger nodes, of how many primitives, evenly picked, the planes are
    /// tried; axis-aligned planes are tried for all. `None`, with
    /// [`CandidatePlanes::of_the_paper`], is the paper's exhaustive search. At least 1.
    pub sampled_primitives: Option<usize>,
    /// How many references all splits together may add, for each primitive;
    /// shared out from the root down. A limit, rarely met: a scan needs about 3,
    /// but corners where many primitives meet need a large share. Finite and at least 0.
    pub max_duplication: f64,
    /// How many nodes the tree may have, at least 1; nodes without a share of them
    /// become leaves. `None` for as many as indices can tell apart.
    pub max_nodes: Option<usize>,
    /// How many candidate planes may be weighed in all, for each primitive; nodes
    /// whose share is spent become leaves. At least 1. A closed surface of
    /// 10,000 triangles needs less than 4,096; the limit is for scenes in which
    /// everything straddles.
    pub max_candidates: usize,
    /// Whether primitives without finite bounds are refused or left out.
    pub invalid_primitives: InvalidPrimitives,
    /// Limits on memory and depth. The limit on bytes bounds references and nodes, too:
    /// splits that would add more are not made. Only where not even the primitives
    /// themselves fit, the build is refused.
    pub budget: BuildBudget,
}

/// What a leaf of one primitive knows of its plane. Queries are answered the same
/// with each of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SingleLeaves {
    /// Nothing: the primitive is tested wherever the leaf is visited.
    #[default]
    Plain,
    /// The plane: the primitive is tested only where the ray crosses the plane
    /// inside the leaf.
    Planar,
    /// The depth of the node that splits by the plane, where the primitive covers
    /// the face that the plane cuts into the cell. Only
    /// [`closest_hit_unconfirmed`](BspTree::closest_hit_unconfirmed) makes use of
    /// it.
    Bounded,
}

impl Default for BspBuilder {
    fn default() -> Self {
        Self {
            costs: BspCosts::default(),
            axis_aligned_nodes: true,
            single_leaves: SingleLeaves::default(),
            epsilon: 1.0 / (1 << 20) as f64,
            candidate_planes: CandidatePlanes::default(),
            sampled_primitives: Some(256),
            max_duplication: 64.0,
            max_nodes: None,
            max_candidates: 1 << 14,
            invalid_primitives: InvalidPrimitives::default(),
            budget: BuildBudget::default(),
        }
    }
}

impl BspBuilder {
    /// BSP-orig: general nodes only, and the plain surface area heuristic
    /// (section 5).
    pub fn original() -> Self {
        let costs = BspCosts {
            alpha: None,
            ..BspCosts::default()
        };
        Self {
            costs,
            axis_aligned_nodes: false,
            candidate_planes: CandidatePlanes::of_the_paper(),
            ..Self::default()
        }
    }

    /// BSP-tri, every hit confirmed by the kernel (section 4.3). Takes two to five times
    /// as long to build as the default over a mesh, and longer where many triangles overlap.
    ///
    /// C_i is 4 here instead of 1, so that nearly all leaves of a mesh hold one triangle, as
    /// in the paper's Table 3; planes tangent to several triangles are tried, too (section 6.1);
    /// and C_BSP is fixed. The paper has it grow with the triangles, so that a greedy
    /// search does not divide many of them by planes that are slow to traverse. Here such
    /// planes are hardly slower than others, and are only tried where others gain little.
    pub fn with_planar_leaves() -> Self {
        Self {
            costs: BspCosts {
                intersection: 4.0,
                alpha: None,
                ..BspCosts::default()
            },
            single_leaves: SingleLeaves::Planar,
            candidate_planes: CandidatePlanes {
                tangents: 2,
                ..CandidatePlanes::default()
            },
            ..Self::default()
        }
    }

    /// BSP-tri as in the paper, whose hits
    /// [`closest_hit_unconfirmed`](BspTree::closest_hit_unconfirmed) takes from the
    /// traversal (section 4.3).
    ///
    /// C_i is 16 here instead of 1: the more is split, the more triangles are tightly
    /// bound and need no test (section 5.1).
    pub fn with_bounded_leaves() -> Self {
        Self {
            costs: BspCosts {
                intersection: 16.0,
                ..BspCosts::default()
            },
            single_leaves: SingleLeaves::Bounded,
            ..Self::default()
        }
    }

    /// Builds the tree of `primitives`; hits name them by their position there.
    ///
    /// # Errors
    /// Any [`BuildError`] but `Cancelled`.
    pub fn build<P: Polygonal>(&self, primitives: &[P]) -> Result<BspTree<P>, BuildError> {
        self.build_with(primitives, &())
    }

    /// As [`build`](Self::build), telling `observer` how far it is and stopping
    /// when told to.
    ///
    /// # Errors
    /// Any [`BuildError`].
    pub fn build_with<P: Polygonal>(
        &self,
        primitives: &[P],
        observer: &dyn BuildObserver,
    ) -> Result<BspTree<P>, BuildError> {
        self.validate()?;
        self.budget
            .check_bytes(self.working_bytes::<P>(primitives.len()))?;
        let gathered = gather(primitives, self.invalid_primitives)?;
        let (bounds, skipped) = (gathered.bounds, gathered.skipped);
        if gathered.references.is_empty() {
            return Ok(BspTree::empty(primitives, skipped));
        }
        let strategy = Strategy {
            builder: self,
            primitives,
            observer,
        };
        let count = gathered.references.len();
        let task = Task {
            pieces: Pieces::new(primitives, &gathered.references),
            cell: Polytope::of_box(&bounds),
            allowance: Allowance::new::<P>(self, count),
        };
        drop(gathered.references);
        let tree = build_top_down(&strategy, task, 0, observer)?;
        BspTree::pack(self, primitives, &tree, bounds, skipped)
    }

    /// Checks the settings.
    ///
    /// # Errors
    /// [`BuildError::InvalidSetting`] names the first that is out of its range.
    pub fn validate(&self) -> Result<(), BuildError> {
        let reject = |setting, value: String, allowed| {
            Err(BuildError::InvalidSetting {
                setting,
                value,
                allowed,
            })
        };
        self.costs.validate()?;
        self.budget.validate()?;
        self.candidate_planes.validate()?;
        if !(1.0 / (1 << 24) as f64..=1.0 / (1 << 14) as f64).contains(&self.epsilon) {
            return reject("epsilon", self.epsilon.to_string(), "2^-24 to 2^-14");
        }
        if self.sampled_primitives == Some(0) {
            return reject("sampled_primitives", "0".into(), "1 or more");
        }
        if self.max_nodes == Some(0) {
            return reject("max_nodes", "0".into(), "1 or more");
        }
        if self.max_candidates == 0 {
            return reject("max_candidates", "0".into(), "1 or more");
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

    /// How far cells reach over planes: the faces of bounded leaves must be exact.
    pub(crate) fn reach(&self) -> Reach {
        match self.single_leaves {
            SingleLeaves::Bounded => Reach::Exact,
            SingleLeaves::Plain | SingleLeaves::Planar => Reach::Slack,
        }
    }

    /// Bytes that a build of this many references in leaves takes at most, about, the
    /// copies of primitives in the tree included.
    pub fn working_bytes<P: Polygonal>(&self, references: usize) -> usize {
        references.saturating_mul(BYTES_PER_PIECE + bytes_per_reference::<P>())
    }
}

/// Bytes that a piece takes while nodes are divided, what is divided and what has been
/// included.
pub(crate) const BYTES_PER_PIECE: usize = 384;

/// A node to be divided.
struct Task {
    pieces: Pieces,
    cell: Polytope,
    allowance: Allowance,
}

struct Strategy<'a, P> {
    builder: &'a BspBuilder,
    primitives: &'a [P],
    observer: &'a dyn BuildObserver,
}

impl<P: Polygonal> TopDown for Strategy<'_, P> {
    type Task = Task;
    type Node = SplitPlane;

    fn size(&self, task: &Task) -> usize {
        task.pieces.len()
    }

    fn divide(&self, task: Task, depth: u32, leaf: &mut Vec<u32>) -> Division<Self> {
        match self.split(&task, depth) {
            Some((node, children)) => Division::Inner { node, children },
            None => {
                leaf.extend_from_slice(task.pieces.ids());
                Division::Leaf
            }
        }
    }
}

impl<P: Polygonal> Strategy<'_, P> {
    /// The best split that is cheaper than a leaf and cuts the cell cleanly.
    fn split(&self, task: &Task, depth: u32) -> Option<(SplitPlane, [Task; 2])> {
        let (pieces, cell) = (&task.pieces, &task.cell);
        let may_divide = depth < self.builder.budget.max_depth && task.allowance.nodes >= 3;
        // The recursion asks only now and then: leaves bring it there at once.
        if pieces.len() == 0 || !may_divide || self.observer.is_cancelled() {
            return None;
        }
        let leaf_cost = self.builder.costs.heuristic(0.0).leaf_cost(pieces.len());
        let search = Search::new(
            self.builder,
            self.primitives,
            pieces,
            cell,
            task.allowance,
            self.observer,
        );
        let (splits, candidates) = search.run();
        splits.cheaper_than(leaf_cost).find_map(|split| {
            let cells = cell.cut(&split.plane, self.builder.reach()).ok()?;
            let parts = pieces.divide(&split.plane, split.planar_in_front);
            // What the search estimates of thick parts leaves the slack out. Only a split
            // that really gains may be made, or there would be no end of them.
            let areas = cells.each_ref().map(Polytope::area);
            let counts = parts.each_ref().map(Pieces::len);
            let node = (cell.area(), pieces.len());
            let costs = &self.builder.costs;
            if split.visit + costs.of_children(node, areas, counts) >= leaf_cost {
                return None;
            }
            // A plane along an axis that is stored as a general one divides a little
            // otherwise than it was counted.
            let duplicates = counts[0] + counts[1] - pieces.len();
            let left = Allowance {
                duplicates: task.allowance.duplicates.checked_sub(duplicates)?,
                candidates,
                ..task.allowance
            };
            Some((split.plane, children(parts, cells, left)))
        })
    }
}

/// Both tasks, which share what is left.
fn children(parts: [Pieces; 2], cells: [Polytope; 2], left: Allowance) -> [Task; 2] {
    let [behind, in_front] = parts;
    let allowances = left.shared([behind.len(), in_front.len()]);
    let [cell_behind, cell_in_front] = cells;
    [
        Task {
            pieces: behind,
            cell: cell_behind,
            allowance: allowances[0],
        },
        Task {
            pieces: in_front,
            cell: cell_in_front,
            allowance: allowances[1],
        },
    ]
}
