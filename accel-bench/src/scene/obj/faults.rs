//! What was odd about a file that loaded all the same.

use std::fmt;

/// Lines kept per kind of fault; the rest are only counted.
const FIRST_LINES: usize = 5;

/// A way in which a file is odd without being refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// A coordinate is nan or infinite, or too large for 32 bits. The vertex
    /// loads as it stands; whether its triangles are wanted is the caller's
    /// decision.
    NonFiniteVertex,
    /// Numbers after the third coordinate (a weight or a colour), left out.
    ExtraVertexValues,
    /// A vertex that no face uses, left out.
    UnusedVertex,
    /// A face that names the same vertex twice in a row. It is kept, and
    /// yields triangles without area.
    RepeatedCorner,
    /// A polygon that has no area, has a vertex that is not finite, or was
    /// found to cross itself (not every crossing is noticed): no split is
    /// right, and what is left of it when that shows is cut as a fan.
    UnsplittablePolygon,
    /// A point or polyline (`p`, `l`), left out.
    PointOrLine,
    /// A statement of a free-form curve or surface, left out.
    FreeForm,
    /// A reference to another file or command (`call`, `csh`), not followed.
    ExternalCall,
    /// A line that starts with no keyword of the format, left out.
    UnknownStatement,
    /// A `\` that continues the last line of the file.
    DanglingContinuation,
}

impl FaultKind {
    const fn description(self) -> &'static str {
        match self {
            Self::NonFiniteVertex => "vertices with a coordinate that is not finite",
            Self::ExtraVertexValues => "vertices with a weight or colour (left out)",
            Self::UnusedVertex => "vertices that no face uses (left out)",
            Self::RepeatedCorner => "faces that repeat a corner (kept)",
            Self::UnsplittablePolygon => {
                "polygons that cross themselves, have no area or are not finite (cut as fans)"
            }
            Self::PointOrLine => "points and polylines (left out)",
            Self::FreeForm => "statements of free-form curves and surfaces (left out)",
            Self::ExternalCall => "calls of other files or commands (not followed)",
            Self::UnknownStatement => "lines that are no OBJ statements (left out)",
            Self::DanglingContinuation => "continuations of the last line (nothing follows)",
        }
    }
}

/// How often a fault occurred, and where first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What is odd.
    pub kind: FaultKind,
    /// How many vertices, faces or lines are.
    pub count: u64,
    /// The line numbers of the first few, from 1.
    pub first_lines: Vec<u64>,
}

impl fmt::Display for Fault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {}", self.kind.description(), self.count)?;
        for (nth, line) in self.first_lines.iter().enumerate() {
            let separator = if nth == 0 { " (line " } else { ", " };
            write!(formatter, "{separator}{line}")?;
        }
        let more = self.count > self.first_lines.len() as u64;
        formatter.write_str(if more { ", ...)" } else { ")" })?;
        Ok(())
    }
}

/// Everything odd about one file, one entry per kind in order of appearance.
/// Displays as one line per entry, and as nothing if the file is flawless.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FaultReport {
    faults: Vec<Fault>,
}

impl FaultReport {
    /// The faults, one per kind.
    pub fn iter(&self) -> impl Iterator<Item = &Fault> {
        self.faults.iter()
    }

    /// Whether the file has no fault at all.
    pub fn is_empty(&self) -> bool {
        self.faults.is_empty()
    }

    /// The fault of this kind, if it occurred.
    pub fn of(&self, kind: FaultKind) -> Option<&Fault> {
        self.faults.iter().find(|fault| fault.kind == kind)
    }

    /// How often this kind occurred.
    pub fn count(&self, kind: FaultKind) -> u64 {
        self.of(kind).map_or(0, |fault| fault.count)
    }

    /// The vertices with a coordinate that is nan or infinite, if there are
    /// any. It includes vertices that no face uses and that the mesh therefore
    /// does not hold.
    pub fn non_finite_vertices(&self) -> Option<&Fault> {
        self.of(FaultKind::NonFiniteVertex)
    }

    pub(super) fn add(&mut self, kind: FaultKind, line: u64) {
        let nth = self.faults.iter().position(|fault| fault.kind == kind);
        let nth = nth.unwrap_or_else(|| {
            let (count, first_lines) = (0, Vec::new());
            self.faults.push(Fault {
                kind,
                count,
                first_lines,
            });
            self.faults.len() - 1
        });
        let fault = &mut self.faults[nth];
        fault.count += 1;
        if fault.first_lines.len() < FIRST_LINES {
            fault.first_lines.push(line);
        }
    }
}

impl fmt::Display for FaultReport {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (nth, fault) in self.faults.iter().enumerate() {
            let separator = if nth == 0 { "" } else { "\n" };
            write!(formatter, "{separator}{fault}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_counts_all_lines_and_names_the_first() {
        let mut report = FaultReport::default();
        assert_eq!(report.to_string(), "");
        for line in 10..17 {
            report.add(FaultKind::PointOrLine, line);
        }
        report.add(FaultKind::FreeForm, 3);
        assert_eq!(
            report.to_string(),
            "points and polylines (left out): 7 (line 10, 11, 12, 13, 14, ...)\n\
             statements of free-form curves and surfaces (left out): 1 (line 3)"
        );
    }
}
