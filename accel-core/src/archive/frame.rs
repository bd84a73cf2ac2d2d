//! The frame: what stands before and behind a structure's own words.

use super::{LoadError, checksum};
use crate::geometry::Aabb;
use crate::glam::Vec3;

const KIND_BYTES: usize = 8;
const CHECKSUM_BYTES: usize = 8;

/// Writes an archive word by word.
#[derive(Clone, Debug)]
pub struct ArchiveWriter {
    bytes: Vec<u8>,
}

impl ArchiveWriter {
    /// An archive of a structure of this kind, version and scene.
    pub fn new(kind: [u8; 8], version: u32, scene: u64) -> Self {
        let mut bytes = kind.to_vec();
        bytes.extend(version.to_le_bytes());
        bytes.extend(scene.to_le_bytes());
        Self { bytes }
    }

    /// Adds a word.
    pub fn push(&mut self, word: u32) {
        self.bytes.extend(word.to_le_bytes());
    }

    /// Adds a box, six words.
    pub fn push_bounds(&mut self, bounds: &Aabb) {
        for coordinate in [bounds.min, bounds.max]
            .into_iter()
            .flat_map(|v| v.to_array())
        {
            self.push(coordinate.to_bits());
        }
    }

    /// Adds a count and as many words.
    pub fn push_list(&mut self, words: impl ExactSizeIterator<Item = u32>) {
        self.push(words.len() as u32);
        words.for_each(|word| self.push(word));
    }

    /// Adds the checksum.
    pub fn finish(mut self) -> Vec<u8> {
        let checksum = checksum(&self.bytes);
        self.bytes.extend(checksum.to_le_bytes());
        self.bytes
    }
}

/// Reads an archive word by word; never beyond its end, and never into more memory
/// than the archive itself takes.
#[derive(Clone, Copy, Debug)]
pub struct ArchiveReader<'a> {
    rest: &'a [u8],
}

impl<'a> ArchiveReader<'a> {
    /// Opens an archive of this kind, version and scene.
    ///
    /// # Errors
    /// A [`LoadError`] if it is none, or damaged.
    pub fn new(
        bytes: &'a [u8],
        kind: [u8; 8],
        version: u32,
        scene: u64,
    ) -> Result<Self, LoadError> {
        let needed = KIND_BYTES + 4 + 8 + CHECKSUM_BYTES;
        let available = bytes.len();
        if !bytes.starts_with(&kind) {
            return Err(LoadError::WrongKind {
                found: bytes[..available.min(KIND_BYTES)].to_vec(),
                expected: kind,
            });
        }
        if available < needed {
            return Err(LoadError::WrongLength { needed, available });
        }
        let (content, recorded) = bytes.split_at(available - CHECKSUM_BYTES);
        let mut reader = Self {
            rest: &content[KIND_BYTES..],
        };
        let found = reader.word()?;
        if found != version {
            return Err(LoadError::WrongVersion {
                found,
                expected: version,
            });
        }
        let (found, expected) = (checksum(content), Self { rest: recorded }.long()?);
        if found != expected {
            return Err(LoadError::WrongChecksum { found, expected });
        }
        let found = reader.long()?;
        if found != scene {
            return Err(LoadError::WrongScene {
                found,
                expected: scene,
            });
        }
        Ok(reader)
    }

    /// The next word.
    ///
    /// # Errors
    /// [`LoadError::WrongLength`] at the end.
    pub fn word(&mut self) -> Result<u32, LoadError> {
        let (first, rest) = self
            .rest
            .split_first_chunk()
            .ok_or(LoadError::WrongLength {
                needed: 4,
                available: self.rest.len(),
            })?;
        self.rest = rest;
        Ok(u32::from_le_bytes(*first))
    }

    fn long(&mut self) -> Result<u64, LoadError> {
        let (low, high) = (self.word()?, self.word()?);
        Ok(u64::from(low) | u64::from(high) << 32)
    }

    /// The next word, how many items of `words` words each follow at least: at
    /// most as many as the archive has room for.
    ///
    /// # Errors
    /// [`LoadError::WrongLength`] if there is no room for as many.
    pub fn count(&mut self, words: usize) -> Result<usize, LoadError> {
        let count = self.word()? as usize;
        let needed = count.saturating_mul(words * 4);
        if needed > self.rest.len() {
            let available = self.rest.len();
            return Err(LoadError::WrongLength { needed, available });
        }
        Ok(count)
    }

    /// The next six words: a box, valid or empty.
    ///
    /// # Errors
    /// [`LoadError::Meaningless`] for any other box, [`LoadError::WrongLength`] at
    /// the end.
    pub fn bounds(&mut self) -> Result<Aabb, LoadError> {
        let mut corner = || -> Result<Vec3, LoadError> {
            let mut coordinate = || self.word().map(f32::from_bits);
            Ok(Vec3::new(coordinate()?, coordinate()?, coordinate()?))
        };
        let bounds = Aabb::new(corner()?, corner()?);
        if bounds.is_valid() || bounds == Aabb::EMPTY {
            Ok(bounds)
        } else {
            Err(LoadError::Meaningless {
                what: "a box that is not finite, with the least x of the bits",
                value: bounds.min.x.to_bits().into(),
            })
        }
    }

    /// The next word, a count, and as many words.
    ///
    /// # Errors
    /// [`LoadError::WrongLength`] if there are not as many.
    pub fn list(&mut self) -> Result<Vec<u32>, LoadError> {
        let count = self.count(1)?;
        (0..count).map(|_| self.word()).collect()
    }

    /// Checks that nothing is left.
    ///
    /// # Errors
    /// [`LoadError::WrongLength`] if something is.
    pub fn finish(self) -> Result<(), LoadError> {
        match self.rest.len() {
            0 => Ok(()),
            available => Err(LoadError::WrongLength {
                needed: 0,
                available,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KIND: [u8; 8] = *b"testkind";
    const BOUNDS: Aabb = Aabb {
        min: Vec3::ZERO,
        max: Vec3::ONE,
    };

    fn archive() -> Vec<u8> {
        let mut writer = ArchiveWriter::new(KIND, 3, 77);
        writer.push_list([9, 8].into_iter());
        writer.push_bounds(&BOUNDS);
        writer.finish()
    }

    #[test]
    fn words_come_back_and_the_end_is_checked() {
        let bytes = archive();
        let mut reader = ArchiveReader::new(&bytes, KIND, 3, 77).unwrap();
        assert_eq!(reader.list(), Ok(vec![9, 8]));
        assert!(reader.finish().is_err());
        assert_eq!(reader.bounds(), Ok(BOUNDS));
        assert!(reader.finish().is_ok() && reader.word().is_err());
    }

    #[test]
    fn counts_beyond_the_end_and_boxes_without_sense_are_refused() {
        let mut writer = ArchiveWriter::new(KIND, 3, 77);
        writer.push_bounds(&Aabb::new([1.0; 3], [f32::NAN; 3]));
        writer.push(u32::MAX);
        let bytes = writer.finish();
        let mut reader = ArchiveReader::new(&bytes, KIND, 3, 77).unwrap();
        let error = reader.bounds().unwrap_err();
        assert!(matches!(error, LoadError::Meaningless { .. }), "{error}");
        let error = reader.list().unwrap_err();
        assert!(matches!(error, LoadError::WrongLength { .. }), "{error}");
    }

    #[test]
    fn other_kinds_versions_scenes_and_every_changed_byte_are_refused() {
        let bytes = archive();
        fn open(bytes: &[u8], kind: [u8; 8], version: u32, scene: u64) -> LoadError {
            ArchiveReader::new(bytes, kind, version, scene).unwrap_err()
        }
        assert!(matches!(
            open(&bytes, *b"otherone", 3, 77),
            LoadError::WrongKind { .. }
        ));
        assert!(matches!(
            open(&bytes, KIND, 4, 77),
            LoadError::WrongVersion { found: 3, .. }
        ));
        assert!(matches!(
            open(&bytes, KIND, 3, 78),
            LoadError::WrongScene { found: 77, .. }
        ));
        for position in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[position] ^= 0x10;
            open(&changed, KIND, 3, 77);
            open(&bytes[..position], KIND, 3, 77);
        }
    }
}
