//! Writing OBJ files.

use std::io::{self, Write};

use super::Mesh;

/// Writes `mesh` as OBJ: a `v` line per position, an `f` line per triangle. Finite
/// numbers are written with the fewest digits that read back to the same bits; a
/// loader refuses those that are not finite. Many small writes: `out` should be
/// buffered.
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
