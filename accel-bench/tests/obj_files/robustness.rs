//! Damaged files never panic, and what loads is consistent.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::read_bytes;

const SEED_FILE: &[u8] = b"\xEF\xBB\xBF# a small file of all that is read\r\n\
mtllib a.mtl\no box\nv 0 0 0\nv 1.0 0 0 1\nv 1e0 +1 0 0.5 0.5 0.5\nv 0 1 -0.5\nv 2 1 \\\n 0\n\
vt 0.5\nvn 0 0 1\ng a b\nusemtl m\ns 1\nf 1 2 3 # t\nf 1/1 3/1/1 4//1\nl 1 2\np 1\n\
f -1 -2 -3 -4\rf 1 2 5 3 4\ncurv 0 1 1 2\nf 2 2 3\n";

/// Pieces of which many a mistake is made.
const PIECES: &[&[u8]] = &[
    b"\n",
    b"\r",
    b"\r\n",
    b"\\\n",
    b"#",
    b"\\",
    b"/",
    b"//",
    b" ",
    b"\t",
    b"-",
    b"+",
    b".",
    b"e",
    b"0",
    b"9",
    b"nan",
    b"inf",
    b"1e39",
    b"-0",
    b"1e-50",
    b"v ",
    b"f ",
    b"l ",
    b"vt ",
    b"o ",
    b"usemtl",
    b"4294967297",
    b"6148914691236517206",
    b"-9223372036854775808",
    b"\0",
    b"\xFF",
    b"\xFF\xFE",
    b"\xEF\xBB\xBF",
    b"\xC3\xA9",
    b"f 1 2 3 4 5\n",
    b"f 5 1 4 2 3\n",
    b"v nan 0 0\n",
];

fn mutate(bytes: &mut Vec<u8>, rng: &mut Pcg64Mcg) {
    let at = rng.random_range(0..=bytes.len());
    let end = rng.random_range(at..=bytes.len().min(at + 20));
    match rng.random_range(0..6) {
        0 => bytes.truncate(at),
        1 => drop(bytes.drain(at..end)),
        2 => bytes[at..end].fill_with(|| rng.random()),
        3 => {
            let copy = bytes[at..end].to_vec();
            let target = rng.random_range(0..=bytes.len());
            bytes.splice(target..target, copy);
        }
        _ => {
            let piece = PIECES[rng.random_range(0..PIECES.len())];
            bytes.splice(at..at, piece.iter().copied());
        }
    }
}

#[test]
fn mutated_files_are_refused_with_a_place_or_load_consistently() {
    let mut rng = Pcg64Mcg::seed_from_u64(0x0B1);
    let (mut loaded, mut refused) = (0, 0);
    for _ in 0..50_000 {
        let mut bytes = SEED_FILE.to_vec();
        for _ in 0..rng.random_range(1..=4) {
            mutate(&mut bytes, &mut rng);
        }
        match read_bytes(&bytes) {
            Ok(file) => {
                loaded += 1;
                let vertices = file.mesh.positions.len() as u32;
                assert!(!file.mesh.triangles.is_empty());
                assert!(
                    file.mesh
                        .triangles
                        .iter()
                        .flatten()
                        .all(|&index| index < vertices)
                );
            }
            Err(error) => {
                refused += 1;
                assert!(error.to_string().starts_with("scene.obj:"), "{error}");
                assert!(!error.to_string().contains("parser failed"), "{error}");
            }
        }
    }
    assert!(
        loaded > 5_000 && refused > 5_000,
        "{loaded} loaded, {refused} refused"
    );
}

#[test]
fn every_truncation_is_refused_with_a_place_or_loads() {
    let whole = read_bytes(SEED_FILE).expect("the undamaged file").mesh;
    assert_eq!((whole.positions.len(), whole.triangles.len()), (5, 8));
    for length in 0..SEED_FILE.len() {
        match read_bytes(&SEED_FILE[..length]) {
            Ok(file) => assert!(file.mesh.triangles.len() <= whole.triangles.len()),
            Err(error) => assert!(error.to_string().starts_with("scene.obj:"), "{error}"),
        }
    }
}
