//! Nodes that wait for a spatial split, and which of them get it.

use crate::Spending;
use crate::node::Node;
use crate::object_split::ObjectCandidate;
use crate::spatial_split::SpatialCandidate;

/// A node whose spatial split is the better one.
#[derive(Debug)]
pub(crate) struct Waiting {
    pub slot: usize,
    pub node: Node,
    pub spatial: SpatialCandidate,
    pub object: ObjectCandidate,
}

/// Whether a node that waits gets its spatial split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Granted,
    /// It would exceed the limit.
    Refused,
}

impl Verdict {
    pub(crate) fn within(demand: usize, limit: usize) -> Self {
        if demand <= limit {
            Self::Granted
        } else {
            Self::Refused
        }
    }
}

/// The nodes that wait, and the references that may still be added.
#[derive(Debug)]
pub(crate) struct WaitingList {
    spending: Spending,
    remaining: usize,
    nodes: Vec<Waiting>,
}

impl Waiting {
    /// The most references that the split adds: unsplitting may save some.
    pub(crate) fn demand(&self) -> usize {
        self.spatial.counts[0] + self.spatial.counts[1] - self.node.count()
    }

    /// The expected cost, over the whole tree, that the split saves for each
    /// reference that it adds.
    fn benefit(&self) -> f64 {
        let saved = (self.object.cost - self.spatial.cost) * self.node.tight.half_area();
        saved / self.demand().max(1) as f64
    }
}

impl WaitingList {
    pub(crate) fn new(spending: Spending, remaining: usize) -> Self {
        Self {
            spending,
            remaining,
            nodes: Vec::new(),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// How many references may still be added.
    pub(crate) fn remaining(&self) -> usize {
        self.remaining
    }

    pub(crate) fn push(&mut self, waiting: Waiting) {
        self.nodes.push(waiting);
    }

    /// Counts references that were added.
    pub(crate) fn spend(&mut self, references: usize) {
        self.remaining -= references;
    }

    /// Takes out the nodes whose time has come: at least one, if any waits.
    pub(crate) fn pick(&mut self) -> Vec<(Waiting, Verdict)> {
        let demand: usize = self.nodes.iter().map(Waiting::demand).sum();
        match self.spending {
            // Far from the limit it does not matter who comes first.
            _ if demand <= self.remaining / 2 => {
                let all = std::mem::take(&mut self.nodes).into_iter();
                all.map(|waiting| (waiting, Verdict::Granted)).collect()
            }
            Spending::BreadthFirst | Spending::Shares => self.pick_level(),
            Spending::ByBenefit => self.pick_best(),
        }
    }

    /// All nodes in their order, until one does not fit: then the limit counts
    /// as reached.
    fn pick_level(&mut self) -> Vec<(Waiting, Verdict)> {
        let mut free = self.remaining;
        let mut is_reached = false;
        let decide = |waiting: Waiting| {
            is_reached |= waiting.demand() > free;
            if is_reached {
                return (waiting, Verdict::Refused);
            }
            free -= waiting.demand();
            (waiting, Verdict::Granted)
        };
        let picked = std::mem::take(&mut self.nodes)
            .into_iter()
            .map(decide)
            .collect();
        if is_reached {
            // Later levels get no more than what unsplitting saves of this one.
            self.remaining -= free;
        }
        picked
    }

    /// The best quarter of the nodes, as far as they fit together, and all that
    /// will never fit. The others wait for what the children of these have to
    /// offer.
    fn pick_best(&mut self) -> Vec<(Waiting, Verdict)> {
        let mut nodes = std::mem::take(&mut self.nodes);
        nodes.sort_by(|a, b| {
            let order = b.benefit().total_cmp(&a.benefit());
            order.then(a.slot.cmp(&b.slot))
        });
        let best = nodes.len().div_ceil(4);
        let mut free = self.remaining;
        let mut picked = Vec::new();
        for (rank, waiting) in nodes.into_iter().enumerate() {
            let demand = waiting.demand();
            if demand > self.remaining {
                picked.push((waiting, Verdict::Refused));
            } else if rank < best && demand <= free {
                free -= demand;
                picked.push((waiting, Verdict::Granted));
            } else {
                self.nodes.push(waiting);
            }
        }
        picked
    }
}
