//! Saving structures, and loading them from bytes that nobody vouches for.
//!
//! An archive is little-endian: eight bytes that name the structure, its format's
//! version, a fingerprint of the scene, the structure's own words, and a checksum
//! of all before it. The checksum finds accidents; against anything else a
//! structure validates every word that it reads. Primitives are not saved: the
//! fingerprint knows them.

mod frame;
mod leaves;
mod met_once;
mod saved;
mod scene;

use crate::error::ValidationError;

pub use frame::{ArchiveReader, ArchiveWriter};
pub use leaves::LeafLoader;
pub use met_once::MetOnce;
pub use saved::{Archive, ReadError};
pub use scene::{bounds_of_hits, bounds_of_scene, scene_of_slice, scene_of_structure};

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
    /// A number is too large.
    #[error("the archive has {what} {value}, but the limit is {limit}")]
    OutOfRange {
        /// What the number means.
        what: &'static str,
        /// Its value.
        value: u64,
        /// The largest value.
        limit: u64,
    },
    /// Words have no meaning.
    #[error("the archive has {what}: {value:#x}")]
    Meaningless {
        /// What is wrong.
        what: &'static str,
        /// The words, or the number of what they describe.
        value: u64,
    },
    /// It holds a tree that could lose hits.
    #[error("the archive holds no sound tree: {0}")]
    Unsound(#[from] ValidationError),
}

/// [`LoadError::OutOfRange`] unless `value` is at most `limit`.
///
/// # Errors
/// See above.
pub fn check_limit(what: &'static str, value: u64, limit: u64) -> Result<(), LoadError> {
    if value <= limit {
        Ok(())
    } else {
        Err(LoadError::OutOfRange { what, value, limit })
    }
}

const FNV_START: u64 = 0xcbf2_9ce4_8422_2325;

fn fnv(hash: u64, bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(hash, step)
}

/// The checksum of an archive's bytes.
pub(crate) fn checksum(bytes: &[u8]) -> u64 {
    fnv(FNV_START, bytes)
}
