//! From a stream of bytes to statements: line ends, comments, continuations
//! and the limits on their size.

use std::io::{self, BufRead};
use std::path::Path;

use super::error::ObjError;
use super::faults::{FaultKind, FaultReport};
use super::limits::ObjLimits;

/// One statement: a line without its end, byte order mark and comment, joined
/// with the lines that continue it.
pub(super) struct LogicalLine<'a> {
    /// The line it starts on, from 1.
    pub number: u64,
    /// Its bytes, in any encoding that contains ASCII.
    pub text: &'a [u8],
}

/// Splits a stream into statements. Lines end with LF, CR LF or CR alone.
pub(super) struct LogicalLines<'a, R> {
    source: R,
    file: &'a Path,
    limits: &'a ObjLimits,
    text: Vec<u8>,
    bytes_read: u64,
    lines_read: u64,
    /// The last line ended with CR: an LF that follows belongs to it.
    ended_with_cr: bool,
}

impl<'a, R: BufRead> LogicalLines<'a, R> {
    pub fn new(source: R, file: &'a Path, limits: &'a ObjLimits) -> Self {
        Self {
            source,
            file,
            limits,
            text: Vec::new(),
            bytes_read: 0,
            lines_read: 0,
            ended_with_cr: false,
        }
    }

    /// Lines read so far, as an editor counts them.
    pub fn lines_read(&self) -> u64 {
        self.lines_read
    }

    /// The next statement, which may be blank; `None` after the last.
    pub fn next_line(
        &mut self,
        faults: &mut FaultReport,
    ) -> Result<Option<LogicalLine<'_>>, ObjError> {
        self.text.clear();
        if !self.append_line()? {
            return Ok(None);
        }
        let number = self.lines_read;
        while self.drop_continuation_mark() {
            if !self.append_line()? {
                faults.add(FaultKind::DanglingContinuation, number);
                break;
            }
        }
        let text = self.text.as_slice();
        Ok(Some(LogicalLine { number, text }))
    }

    /// Appends a line without its comment. False at the end of the file.
    fn append_line(&mut self) -> Result<bool, ObjError> {
        let start = self.text.len();
        if !self.append_raw_line()? {
            return Ok(false);
        }
        if self.lines_read == 1 {
            self.drop_byte_order_mark()?;
        }
        let line = &self.text[start..];
        if let Some(zero) = line.iter().position(|&byte| byte == 0) {
            return Err(ObjError::Binary {
                file: self.file.into(),
                line: self.lines_read,
                column: zero + 1,
            });
        }
        if let Some(comment) = line.iter().position(|&byte| byte == b'#') {
            self.text.truncate(start + comment);
        }
        Ok(true)
    }

    /// Appends the bytes up to the next line end, which is consumed.
    fn append_raw_line(&mut self) -> Result<bool, ObjError> {
        let mut begun = false;
        loop {
            let chunk = match self.source.fill_buf() {
                Ok(chunk) => chunk,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => {
                    let file = self.file.into();
                    return Err(ObjError::Unreadable { file, error });
                }
            };
            if chunk.is_empty() {
                return Ok(begun);
            }
            if std::mem::take(&mut self.ended_with_cr) && chunk[0] == b'\n' {
                self.consume(1)?;
                continue;
            }
            if !begun {
                begun = true;
                self.lines_read += 1;
            }
            let end = chunk.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
            let length = end.unwrap_or(chunk.len());
            if self.text.len() + length > self.limits.line_bytes {
                return Err(ObjError::LineTooLong {
                    file: self.file.into(),
                    line: self.lines_read,
                    found: self.text.len() + length,
                    limit: self.limits.line_bytes,
                });
            }
            self.text.extend_from_slice(&chunk[..length]);
            self.ended_with_cr = end.is_some_and(|end| chunk[end] == b'\r');
            self.consume(length + usize::from(end.is_some()))?;
            if end.is_some() {
                return Ok(true);
            }
        }
    }

    fn consume(&mut self, length: usize) -> Result<(), ObjError> {
        self.source.consume(length);
        self.bytes_read += length as u64;
        if self.bytes_read > self.limits.bytes {
            return Err(ObjError::FileTooLarge {
                file: self.file.into(),
                found: self.bytes_read,
                limit: self.limits.bytes,
            });
        }
        Ok(())
    }

    fn drop_byte_order_mark(&mut self) -> Result<(), ObjError> {
        let mark = match self.text.as_slice() {
            [0xEF, 0xBB, 0xBF, ..] => {
                self.text.drain(..3);
                return Ok(());
            }
            [0xFF, 0xFE, ..] => "FF FE",
            [0xFE, 0xFF, ..] => "FE FF",
            _ => return Ok(()),
        };
        let file = self.file.into();
        Err(ObjError::Utf16 { file, mark })
    }

    /// Cuts off a `\` at the end, blanks after it included, and says whether
    /// there was one. A comment's `\` is gone by then: it continues nothing,
    /// or a path in a comment would swallow the next vertex.
    fn drop_continuation_mark(&mut self) -> bool {
        let trimmed = self.text.trim_ascii_end();
        let Some(kept) = trimmed.strip_suffix(b"\\") else {
            return false;
        };
        let kept = kept.len();
        self.text.truncate(kept);
        self.text.push(b' ');
        true
    }
}
