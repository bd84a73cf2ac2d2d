//! What becomes of malformed and odd OBJ files: each is refused with a message
//! that names file and line, or loads as its author meant it.

mod accepted;
mod files;
mod polygons;
mod refused;
mod robustness;

use std::path::Path;

use accel_bench::scene::obj::{LoadedObj, ObjError, ObjLimits, read};

/// Reads bytes as the file `scene.obj`.
fn read_bytes(bytes: &[u8]) -> Result<LoadedObj, ObjError> {
    read(bytes, Path::new("scene.obj"), &ObjLimits::default())
}

/// Reads bytes that must load.
fn accept(bytes: &[u8]) -> LoadedObj {
    read_bytes(bytes).unwrap_or_else(|error| panic!("refused: {error}"))
}
