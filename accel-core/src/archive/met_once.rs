//! Walks over trees that nobody vouches for.

use std::ops::Range;

use super::{LoadError, check_limit};
use crate::build::BuildBudget;

/// The places, be they nodes or words, that the walk over a loaded tree has met. Each
/// belongs to one node with one parent, so that the walk ends, and is met.
#[derive(Clone, Debug)]
pub struct MetOnce {
    is_met: Vec<bool>,
}

impl MetOnce {
    /// None of so many places yet.
    pub fn new(places: usize) -> Self {
        Self {
            is_met: vec![false; places],
        }
    }

    /// Meets a node at this depth, which takes these places.
    ///
    /// # Errors
    /// [`LoadError::OutOfRange`] for a node that is too deep or reaches over the end,
    /// [`LoadError::Meaningless`] for one that takes a place that another one has.
    pub fn meet(&mut self, node: Range<usize>, depth: u32) -> Result<(), LoadError> {
        check_limit("depth", depth.into(), BuildBudget::DEEPEST.into())?;
        let end = self.is_met.len();
        check_limit("a node that ends at place", node.end as u64, end as u64)?;
        for place in node {
            if std::mem::replace(&mut self.is_met[place], true) {
                return Err(LoadError::Meaningless {
                    what: "a second node at place",
                    value: place as u64,
                });
            }
        }
        Ok(())
    }

    /// Checks that all places were met.
    ///
    /// # Errors
    /// [`LoadError::OutOfRange`] if some were not.
    pub fn finish(self) -> Result<(), LoadError> {
        let unmet = self.is_met.iter().filter(|&&is_met| !is_met).count();
        check_limit("places of no node", unmet as u64, 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_is_met_once() {
        let mut met = MetOnce::new(3);
        met.meet(0..2, 0).unwrap();
        let refused = [(1..3, 0), (2..4, 0), (2..3, BuildBudget::DEEPEST + 1)];
        for (node, depth) in refused {
            met.clone().meet(node, depth).unwrap_err();
        }
        met.clone().finish().unwrap_err();
        met.meet(2..3, BuildBudget::DEEPEST).unwrap();
        met.finish().unwrap();
    }
}
