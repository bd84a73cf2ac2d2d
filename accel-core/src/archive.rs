//! Saving structures, and loading them from bytes that nobody vouches for.
//!
//! An archive is little-endian: eight bytes that name the structure, its format's
//! version, a fingerprint of the scene, the structure's own words, and a checksum
//! of all before it. The checksum finds accidents; against anything else a
//! structure validates every word that it reads.

/// Why an archive was not loaded.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// It does not begin as an archive of this structure does.
    #[error(
        "this is no archive of this structure: it begins with {found:02x?}, not {expected:02x?}"
    )]
    WrongKind {
        /// The first bytes.
        found: Vec<u8>,
        /// What they should be.
        expected: [u8; 8],
    },
    /// It was written in another version of the format.
    #[error("the archive has version {found}; this library reads version {expected}")]
    WrongVersion {
        /// Its version.
        found: u32,
        /// The version that is read.
        expected: u32,
    },
    /// It was built over other primitives.
    #[error("the archive is of the scene {found:016x}; the primitives given are {expected:016x}")]
    WrongScene {
        /// The fingerprint in the archive.
        found: u64,
        /// That of the primitives given.
        expected: u64,
    },
    /// Its bytes have changed since it was written.
    #[error(
        "the archive is damaged: its checksum is {found:016x}, but {expected:016x} is recorded"
    )]
    WrongChecksum {
        /// The checksum of its bytes.
        found: u64,
        /// The one recorded.
        expected: u64,
    },
    /// It ends early, or goes on after its end.
    #[error("the archive has {available} bytes where {needed} are needed")]
    WrongLength {
        /// Bytes that its content takes.
        needed: usize,
        /// Bytes that are there.
        available: usize,
    },
    /// A word makes no sense.
    #[error("the archive has {what} {value}, but the limit is {limit}")]
    OutOfRange {
        /// What the word means.
        what: &'static str,
        /// Its value.
        value: u64,
        /// The largest value, or the one expected.
        limit: u64,
    },
}

const KIND_BYTES: usize = 8;
const CHECKSUM_BYTES: usize = 8;

/// The 64-bit hash of Fowler, Noll and Vo (FNV-1a) of a sequence of words, as the
/// fingerprint of a scene.
pub fn fingerprint(words: impl Iterator<Item = u32>) -> u64 {
    words.fold(FNV_START, |hash, word| fnv(hash, &word.to_le_bytes()))
}

const FNV_START: u64 = 0xcbf2_9ce4_8422_2325;

fn fnv(hash: u64, bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(hash, step)
}

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

    /// Adds the checksum.
    pub fn finish(mut self) -> Vec<u8> {
        let checksum = fnv(FNV_START, &self.bytes);
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
        let (found, expected) = (fnv(FNV_START, content), Self { rest: recorded }.long()?);
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

    fn archive() -> Vec<u8> {
        let mut writer = ArchiveWriter::new(KIND, 3, 77);
        writer.push(2);
        writer.push(9);
        writer.push(8);
        writer.finish()
    }

    #[test]
    fn words_come_back_and_the_end_is_checked() {
        let bytes = archive();
        let mut reader = ArchiveReader::new(&bytes, KIND, 3, 77).unwrap();
        assert_eq!(reader.count(1), Ok(2));
        assert!(reader.finish().is_err());
        assert_eq!((reader.word(), reader.word()), (Ok(9), Ok(8)));
        assert!(reader.finish().is_ok() && reader.word().is_err());
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
