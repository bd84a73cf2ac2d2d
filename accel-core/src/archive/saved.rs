//! What every structure that is saved and loaded offers.

use std::error::Error;
use std::io::{self, Read, Write};

use super::LoadError;
use crate::structure::AccelerationStructure;

/// A structure that can be saved, without its primitives, and loaded again.
///
/// The bytes are the same on any machine, and may come from anywhere: damage is found by
/// a checksum, and every word is validated, so that whatever loads answers each query in
/// bounded time and memory. Whoever forges the checksum, too, can move planes or
/// references so that a tree loses hits.
pub trait Archive: AccelerationStructure + Sized {
    /// Why an archive is refused.
    type Error: Error + From<LoadError>;

    /// The structure as bytes.
    fn to_bytes(&self) -> Vec<u8>;

    /// The structure that [`to_bytes`](Self::to_bytes) saved, over the same primitives.
    ///
    /// # Errors
    /// Names what is wrong.
    fn from_bytes(bytes: &[u8], primitives: &[Self::Primitive]) -> Result<Self, Self::Error>;

    /// Writes the structure to a file, or to whatever else takes bytes, and flushes it. No
    /// buffer is needed between.
    ///
    /// # Errors
    /// The writer's.
    fn write_to(&self, mut writer: impl Write) -> io::Result<()> {
        writer.write_all(&self.to_bytes())?;
        writer.flush()
    }

    /// Reads all that a reader gives, at most `max_bytes`: the structure that
    /// [`write_to`](Self::write_to) wrote, over the same primitives.
    ///
    /// # Errors
    /// A [`ReadError`]: the reader's, that of an archive larger than `max_bytes`, of
    /// which no more is read, or what [`from_bytes`](Self::from_bytes) answers.
    fn read_from(
        reader: impl Read,
        max_bytes: u64,
        primitives: &[Self::Primitive],
    ) -> Result<Self, ReadError<Self::Error>> {
        let mut bytes = Vec::new();
        let one_more = max_bytes.saturating_add(1);
        reader.take(one_more).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > max_bytes {
            return Err(ReadError::TooLong { limit: max_bytes });
        }
        Self::from_bytes(&bytes, primitives).map_err(ReadError::Load)
    }
}

/// Why nothing was loaded from a reader.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError<E: Error> {
    /// The reader failed.
    #[error("the archive can't be read: {0}")]
    Read(#[from] io::Error),
    /// There are more bytes than may be kept.
    #[error("the archive has more than {limit} bytes, the limit")]
    TooLong {
        /// The limit.
        limit: u64,
    },
    /// The archive was refused.
    #[error(transparent)]
    Load(E),
}
