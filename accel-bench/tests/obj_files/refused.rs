//! Files that are refused, with the whole message.

use std::io::{self, BufReader, Read};
use std::path::Path;

use accel_bench::scene::obj::{ObjError, ObjLimits, StatementError, read};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::read_bytes;

/// Name, file, and the message after `scene.obj`.
const REFUSED: &[(&str, &[u8], &str)] = &[
    (
        "empty file",
        b"",
        ": holds no triangles (lines: 0, vertices: 0, faces: 0)",
    ),
    (
        "only comments",
        b"# a\n# b\n\n",
        ": holds no triangles (lines: 3, vertices: 0, faces: 0)",
    ),
    (
        "only a byte order mark",
        b"\xEF\xBB\xBF",
        ": holds no triangles (lines: 1, vertices: 0, faces: 0)",
    ),
    (
        "only vertices",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\n",
        ": holds no triangles (lines: 3, vertices: 3, faces: 0)",
    ),
    (
        "only polylines",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n",
        ": holds no triangles (lines: 4, vertices: 3, faces: 0)",
    ),
    (
        "some other text",
        b"\nDear reader,\nthis is no mesh.\n",
        ": holds no triangles (lines: 3, vertices: 0, faces: 0); \
         lines that are no OBJ statements: 2, the first of them line 2",
    ),
    (
        "vertex with two numbers",
        b"v 0 0 0\nv 1 2\n",
        ":2: a vertex needs 3 coordinates; this one has 2",
    ),
    (
        "vertex without numbers",
        b"v\n",
        ":1: a vertex needs 3 coordinates; this one has 0",
    ),
    (
        "cut off between numbers",
        b"v 0 0 0\nv 1 0 0\nv 0 1 ",
        ":3: a vertex needs 3 coordinates; this one has 2",
    ),
    (
        "cut off in an exponent",
        b"v 0 0 1.5e",
        ":1: '1.5e' is not a number",
    ),
    (
        "cut off after a sign",
        b"v 0 0 0\nv 1 0 -",
        ":2: '-' is not a number",
    ),
    (
        "cut off in a face",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2",
        ":4: a face needs 3 corners; this one has 2",
    ),
    (
        "cut off after a keyword",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf",
        ":4: a face needs 3 corners; this one has 0",
    ),
    (
        "letters for a number",
        b"v 0 zero 0\n",
        ":1: 'zero' is not a number",
    ),
    (
        "hexadecimal number",
        b"v 0x1p3 0 0\n",
        ":1: '0x1p3' is not a number",
    ),
    ("decimal comma", b"v 1,5 0 0\n", ":1: '1,5' is not a number"),
    (
        "nan as some C libraries print it",
        b"v 0 -nan(ind) 0\n",
        ":1: '-nan(ind)' is not a number",
    ),
    (
        "number that is not UTF-8",
        b"v 0 1\xFF 0\n",
        r":1: '1\xff' is not a number",
    ),
    (
        "lost line end between vertices",
        b"v 0 0 0 v 1 0 0\n",
        ":1: 'v' is not a number",
    ),
    (
        "partly coloured vertex with junk",
        b"v 0 0 0 0.5 red\n",
        ":1: 'red' is not a number",
    ),
    (
        "index zero",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
        ":4: corner '0' has index 0; the first vertex is 1, the latest is -1",
    ),
    (
        "index of no vertex",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/2 4/3\n",
        ":4: corner '4/3' refers to none of the 3 vertices above it",
    ),
    (
        "negative index of no vertex",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n",
        ":4: corner '-4' refers to none of the 3 vertices above it",
    ),
    (
        "index that wraps in 32 bits",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 4294967297 2 3\n",
        ":4: corner '4294967297' refers to none of the 3 vertices above it",
    ),
    (
        "index that wraps in tobj",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 6148914691236517206 2 3\n",
        ":4: corner '6148914691236517206' refers to none of the 3 vertices above it",
    ),
    (
        "index beyond 64 bits",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999999\n",
        ":4: corner '99999999999999999999999' refers to none of the 3 vertices above it",
    ),
    (
        "negative index beyond 64 bits",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -99999999999999999999999\n",
        ":4: corner '-99999999999999999999999' refers to none of the 3 vertices above it",
    ),
    (
        "faces before vertices",
        b"f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n",
        ":1: corner '1' refers to none of the 0 vertices above it",
    ),
    (
        "fraction for an index",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2.5 3\n",
        ":4: '2.5' is not a corner of a face (an index, or v/vt/vn)",
    ),
    (
        "corner without a position",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 /2 3\n",
        ":4: '/2' is not a corner of a face (an index, or v/vt/vn)",
    ),
    (
        "corner of four indices",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1/1 2 3\n",
        ":4: '1/1/1/1' is not a corner of a face (an index, or v/vt/vn)",
    ),
    (
        "letters in an unused index",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/x 2 3\n",
        ":4: '1/x' is not a corner of a face (an index, or v/vt/vn)",
    ),
    (
        "error in a continued statement",
        b"v 0 0 0\nv 1 0 \\\n\\\n one\nv 0 1 0\n",
        ":2: 'one' is not a number",
    ),
    (
        "error after CR line ends",
        b"v 0 0 0\rv 1 0 0\r\rv 0 1\r",
        ":4: a vertex needs 3 coordinates; this one has 2",
    ),
    (
        "UTF-16 with a mark",
        b"\xFF\xFEv\x00 \x000\x00 \x000\x00",
        ":1: starts with the UTF-16 mark FF FE; save it as UTF-8 or plain ASCII",
    ),
    (
        "big-endian UTF-16 with a mark",
        b"\xFE\xFF\x00v\x00 \x000",
        ":1: starts with the UTF-16 mark FE FF; save it as UTF-8 or plain ASCII",
    ),
    (
        "UTF-16 without a mark",
        b"v\x00 \x001\x00",
        ":1: zero byte in column 2: this is binary data or UTF-16 text, not an OBJ file",
    ),
    (
        "zero byte far down",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng a\0b\n",
        ":5: zero byte in column 4: this is binary data or UTF-16 text, not an OBJ file",
    ),
];

#[test]
fn refused_files_say_what_is_wrong_and_where() {
    let mut failures = Vec::new();
    for (name, bytes, expected) in REFUSED {
        let expected = format!("scene.obj{expected}");
        match read_bytes(bytes) {
            Ok(_) => failures.push(format!("{name}: was accepted")),
            Err(error) if error.to_string() == expected => {}
            Err(error) => failures.push(format!("{name}: '{error}' instead of '{expected}'")),
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn random_bytes_are_refused_in_their_first_lines() {
    for seed in 0..100 {
        let mut bytes = vec![0; 100_000];
        Pcg64Mcg::seed_from_u64(seed).fill_bytes(&mut bytes);
        match read_bytes(&bytes) {
            Err(ObjError::Binary { line, .. }) => assert!(line < 100, "seed {seed}: line {line}"),
            Err(ObjError::Utf16 { .. } | ObjError::Statement { .. }) => {}
            other => panic!("seed {seed}: {other:?}"),
        }
    }
}

#[test]
fn a_line_without_end_is_refused_at_the_limit() {
    let endless = BufReader::new(io::repeat(b'1'));
    let error = read(endless, Path::new("scene.obj"), &ObjLimits::default()).unwrap_err();
    let ObjError::LineTooLong {
        line: 1,
        found,
        limit: 1_048_576,
        ..
    } = error
    else {
        panic!("{error}");
    };
    assert!(found < 1_100_000, "{found} bytes were read");
}

#[test]
fn a_statement_continued_without_end_is_refused_at_the_limit() {
    let line = b"f 1 2 3 \\\n".repeat(200_000);
    let error = read_bytes(&line).unwrap_err();
    assert!(
        matches!(
            error,
            ObjError::LineTooLong {
                limit: 1_048_576,
                ..
            }
        ),
        "{error}"
    );
}

#[test]
fn a_file_without_end_is_refused_at_the_limit() {
    let endless = BufReader::new(io::repeat(b'\n'));
    let limits = ObjLimits {
        bytes: 100_000,
        ..Default::default()
    };
    let error = read(endless, Path::new("scene.obj"), &limits).unwrap_err();
    assert!(
        matches!(error, ObjError::FileTooLarge { limit: 100_000, .. }),
        "{error}"
    );
}

#[test]
fn limits_on_counts_are_inclusive() {
    let square = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let exact = ObjLimits {
        bytes: square.len() as u64,
        line_bytes: 9,
        vertices: 4,
        triangles: 2,
        polygon_corners: 4,
    };
    let read = |limits| read(&square[..], Path::new("scene.obj"), &limits);
    assert_eq!(read(exact).unwrap().mesh.triangles.len(), 2);

    let problem = |limits| match read(limits).unwrap_err() {
        ObjError::Statement { line, problem, .. } => (line, problem),
        error => panic!("{error}"),
    };
    assert_eq!(
        problem(ObjLimits {
            vertices: 3,
            ..exact
        }),
        (4, StatementError::TooManyVertices { limit: 3 })
    );
    assert_eq!(
        problem(ObjLimits {
            triangles: 1,
            ..exact
        }),
        (5, StatementError::TooManyTriangles { limit: 1 })
    );
    assert_eq!(
        problem(ObjLimits {
            polygon_corners: 3,
            ..exact
        }),
        (5, StatementError::TooManyCorners { found: 4, limit: 3 })
    );
    let error = read(ObjLimits {
        line_bytes: 8,
        ..exact
    })
    .unwrap_err();
    assert!(
        matches!(error, ObjError::LineTooLong { line: 5, .. }),
        "{error}"
    );
    let error = read(ObjLimits { bytes: 41, ..exact }).unwrap_err();
    assert!(matches!(error, ObjError::FileTooLarge { .. }), "{error}");
}

#[test]
fn a_reader_that_fails_is_reported() {
    struct Broken;
    impl Read for Broken {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::Error::other("the disk is gone"))
        }
    }
    let half = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".chain(Broken);
    let limits = ObjLimits::default();
    let error = read(BufReader::new(half), Path::new("scene.obj"), &limits).unwrap_err();
    assert_eq!(
        error.to_string(),
        "scene.obj: cannot be read: the disk is gone"
    );
}
