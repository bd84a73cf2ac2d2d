//! Damaged archives.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::archive::checksum;

/// Copies of an archive with one to three bits changed, or a whole word. Three of
/// four are signed again, so that their damage passes the checksum and meets the
/// checks behind it.
pub(super) fn damaged_archives(archive: &[u8], count: usize) -> impl Iterator<Item = Vec<u8>> {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let content = archive.len() - size_of::<u64>();
    (0..count).map(move |round| {
        let mut damaged = archive.to_vec();
        for _ in 0..1 + random.random_range(0..3) {
            let position = random.random_range(0..content);
            if random.random_range(0..8) == 0 {
                let word = position / 4 * 4;
                let end = (word + 4).min(content);
                let value: [u8; 4] = random.random();
                damaged[word..end].copy_from_slice(&value[..end - word]);
            } else {
                damaged[position] ^= 1 << random.random_range(0..8);
            }
        }
        if round % 4 != 0 {
            let sum = checksum(&damaged[..content]).to_le_bytes();
            damaged[content..].copy_from_slice(&sum);
        }
        damaged
    })
}
