//! The leaves of a structure in an archive: of each the count and the ids of its
//! primitives.

use super::{ArchiveReader, LoadError, check_limit};
use crate::error::ValidationError;
use crate::layout::{LeafStorage, StoredPrimitives};
use crate::primitive::Primitive;

/// Fills a storage from an archive, leaf by leaf. The numbers of leaves are the
/// storage's own, so an archive holds none.
#[derive(Debug)]
pub struct LeafLoader<'a, P: Primitive> {
    primitives: &'a [P],
    stored: StoredPrimitives<P>,
    is_held: Vec<bool>,
}

impl<'a, P: Primitive> LeafLoader<'a, P> {
    /// No leaves yet, over `primitives`, of which the structure skipped as many as
    /// the archive's next word tells.
    ///
    /// # Errors
    /// [`LoadError::WrongLength`] at the end of the archive.
    pub fn new(primitives: &'a [P], archive: &mut ArchiveReader<'_>) -> Result<Self, LoadError> {
        let skipped = archive.word()? as usize;
        Ok(Self {
            primitives,
            stored: StoredPrimitives::new(primitives, skipped, 0),
            is_held: vec![false; primitives.len()],
        })
    }

    /// Reads a leaf and returns its number.
    ///
    /// # Errors
    /// [`LoadError::OutOfRange`] for a leaf of nothing or an id that names no
    /// primitive with valid bounds, [`LoadError::WrongLength`] at the end.
    pub fn read_leaf(&mut self, archive: &mut ArchiveReader<'_>) -> Result<u32, LoadError> {
        let ids = archive.list()?;
        if ids.is_empty() {
            return Err(LoadError::OutOfRange {
                what: "a leaf of primitives",
                value: 0,
                limit: 1,
            });
        }
        for &id in &ids {
            let primitive = self.primitives.get(id as usize);
            if !primitive.is_some_and(|primitive| primitive.bounds().is_valid()) {
                return Err(LoadError::OutOfRange {
                    what: "id",
                    value: u64::from(id),
                    limit: self.primitives.len() as u64,
                });
            }
            self.is_held[id as usize] = true;
        }
        let leaves = self.stored.leaves_mut();
        Ok(leaves.push_leaf(self.primitives, &ids))
    }

    /// The storage, if every primitive but the skipped ones stands in a leaf,
    /// without which it could not be hit.
    ///
    /// # Errors
    /// [`LoadError::Unsound`] names a primitive with valid bounds that does not;
    /// [`LoadError::OutOfRange`] if the number of the others is not that of the skipped.
    pub fn finish(self) -> Result<StoredPrimitives<P>, LoadError> {
        let mut primitives = self.primitives.iter().zip(&self.is_held);
        let is_lost = |(primitive, is_held): (&P, &bool)| !is_held && primitive.bounds().is_valid();
        if let Some(id) = primitives.position(is_lost) {
            let (id, count) = (id as u32, 0);
            return Err(ValidationError::ReferenceCount { id, count }.into());
        }
        let missing = self.is_held.iter().filter(|&&is_held| !is_held).count() as u64;
        let skipped = self.stored.skipped() as u64;
        check_limit("primitives in no leaf", missing, skipped)?;
        check_limit("skipped primitives", skipped, missing)?;
        Ok(self.stored)
    }
}
