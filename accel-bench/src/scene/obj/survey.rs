//! What is learnt about a file while it streams past.

use super::error::StatementError;
use super::faults::{FaultKind, FaultReport};
use super::limits::ObjLimits;
use super::statement::VertexStatement;

/// Counts, faults and the little that is needed afterwards to put tobj's
/// vertices back into the order of the file and to name lines.
#[derive(Default)]
pub(super) struct Survey {
    pub faults: FaultReport,
    /// Lines in the file.
    pub lines: u64,
    /// Per vertex of the file, whether a face uses it.
    pub used: Vec<bool>,
    /// The used vertices, from 0, in the order in which faces first use them:
    /// tobj numbers its vertices so.
    pub first_uses: Vec<u32>,
    /// The lines of the faces with more than three corners.
    pub polygon_lines: Vec<u64>,
    /// Triangles that the faces will give.
    pub triangles: u32,
    /// Stretches of vertices on consecutive lines: first vertex and its line.
    vertex_runs: Vec<(u32, u64)>,
}

impl Survey {
    /// Vertices so far. The limit keeps them within 32 bits.
    pub fn vertices(&self) -> u32 {
        self.used.len() as u32
    }

    /// Takes note of a vertex.
    pub fn add_vertex(
        &mut self,
        vertex: &VertexStatement<'_>,
        line: u64,
        limits: &ObjLimits,
    ) -> Result<(), StatementError> {
        let index = self.vertices();
        if index >= limits.vertices {
            let limit = limits.vertices;
            return Err(StatementError::TooManyVertices { limit });
        }
        if !vertex.finite {
            self.faults.add(FaultKind::NonFiniteVertex, line);
        }
        if vertex.extra_values {
            self.faults.add(FaultKind::ExtraVertexValues, line);
        }
        let continues_run = self
            .vertex_runs
            .last()
            .is_some_and(|&(first, start)| start + u64::from(index - first) == line);
        if !continues_run {
            self.vertex_runs.push((index, line));
        }
        self.used.push(false);
        Ok(())
    }

    /// Takes note of a face whose corners are vertices of the file, from 0.
    pub fn add_face(
        &mut self,
        corners: &[u32],
        line: u64,
        limits: &ObjLimits,
    ) -> Result<(), StatementError> {
        let found = corners.len();
        if found < 3 {
            return Err(StatementError::TooFewCorners { found });
        }
        if found > limits.polygon_corners as usize {
            let limit = limits.polygon_corners;
            return Err(StatementError::TooManyCorners { found, limit });
        }
        let triangles = u64::from(self.triangles) + (found as u64 - 2);
        if triangles > u64::from(limits.triangles) {
            let limit = limits.triangles;
            return Err(StatementError::TooManyTriangles { limit });
        }
        self.triangles = triangles as u32;
        if found > 3 {
            self.polygon_lines.push(line);
        }
        let mut previous = corners[found - 1];
        let mut repeats = false;
        for &corner in corners {
            repeats |= corner == previous;
            previous = corner;
            if !std::mem::replace(&mut self.used[corner as usize], true) {
                self.first_uses.push(corner);
            }
        }
        if repeats {
            self.faults.add(FaultKind::RepeatedCorner, line);
        }
        Ok(())
    }

    /// Reports the vertices that no face uses. To be called at the end.
    pub fn report_unused_vertices(&mut self) {
        for vertex in (0..self.vertices()).filter(|&vertex| !self.used[vertex as usize]) {
            let after = self
                .vertex_runs
                .partition_point(|&(first, _)| first <= vertex);
            let (first, start) = self.vertex_runs[after - 1];
            let line = start + u64::from(vertex - first);
            self.faults.add(FaultKind::UnusedVertex, line);
        }
    }
}
