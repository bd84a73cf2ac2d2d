//! The stack of nodes that a traversal has put off.

use arrayvec::ArrayVec;

use crate::build::BuildBudget;

/// A node put off, and where the ray enters it.
#[derive(Clone, Copy, Debug)]
pub struct StackEntry<N> {
    /// The node.
    pub node: N,
    /// The ray parameter at which the ray enters it.
    pub near: f32,
}

/// A stack for depth-first traversal of binary trees, which put off at most one
/// node per level: it holds as many entries as the deepest tree has levels, so
/// it never overflows on a tree within [`BuildBudget::DEEPEST`]. It lives in the
/// frame of the traversal and is not cleared at its start.
#[derive(Clone, Debug)]
pub struct TraversalStack<N> {
    entries: ArrayVec<StackEntry<N>, { BuildBudget::DEEPEST as usize + 8 }>,
}

impl<N: Copy> TraversalStack<N> {
    /// An empty stack.
    #[inline]
    pub fn new() -> Self {
        Self {
            entries: ArrayVec::new(),
        }
    }

    /// Puts `node` off.
    ///
    /// # Panics
    /// If the tree is deeper than [`BuildBudget::DEEPEST`].
    #[inline]
    pub fn push(&mut self, node: N, near: f32) {
        self.entries.push(StackEntry { node, near });
    }

    /// As [`push`](Self::push) if `is_put_off`, without a branch on it: for a
    /// condition that is hard to predict.
    ///
    /// # Panics
    /// As [`push`](Self::push), whether it is put off or not.
    #[inline]
    pub fn push_if(&mut self, is_put_off: bool, node: N, near: f32) {
        self.push(node, near);
        let kept = self.entries.len() - usize::from(!is_put_off);
        self.entries.truncate(kept);
    }

    /// The node put off last that the ray enters no later than `t_max`; those
    /// entered later are dropped. Strictly later: a hit there could still tie.
    #[inline]
    pub fn pop_within(&mut self, t_max: f32) -> Option<N> {
        self.pop_entry_within(t_max).map(|entry| entry.node)
    }

    /// As [`pop_within`](Self::pop_within), with where the ray enters the node.
    #[inline]
    pub fn pop_entry_within(&mut self, t_max: f32) -> Option<StackEntry<N>> {
        loop {
            let entry = self.entries.pop()?;
            if entry.near <= t_max {
                return Some(entry);
            }
        }
    }
}

/// As [`TraversalStack`], for trees of up to eight children a node, of which all
/// but one may be put off.
#[derive(Clone, Debug)]
pub struct WideStack<N> {
    entries: ArrayVec<StackEntry<N>, { 7 * BuildBudget::DEEPEST as usize + 8 }>,
}

impl<N: Copy> WideStack<N> {
    /// An empty stack.
    #[inline]
    pub fn new() -> Self {
        Self {
            entries: ArrayVec::new(),
        }
    }

    /// How many nodes are put off.
    #[inline]
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether none is.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Puts `node` off.
    ///
    /// # Panics
    /// If the tree is deeper than [`BuildBudget::DEEPEST`].
    #[inline(always)]
    pub fn push(&mut self, node: N, near: f32) {
        self.entries.push(StackEntry { node, near });
    }

    /// The node put off last.
    #[inline(always)]
    pub fn pop(&mut self) -> Option<N> {
        Some(self.entries.pop()?.node)
    }

    /// Puts `node` off, below those entries from `first` on that the ray enters
    /// before it: the node's siblings, put off in any order, are taken from the
    /// nearest to the farthest.
    ///
    /// # Panics
    /// If the tree is deeper than [`BuildBudget::DEEPEST`].
    #[inline(always)]
    pub fn push_sorted(&mut self, node: N, near: f32, first: usize) {
        self.entries.push(StackEntry { node, near });
        let siblings = &mut self.entries[first..];
        let mut place = siblings.len() - 1;
        while place > 0 && siblings[place - 1].near < near {
            siblings.swap(place, place - 1);
            place -= 1;
        }
    }

    /// As [`TraversalStack::pop_within`].
    #[inline(always)]
    pub fn pop_within(&mut self, t_max: f32) -> Option<N> {
        self.pop_entry_within(t_max).map(|entry| entry.node)
    }

    /// As [`TraversalStack::pop_entry_within`].
    #[inline(always)]
    pub fn pop_entry_within(&mut self, t_max: f32) -> Option<StackEntry<N>> {
        loop {
            let entry = self.entries.pop()?;
            if entry.near <= t_max {
                return Some(entry);
            }
        }
    }
}

impl<N: Copy> Default for WideStack<N> {
    fn default() -> Self {
        Self::new()
    }
}

/// As [`TraversalStack`], for packets: when an entry still matters is theirs to
/// say.
#[derive(Clone, Debug)]
pub struct PacketStack<E> {
    entries: ArrayVec<E, { BuildBudget::DEEPEST as usize + 8 }>,
}

impl<E> PacketStack<E> {
    /// An empty stack.
    #[inline(always)]
    pub fn new() -> Self {
        Self {
            entries: ArrayVec::new(),
        }
    }

    /// Puts `entry` off.
    ///
    /// # Panics
    /// If the tree is deeper than [`BuildBudget::DEEPEST`].
    #[inline(always)]
    pub fn push(&mut self, entry: E) {
        self.entries.push(entry);
    }

    /// The entry put off last.
    #[inline(always)]
    pub fn pop(&mut self) -> Option<E> {
        self.entries.pop()
    }
}

impl<E> Default for PacketStack<E> {
    fn default() -> Self {
        Self::new()
    }
}

impl<N: Copy> Default for TraversalStack<N> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_beyond_the_best_hit_are_dropped_and_ties_kept() {
        let mut stack = TraversalStack::new();
        for (node, near) in [(1, 5.0), (2, 3.0), (3, 4.0)] {
            stack.push(node, near);
            stack.push_if(false, 10 + node, near);
        }
        assert_eq!(stack.pop_within(3.0), Some(2));
        assert_eq!(stack.pop_within(4.0), None);
    }

    #[test]
    fn siblings_are_taken_from_the_nearest_to_the_farthest() {
        let mut stack = WideStack::new();
        stack.push(0, 0.5);
        let bottom = stack.len();
        for (node, near) in [(1, 2.0), (2, 1.0), (3, 3.0), (4, 1.5)] {
            stack.push_sorted(node, near, bottom);
        }
        let order: Vec<_> = std::iter::from_fn(|| stack.pop_within(9.0)).collect();
        assert_eq!(order, [2, 4, 1, 3, 0]);
    }
}
