//! The leaves of a structure in an archive: of each the count and the ids of its
//! primitives.

use super::{ArchiveReader, ArchiveWriter, LoadError, check_limit};
use crate::error::ValidationError;
use crate::layout::{LeafStorage, StoredPrimitives};
use crate::primitive::Primitive;

impl ArchiveWriter {
    /// Adds a leaf of a storage: its count of primitives and their ids.
    pub fn push_leaf<P: Primitive>(&mut self, leaves: &impl LeafStorage<P>, leaf: u32) {
        let ids: Vec<u32> = leaves.leaf_ids(leaf).collect();
        self.push_list(ids.into_iter());
    }
}

/// Fills a storage from an archive, leaf by leaf. The numbers of leaves are the
/// storage's own, so an archive holds none.
#[derive(Debug)]
pub struct LeafLoader<'a, P: Primitive> {
    primitives: &'a [P],
    stored: StoredPrimitives<P>,
    leaves: u32,
    /// By primitive, how many leaves there were when it was last read; 0 for never.
    last_leaf: Vec<u32>,
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
            leaves: 0,
            last_leaf: vec![0; primitives.len()],
        })
    }

    /// Reads a leaf and returns its number.
    ///
    /// # Errors
    /// [`LoadError::Meaningless`] for a leaf of nothing or one that holds a primitive
    /// twice, [`LoadError::OutOfRange`] for an id that names no primitive,
    /// [`LoadError::Unsound`] for that of one without valid bounds,
    /// [`LoadError::WrongLength`] at the end.
    pub fn read_leaf(&mut self, archive: &mut ArchiveReader<'_>) -> Result<u32, LoadError> {
        let ids = archive.list()?;
        if ids.is_empty() {
            return Err(LoadError::Meaningless {
                what: "a leaf of nothing, after so many others",
                value: self.leaves.into(),
            });
        }
        self.leaves += 1;
        for &id in &ids {
            let count = self.primitives.len() as u64;
            check_limit("so many primitives, by an id:", u64::from(id) + 1, count)?;
            if !self.primitives[id as usize].bounds().is_valid() {
                let count = 1;
                return Err(ValidationError::ReferenceCount { id, count }.into());
            }
            let last = std::mem::replace(&mut self.last_leaf[id as usize], self.leaves);
            if last == self.leaves {
                return Err(LoadError::Meaningless {
                    what: "a leaf that holds twice the primitive",
                    value: id.into(),
                });
            }
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
        let mut primitives = self.primitives.iter().zip(&self.last_leaf);
        let is_lost = |(primitive, &last): (&P, &u32)| last == 0 && primitive.bounds().is_valid();
        if let Some(id) = primitives.position(is_lost) {
            let (id, count) = (id as u32, 0);
            return Err(ValidationError::ReferenceCount { id, count }.into());
        }
        let missing = self.last_leaf.iter().filter(|&&last| last == 0).count() as u64;
        let skipped = self.stored.skipped() as u64;
        check_limit("primitives in no leaf", missing, skipped)?;
        check_limit("skipped primitives", skipped, missing)?;
        Ok(self.stored)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triangle;

    /// What comes of an archive of these leaves over a triangle and one that is skipped.
    fn load(leaves: &[&[u32]]) -> Result<(), LoadError> {
        let valid = Triangle::new([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let triangles = [valid, Triangle::new([f32::NAN; 3], [1.0; 3], [2.0; 3])];
        let mut writer = ArchiveWriter::new(*b"testkind", 1, 0);
        writer.push(1);
        leaves
            .iter()
            .for_each(|ids| writer.push_list(ids.iter().copied()));
        let bytes = writer.finish();
        let mut archive = ArchiveReader::new(&bytes, *b"testkind", 1, 0)?;
        let mut loader = LeafLoader::new(&triangles, &mut archive)?;
        for _ in leaves {
            loader.read_leaf(&mut archive)?;
        }
        loader.finish().map(|_| ())
    }

    #[test]
    fn leaves_hold_every_primitive_and_none_twice() {
        assert_eq!(load(&[&[0], &[0]]), Ok(()));
        let lost = ValidationError::ReferenceCount { id: 0, count: 0 };
        assert_eq!(load(&[]), Err(lost.into()));
        let invalid = ValidationError::ReferenceCount { id: 1, count: 1 };
        assert_eq!(load(&[&[0, 1]]), Err(invalid.into()));
        for (leaves, part) in [
            (&[0, 0][..], "twice the primitive: 0x0"),
            (&[], "a leaf of nothing"),
            (&[2], "3, but the limit is 2"),
        ] {
            let message = load(&[leaves]).unwrap_err().to_string();
            assert!(message.contains(part), "{message}");
        }
    }
}
