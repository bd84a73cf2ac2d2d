//! The stream that tobj reads: the file reduced to `v` with three numbers and
//! `f` with plain positive indices, each of them checked.

use std::io::{self, BufRead, Read, Write};
use std::path::Path;

use super::error::{ObjError, StatementError};
use super::limits::ObjLimits;
use super::lines::{LogicalLine, LogicalLines};
use super::statement::{VertexStatement, corner_vertex, fault_of_omission, words};
use super::survey::Survey;

/// Bytes of output that are prepared before the reader gets them.
const OUTPUT_BYTES: usize = 1 << 16;

/// Reads an OBJ file and is read by tobj. The first error of the file ends the
/// stream; [`Filter::finish`] returns it.
pub(super) struct Filter<'a, R> {
    file: &'a Path,
    lines: LogicalLines<'a, R>,
    sieve: Sieve<'a>,
    consumed: usize,
    error: Option<ObjError>,
}

impl<'a, R: BufRead> Filter<'a, R> {
    pub fn new(source: R, file: &'a Path, limits: &'a ObjLimits) -> Self {
        Self {
            file,
            lines: LogicalLines::new(source, file, limits),
            sieve: Sieve {
                limits,
                survey: Survey::default(),
                corners: Vec::new(),
                output: Vec::new(),
            },
            consumed: 0,
            error: None,
        }
    }

    /// The findings, or the error that ended the stream.
    pub fn finish(self) -> Result<Survey, ObjError> {
        match self.error {
            Some(error) => Err(error),
            None => Ok(self.sieve.survey),
        }
    }

    /// Replaces the output, which has been read, by that of the next lines.
    fn refill(&mut self) -> Result<(), ObjError> {
        self.consumed = 0;
        self.sieve.output.clear();
        while self.sieve.output.len() < OUTPUT_BYTES {
            let Some(line) = self.lines.next_line(&mut self.sieve.survey.faults)? else {
                break;
            };
            self.sieve
                .pass(&line)
                .map_err(|problem| ObjError::Statement {
                    file: self.file.into(),
                    line: line.number,
                    problem,
                })?;
        }
        self.sieve.survey.lines = self.lines.lines_read();
        Ok(())
    }
}

impl<R: BufRead> BufRead for Filter<'_, R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.consumed == self.sieve.output.len() && self.error.is_none() {
            self.error = self.refill().err();
        }
        if self.error.is_some() {
            return Err(io::Error::other("the OBJ file has an error"));
        }
        Ok(&self.sieve.output[self.consumed..])
    }

    fn consume(&mut self, length: usize) {
        self.consumed += length;
    }
}

impl<R: BufRead> Read for Filter<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.fill_buf()?.read(buffer)?;
        self.consume(length);
        Ok(length)
    }
}

/// Checks one statement after the other and writes those that pass.
struct Sieve<'a> {
    limits: &'a ObjLimits,
    survey: Survey,
    corners: Vec<u32>,
    output: Vec<u8>,
}

impl Sieve<'_> {
    fn pass(&mut self, line: &LogicalLine<'_>) -> Result<(), StatementError> {
        let mut words = words(line.text);
        match words.next() {
            None => Ok(()),
            Some(b"v") => self.pass_vertex(words, line.number),
            // `fo` is how the format's first version wrote faces.
            Some(b"f" | b"fo") => self.pass_face(words, line.number),
            Some(keyword) => {
                if let Some(kind) = fault_of_omission(keyword) {
                    self.survey.faults.add(kind, line.number);
                }
                Ok(())
            }
        }
    }

    fn pass_vertex<'w>(
        &mut self,
        words: impl Iterator<Item = &'w [u8]>,
        line: u64,
    ) -> Result<(), StatementError> {
        let vertex = VertexStatement::parse(words)?;
        self.survey.add_vertex(&vertex, line, self.limits)?;
        self.output.push(b'v');
        for coordinate in vertex.coordinates {
            self.output.push(b' ');
            self.output.extend_from_slice(coordinate.as_bytes());
        }
        self.output.push(b'\n');
        Ok(())
    }

    fn pass_face<'w>(
        &mut self,
        words: impl Iterator<Item = &'w [u8]>,
        line: u64,
    ) -> Result<(), StatementError> {
        let vertices = self.survey.vertices();
        self.corners.clear();
        for word in words {
            self.corners.push(corner_vertex(word, vertices)?);
        }
        self.survey.add_face(&self.corners, line, self.limits)?;
        self.output.push(b'f');
        for &corner in &self.corners {
            write!(self.output, " {}", u64::from(corner) + 1).expect("a Vec takes every write");
        }
        self.output.push(b'\n');
        Ok(())
    }
}
