//! Writing OBJ files.

use std::io::{self, Write};

use super::Mesh;

/// Writes `mesh` as OBJ. Numbers are written so that reading them gives the same
/// bits.
///
/// # Errors
/// What `out` answers.
pub fn write_obj(mesh: &Mesh, out: &mut impl Write) -> io::Result<()> {
    for position in &mesh.positions {
        writeln!(out, "v {} {} {}", position.x, position.y, position.z)?;
    }
    for triangle in &mesh.triangles {
        // OBJ counts from 1.
        let [a, b, c] = triangle.map(|index| u64::from(index) + 1);
        writeln!(out, "f {a} {b} {c}")?;
    }
    Ok(())
}
