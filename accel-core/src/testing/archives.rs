//! Checks of what is saved and loaded.

use std::io::{self, Write};

use super::damage::damaged_archives;
use crate::archive::{Archive, ReadError};
use crate::ray::RaySegment;

/// Saves a structure and loads it, as bytes and through a reader and a writer: it must
/// have the same bytes and the same answers again, and be refused over other primitives
/// and beyond the reader's limit. Returns what was loaded.
///
/// # Panics
/// If it does not.
pub fn check_round_trip<A: Archive>(
    structure: &A,
    primitives: &[A::Primitive],
    rays: &[RaySegment],
) -> A {
    let bytes = structure.to_bytes();
    let mut written = Vec::new();
    structure
        .write_to(&mut written)
        .expect("memory takes all bytes");
    assert!(written == bytes);
    let length = bytes.len() as u64;
    let read = A::read_from(bytes.as_slice(), length, primitives).expect("it is sound");
    assert!(read.to_bytes() == bytes);
    let loaded = A::from_bytes(&bytes, primitives).expect("it is sound");
    assert!(loaded.to_bytes() == bytes);
    assert_eq!(loaded.skipped_count(), structure.skipped_count());
    assert_eq!(loaded.bounds(), structure.bounds());
    assert!(structure.write_to(FullDisk).is_err());
    for ray in rays {
        let hit = structure.closest_hit(ray);
        assert_eq!(loaded.closest_hit(ray), hit, "{ray:?}");
        assert_eq!(read.closest_hit(ray), hit, "{ray:?}");
        assert_eq!(loaded.all_hits(ray), structure.all_hits(ray), "{ray:?}");
    }
    let too_long = A::read_from(bytes.as_slice(), length - 1, primitives);
    let is_named = matches!(too_long, Err(ReadError::TooLong { limit }) if limit == length - 1);
    assert!(is_named);
    if let Some((_, others)) = primitives.split_first() {
        assert!(A::from_bytes(&bytes, others).is_err());
    }
    loaded
}

/// Takes all bytes, and loses them when flushed.
struct FullDisk;

impl Write for FullDisk {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Err(io::ErrorKind::StorageFull.into())
    }
}

/// Loads `count` damaged copies of a saved structure, and has `check` look at those that
/// are not refused. Returns how many were refused and how many were not.
pub fn load_damaged<A: Archive>(
    structure: &A,
    primitives: &[A::Primitive],
    count: usize,
    mut check: impl FnMut(&A),
) -> [usize; 2] {
    let mut counts = [0; 2];
    for damaged in damaged_archives(&structure.to_bytes(), count) {
        match A::from_bytes(&damaged, primitives) {
            Err(error) => {
                assert!(!error.to_string().is_empty());
                counts[0] += 1;
            }
            Ok(loaded) => {
                check(&loaded);
                counts[1] += 1;
            }
        }
    }
    counts
}
