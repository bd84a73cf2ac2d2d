//! Wavefront OBJ files: what users have, as they have it.
//!
//! The file streams through a filter into [`tobj`]:
//!
//! ```text
//! bytes -> lines -> statements -> filter -> tobj -> assemble -> Mesh
//!                                    '-> survey: faults, counts, line numbers
//! ```
//!
//! tobj on its own panics on some files, reads others wrongly and refuses much
//! that is in use. It sees nothing here but vertices of three numbers and
//! faces of checked indices, and never a material. What the filter leaves out
//! is counted and reported with line numbers, unless it only names, groups,
//! shades or textures.
//!
//! How the format is read where its readers differ:
//! - an index refers to a vertex *above* its face; else the file is refused;
//! - triangles are numbered in file order, a polygon's next to each other:
//!   the fan of the first corner if it is convex, an ear clipping if not;
//! - degenerate triangles are kept, and so are coordinates that are not
//!   finite: [`FaultReport::non_finite_vertices`] tells the caller;
//! - vertices keep the order of the file, without those that no face uses;
//! - `#` starts a comment anywhere, and a comment cannot be continued.

mod assemble;
mod error;
mod faults;
mod filter;
mod limits;
mod lines;
mod statement;
mod survey;
mod triangulate;

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

pub use error::{ObjError, StatementError};
pub use faults::{Fault, FaultKind, FaultReport};
pub use limits::ObjLimits;

use crate::scene::Mesh;
use filter::Filter;

/// Bytes that are read, and after which progress is reported, at a time.
const CHUNK_BYTES: usize = 1 << 18;

/// A mesh and what was odd about its file.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadedObj {
    /// The triangles; at least one, all indices in range, coordinates as they
    /// stand in the file.
    pub mesh: Mesh,
    /// What was left out or looks wrong. Displays as readable lines.
    pub faults: FaultReport,
}

/// Loads a file.
///
/// # Errors
/// If it cannot be read, exceeds a limit, has a malformed vertex or face, or
/// holds no triangle at all.
pub fn load(path: &Path, limits: &ObjLimits) -> Result<LoadedObj, ObjError> {
    load_with(path, limits, &mut |_, _| {})
}

/// Loads a file and reports progress: bytes read so far, and bytes in the
/// file (0 if it is a pipe, whose length is unknown).
///
/// # Errors
/// As [`load`].
pub fn load_with(
    path: &Path,
    limits: &ObjLimits,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<LoadedObj, ObjError> {
    let file = || path.into();
    let unreadable = |error| ObjError::Unreadable {
        file: file(),
        error,
    };
    let metadata = path.metadata().map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(ObjError::Directory { file: file() });
    }
    let (found, limit) = (metadata.len(), limits.bytes);
    if found > limit {
        return Err(ObjError::FileTooLarge {
            file: file(),
            found,
            limit,
        });
    }
    let reader = Observed {
        inner: File::open(path).map_err(unreadable)?,
        bytes: 0,
        observe: |bytes| progress(bytes, found),
    };
    read(BufReader::with_capacity(CHUNK_BYTES, reader), path, limits)
}

/// Reads a file that is already open or in memory; `name` stands for it in
/// messages.
///
/// # Errors
/// As [`load`].
pub fn read(source: impl BufRead, name: &Path, limits: &ObjLimits) -> Result<LoadedObj, ObjError> {
    let mut filter = Filter::new(source, name, limits);
    let options = tobj::LoadOptions {
        single_index: true,
        ..Default::default()
    };
    let no_materials = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
    let outcome = tobj::load_obj_buf(&mut filter, &options, no_materials);
    let survey = filter.finish()?;
    if survey.triangles == 0 {
        let unknown = survey.faults.of(FaultKind::UnknownStatement);
        return Err(ObjError::NoTriangles {
            file: name.into(),
            lines: survey.lines,
            vertices: survey.vertices(),
            unknown: unknown.map_or(0, |fault| fault.count),
            first_unknown: unknown.and_then(|fault| fault.first_lines.first().copied()),
        });
    }
    let refused = |reason: String| ObjError::Parser {
        file: name.into(),
        reason,
    };
    let (models, _) = outcome.map_err(|error| refused(error.to_string()))?;
    let [model] = models.as_slice() else {
        return Err(refused(format!("{} models instead of one", models.len())));
    };
    let (mesh, faults) =
        assemble::assemble(&model.mesh, survey).map_err(|reason| refused(reason.to_owned()))?;
    Ok(LoadedObj { mesh, faults })
}

/// A reader that tells how far it is.
struct Observed<R, F> {
    inner: R,
    bytes: u64,
    observe: F,
}

impl<R: Read, F: FnMut(u64)> Read for Observed<R, F> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.inner.read(buffer)?;
        self.bytes += length as u64;
        (self.observe)(self.bytes);
        Ok(length)
    }
}
