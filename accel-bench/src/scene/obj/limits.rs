//! How much of a file is read before it is refused.

/// Upper bounds on what one OBJ file may hold. Each is inclusive, and each is
/// checked before memory for what would exceed it is allocated.
///
/// Loading takes about 120 bytes per triangle and 90 per vertex at its peak,
/// so that a program with little memory lowers `triangles` and `vertices`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ObjLimits {
    /// Bytes in the file.
    pub bytes: u64,
    /// Bytes in one line, its continuations and comment included.
    pub line_bytes: usize,
    /// `v` lines, whether a face uses them or not.
    pub vertices: u32,
    /// Triangles, after polygons are split.
    pub triangles: u32,
    /// Corners of one polygon. Splitting a concave polygon takes time
    /// proportional to the square of its corners: less than a
    /// second for 16,384.
    pub polygon_corners: u32,
}

impl Default for ObjLimits {
    /// 16 GiB, 1 MiB lines, 2^31 - 1 vertices and triangles, 16,384 corners.
    fn default() -> Self {
        Self {
            bytes: 16 << 30,
            line_bytes: 1 << 20,
            vertices: i32::MAX as u32,
            triangles: i32::MAX as u32,
            polygon_corners: 1 << 14,
        }
    }
}
