//! What every structure holds besides its nodes.

use std::fmt;
use std::marker::PhantomData;

use super::LeafStorage;
use crate::primitive::Primitive;

/// The primitives of a structure in their leaves, and what became of the slice
/// that it was built over.
#[derive(Clone)]
pub struct StoredPrimitives<P: Primitive, L: LeafStorage<P> = <P as Primitive>::Storage> {
    leaves: L,
    count: usize,
    skipped: usize,
    primitive: PhantomData<fn() -> P>,
}

impl<P: Primitive, L: LeafStorage<P>> StoredPrimitives<P, L> {
    /// No leaves yet, over `primitives`, of which `skipped` are left out, with
    /// room for `references` references.
    pub fn new(primitives: &[P], skipped: usize, references: usize) -> Self {
        Self {
            leaves: L::with_capacity(primitives, references),
            count: primitives.len(),
            skipped,
            primitive: PhantomData,
        }
    }

    /// No leaves yet, in another storage, over the same primitives, and these by
    /// id to add leaves with. What no leaf holds has another primitive in its place.
    pub fn emptied<M: LeafStorage<P>>(&self) -> (StoredPrimitives<P, M>, Vec<P>) {
        let held: Vec<Option<P>> = (0..self.count as u32)
            .map(|id| self.leaves.primitive(id))
            .collect();
        let some = held.iter().flatten().next().cloned();
        let primitives = held
            .into_iter()
            .filter_map(|held| held.or_else(|| some.clone()));
        let primitives: Vec<P> = primitives.collect();
        let emptied = StoredPrimitives {
            leaves: M::with_capacity(&primitives, self.leaves.reference_count()),
            count: self.count,
            skipped: self.skipped,
            primitive: PhantomData,
        };
        (emptied, primitives)
    }

    /// The leaves.
    #[inline]
    pub fn leaves(&self) -> &L {
        &self.leaves
    }

    /// The leaves, to add to or to refit.
    pub fn leaves_mut(&mut self) -> &mut L {
        &mut self.leaves
    }

    /// How many primitives the structure was built over, skipped ones included.
    pub fn count(&self) -> usize {
        self.count
    }

    /// How many of them were left out because their bounds are not finite.
    pub fn skipped(&self) -> usize {
        self.skipped
    }
}

/// The counts, not the primitives: there may be millions, and their type need not
/// be printable.
impl<P: Primitive, L: LeafStorage<P>> fmt::Debug for StoredPrimitives<P, L> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("StoredPrimitives")
            .field("count", &self.count)
            .field("skipped", &self.skipped)
            .field("references", &self.leaves.reference_count())
            .finish()
    }
}
