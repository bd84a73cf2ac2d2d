//! Indexed meshes.

use glam::Vec3;

use super::Triangle;

/// Why an indexed mesh has no triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// An index points past the last position.
    #[error(
        "triangle {triangle} has vertex index {index}, but the mesh has {positions} positions \
         (the largest index is one less)"
    )]
    IndexOutOfRange {
        /// Position of the triangle in the list of indices.
        triangle: usize,
        /// The offending index.
        index: u32,
        /// How many positions there are.
        positions: usize,
    },
}

/// The triangles of an indexed mesh, in the order of `indices`: the id of a hit
/// is the position of its triangle there.
///
/// ```
/// # fn main() -> Result<(), accel_core::primitive::MeshError> {
/// let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let square = accel_core::primitive::triangles_of_mesh(&positions, &[[0, 1, 2], [0, 2, 3]])?;
/// assert_eq!(square.len(), 2);
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// [`MeshError::IndexOutOfRange`] names the first triangle with an index past
/// the last position.
pub fn triangles_of_mesh<V>(
    positions: &[V],
    indices: &[[u32; 3]],
) -> Result<Vec<Triangle>, MeshError>
where
    V: Copy + Into<Vec3>,
{
    let corner = |triangle: usize, index: u32| {
        let position = positions.get(index as usize).copied().map(Into::into);
        position.ok_or(MeshError::IndexOutOfRange {
            triangle,
            index,
            positions: positions.len(),
        })
    };
    indices
        .iter()
        .enumerate()
        .map(|(triangle, &[a, b, c])| {
            Ok(Triangle {
                a: corner(triangle, a)?,
                b: corner(triangle, b)?,
                c: corner(triangle, c)?,
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_index_out_of_range_names_triangle_index_and_limit() {
        let error = triangles_of_mesh(&[Vec3::ZERO; 3], &[[0, 1, 2], [0, 3, 1]]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "triangle 1 has vertex index 3, but the mesh has 3 positions (the largest index is one less)"
        );
    }
}
