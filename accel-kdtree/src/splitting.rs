//! The strategy of the recursion: how one node is divided.

use std::sync::atomic::{AtomicU64, Ordering};

use accel_core::build::{Division, TopDown, share_by_size};
use accel_core::{Aabb, Clip};

use crate::binned::weigh_some;
use crate::division::{DividedParts, divide_parts};
use crate::event::Events;
use crate::part::{Clipper, Part};
use crate::plane::{Candidate, Cheapest, Plane};
use crate::sweep::{divide_events, weigh_all};
use crate::{KdTreeBuilder, PlaneSearch, Work};

/// A node to be divided.
pub(crate) struct Task {
    parts: Vec<Part>,
    /// `None` while the node is large enough to be binned.
    events: Option<Events>,
    cell: Aabb,
    /// How many references the subtree may still add.
    duplicates: usize,
    /// How many splits above were dearer than leaves.
    bad_refines: u32,
}

pub(crate) struct Splitting<'a, P> {
    builder: KdTreeBuilder,
    clipper: Clipper<'a, P>,
    comparisons: AtomicU64,
    references_created: AtomicU64,
}

impl<'a, P: Clip> Splitting<'a, P> {
    pub(crate) fn new(builder: KdTreeBuilder, clipper: Clipper<'a, P>) -> Self {
        Self {
            builder,
            clipper,
            comparisons: AtomicU64::new(0),
            references_created: AtomicU64::new(0),
        }
    }

    pub(crate) fn root(&self, parts: Vec<Part>, cell: Aabb, duplicates: usize) -> Task {
        Task {
            parts,
            events: None,
            cell,
            duplicates,
            bad_refines: 0,
        }
    }

    /// What has been done so far.
    pub(crate) fn work(&self) -> Work {
        Work {
            comparisons: self.comparisons.load(Ordering::Relaxed),
            references_created: self.references_created.load(Ordering::Relaxed),
        }
    }

    fn record(&self, work: &Work) {
        self.comparisons
            .fetch_add(work.comparisons, Ordering::Relaxed);
        self.references_created
            .fetch_add(work.references_created, Ordering::Relaxed);
    }

    /// The cheapest plane, if splitting by it is accepted, and the bad refines
    /// below it.
    fn choose(&self, task: &Task, work: &mut Work) -> Option<(Plane, u32)> {
        let builder = &self.builder;
        let count = task.parts.len();
        let mut cheapest = Cheapest::new(
            &builder.heuristic,
            builder.empty_bonus,
            &task.cell,
            count,
            task.duplicates,
        );
        match (&task.events, builder.search) {
            (Some(events), _) => weigh_all(events, count, &mut cheapest, work),
            (None, PlaneSearch::Binned { bins, .. }) => {
                weigh_some(&task.parts, &task.cell, bins, &mut cheapest, work);
            }
            (None, PlaneSearch::Sweep) => {}
        }
        let Candidate { plane, cost } = cheapest.best()?;
        let leaf_cost = builder.heuristic.leaf_cost(count);
        let termination = &builder.termination;
        let bad_refines = termination.accepts(cost, leaf_cost, count, task.bad_refines)?;
        Some((plane, bad_refines))
    }

    /// Whether a node of this many parts is searched by its events.
    fn is_swept(&self, count: usize) -> bool {
        match self.builder.search {
            PlaneSearch::Sweep => true,
            PlaneSearch::Binned { exact_below, .. } => count < exact_below,
        }
    }

    fn children(&self, task: &Task, plane: &Plane, bad_refines: u32, work: &mut Work) -> [Task; 2] {
        let cells = plane.halves(&task.cell);
        let (parts, events) = match &task.events {
            Some(events) => {
                let divided = DividedParts::new(&self.clipper, &task.parts, plane, &cells);
                let events = divide_events(events, &divided, work);
                (divided.sides.map(|side| side.parts), events.map(Some))
            }
            None => {
                let parts = divide_parts(&self.clipper, &task.parts, plane, &cells);
                (parts, [None, None])
            }
        };
        work.comparisons += 2 * task.parts.len() as u64;
        let sizes = parts.each_ref().map(Vec::len);
        let created = (sizes[0] + sizes[1]).saturating_sub(task.parts.len());
        work.references_created += created as u64;
        let left = task.duplicates.saturating_sub(created);
        let [share_below, share_above] = share_by_size(left, sizes);
        let [parts_below, parts_above] = parts;
        let [events_below, events_above] = events;
        let [cell_below, cell_above] = cells;
        let child = |parts, events, cell, duplicates| Task {
            parts,
            events,
            cell,
            duplicates,
            bad_refines,
        };
        [
            child(parts_below, events_below, cell_below, share_below),
            child(parts_above, events_above, cell_above, share_above),
        ]
    }
}

impl<P: Clip> TopDown for Splitting<'_, P> {
    type Task = Task;
    type Node = Plane;

    fn size(&self, task: &Task) -> usize {
        task.parts.len()
    }

    fn divide(&self, mut task: Task, depth: u32, leaf: &mut Vec<u32>) -> Division<Self> {
        let count = task.parts.len();
        let budget = &self.builder.budget;
        let mut work = Work::default();
        let mut split = None;
        if depth < budget.max_depth && !self.builder.termination.is_leaf(count) {
            if task.events.is_none() && self.is_swept(count) {
                task.events = Some(Events::of(&task.parts, &mut work));
            }
            split = self.choose(&task, &mut work);
        }
        let division = match split {
            Some((plane, bad_refines)) => Division::Inner {
                node: plane,
                children: self.children(&task, &plane, bad_refines, &mut work),
            },
            None => {
                leaf.extend(task.parts.iter().map(|part| part.id));
                Division::Leaf
            }
        };
        self.record(&work);
        division
    }
}
