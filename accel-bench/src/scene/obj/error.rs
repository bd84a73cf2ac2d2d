//! Why a file is refused.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

/// Why an OBJ file was refused. The message names the file and, where there is
/// one, the line (from 1; of a continued statement, its first line).
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ObjError {
    /// The file could not be opened or read.
    #[error("{}: cannot be read: {error}", file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// What the operating system said.
        error: io::Error,
    },
    /// The path leads to a directory.
    #[error("{}: is a directory, not an OBJ file", file.display())]
    Directory {
        /// The directory.
        file: PathBuf,
    },
    /// The file is longer than [`ObjLimits::bytes`](super::ObjLimits::bytes).
    #[error("{}: holds {found} bytes or more; the limit is {limit}", file.display())]
    FileTooLarge {
        /// The file.
        file: PathBuf,
        /// Bytes the file has, or bytes read when the limit was passed.
        found: u64,
        /// Bytes allowed.
        limit: u64,
    },
    /// A line is longer than [`ObjLimits::line_bytes`](super::ObjLimits::line_bytes).
    #[error(
        "{}:{line}: the line holds {found} bytes or more; the limit is {limit}",
        file.display()
    )]
    LineTooLong {
        /// The file.
        file: PathBuf,
        /// The line.
        line: u64,
        /// Bytes read when the limit was passed.
        found: usize,
        /// Bytes allowed.
        limit: usize,
    },
    /// The file starts with the byte order mark of UTF-16 or UTF-32.
    #[error(
        "{}:1: starts with the UTF-16 mark {mark}; save it as UTF-8 or plain ASCII",
        file.display()
    )]
    Utf16 {
        /// The file.
        file: PathBuf,
        /// Its first two bytes, in hexadecimal.
        mark: &'static str,
    },
    /// A zero byte: the file is binary, or UTF-16 without a mark.
    #[error(
        "{}:{line}: zero byte in column {column}: this is binary data or UTF-16 text, not an OBJ file",
        file.display()
    )]
    Binary {
        /// The file.
        file: PathBuf,
        /// The line.
        line: u64,
        /// Position of the byte in its line, from 1.
        column: usize,
    },
    /// A vertex or face that cannot be understood.
    #[error("{}:{line}: {problem}", file.display())]
    Statement {
        /// The file.
        file: PathBuf,
        /// The line on which the statement starts.
        line: u64,
        /// What is wrong with it.
        problem: StatementError,
    },
    /// The whole file was read and holds no face.
    #[error(
        "{}: holds no triangles (lines: {lines}, vertices: {vertices}, faces: 0){}",
        file.display(),
        unknown_hint(*unknown, *first_unknown)
    )]
    NoTriangles {
        /// The file.
        file: PathBuf,
        /// Lines in it.
        lines: u64,
        /// Vertices in it.
        vertices: u32,
        /// Lines that start with no keyword of the format.
        unknown: u64,
        /// The first of these.
        first_unknown: Option<u64>,
    },
    /// The parser refused what the filter let through, or disagreed with it.
    #[error("{}: the parser failed: {reason}", file.display())]
    Parser {
        /// The file.
        file: PathBuf,
        /// What it said.
        reason: String,
    },
}

/// What is wrong with a vertex or a face.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum StatementError {
    /// A value of a vertex is no decimal number.
    #[error("'{value}' is not a number")]
    MalformedNumber {
        /// The value as written, shortened.
        value: String,
    },
    /// A vertex with fewer than three coordinates.
    #[error("a vertex needs 3 coordinates; this one has {found}")]
    TooFewCoordinates {
        /// Coordinates on the line.
        found: usize,
    },
    /// More vertices than [`ObjLimits::vertices`](super::ObjLimits::vertices).
    #[error("more than {limit} vertices, which is the limit")]
    TooManyVertices {
        /// Vertices allowed.
        limit: u32,
    },
    /// A corner that is not of the form `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    #[error("'{value}' is not a corner of a face (an index, or v/vt/vn)")]
    MalformedCorner {
        /// The corner as written, shortened.
        value: String,
    },
    /// The index 0: the first vertex has index 1.
    #[error("corner '{value}' has index 0; the first vertex is 1, the latest is -1")]
    ZeroIndex {
        /// The corner as written, shortened.
        value: String,
    },
    /// An index that no vertex above the face has.
    #[error("corner '{value}' refers to none of the {vertices} vertices above it")]
    IndexOutOfRange {
        /// The corner as written, shortened.
        value: String,
        /// Vertices that precede the face.
        vertices: u32,
    },
    /// A face with fewer than three corners.
    #[error("a face needs 3 corners; this one has {found}")]
    TooFewCorners {
        /// Corners on the line.
        found: usize,
    },
    /// A polygon with more corners than
    /// [`ObjLimits::polygon_corners`](super::ObjLimits::polygon_corners).
    #[error("the face has {found} corners; the limit is {limit}")]
    TooManyCorners {
        /// Corners on the line.
        found: usize,
        /// Corners allowed.
        limit: u32,
    },
    /// More triangles than [`ObjLimits::triangles`](super::ObjLimits::triangles).
    #[error("more than {limit} triangles, which is the limit")]
    TooManyTriangles {
        /// Triangles allowed.
        limit: u32,
    },
}

fn unknown_hint(unknown: u64, first: Option<u64>) -> String {
    first.map_or_else(String::new, |line| {
        format!("; lines that are no OBJ statements: {unknown}, the first of them line {line}")
    })
}
