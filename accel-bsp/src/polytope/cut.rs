//! Cutting a polytope in two: shared crossings, the linked cap, the checks.

use accel_core::glam::DVec3;

use super::Polytope;

/// Why a polytope was not cut: rounding left a part that is not closed, or the
/// plane does not pass through the inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CutError {
    /// One side holds no volume.
    Misses,
    /// The edges on the plane are not one closed loop.
    OpenCap,
    /// V - E + F is not 2.
    Euler,
}

/// A cut under way: corners of the polytope and the crossings found so far.
pub(super) struct Cut<'a> {
    polytope: &'a Polytope,
    distances: &'a [f64],
    corners: Vec<DVec3>,
    /// An edge, smaller corner first, and the corner where it crosses.
    crossings: Vec<([u32; 2], u32)>,
}

impl<'a> Cut<'a> {
    /// Corners of `polytope` lie at these signed distances.
    pub(super) fn new(polytope: &'a Polytope, distances: &'a [f64]) -> Self {
        Self {
            polytope,
            distances,
            corners: polytope.corners.clone(),
            crossings: Vec::new(),
        }
    }

    /// The part where the signed distance has this sign.
    pub(super) fn side(&mut self, sign: f64) -> Result<Polytope, CutError> {
        let mut loops = Vec::with_capacity(self.polytope.faces.len() + 1);
        let mut cap_edges = Vec::new();
        for face in &self.polytope.faces {
            let kept = self.clip(&face.corners, sign);
            if kept.iter().all(|&index| self.is_on(index)) {
                continue;
            }
            for (position, &from) in kept.iter().enumerate() {
                let to = kept[(position + 1) % kept.len()];
                if self.is_on(from) && self.is_on(to) {
                    cap_edges.push([to, from]);
                }
            }
            loops.push((kept, face.made_by));
        }
        loops.push((link(&cap_edges)?, Some(self.polytope.cuts)));
        let part = self.renumbered(loops);
        part.check_euler()?;
        Ok(part)
    }

    fn is_on(&self, index: u32) -> bool {
        self.distances.get(index as usize).is_none_or(|&s| s == 0.0)
    }

    fn clip(&mut self, face: &[u32], sign: f64) -> Vec<u32> {
        let mut kept = Vec::with_capacity(face.len() + 1);
        for (position, &from) in face.iter().enumerate() {
            let to = face[(position + 1) % face.len()];
            let (s_from, s_to) = (self.distances[from as usize], self.distances[to as usize]);
            if s_from * sign >= 0.0 {
                kept.push(from);
            }
            if s_from * s_to < 0.0 {
                kept.push(self.shared_crossing(from, to));
            }
        }
        kept
    }

    fn shared_crossing(&mut self, from: u32, to: u32) -> u32 {
        let edge = [from.min(to), from.max(to)];
        if let Some((_, corner)) = self.crossings.iter().find(|(known, _)| *known == edge) {
            return *corner;
        }
        let s = |index: u32| self.distances[index as usize];
        let point = self.polytope.crossing(from, to, s(from), s(to));
        let corner = self.corners.len() as u32;
        self.corners.push(point);
        self.crossings.push((edge, corner));
        corner
    }

    /// The polytope of these faces, without corners that none of them uses.
    fn renumbered(&self, mut loops: Vec<(Vec<u32>, Option<u32>)>) -> Polytope {
        let mut numbers = vec![u32::MAX; self.corners.len()];
        let mut corners = Vec::new();
        for index in loops.iter_mut().flat_map(|(corners, _)| corners) {
            let number = &mut numbers[*index as usize];
            if *number == u32::MAX {
                *number = corners.len() as u32;
                corners.push(self.corners[*index as usize]);
            }
            *index = *number;
        }
        Polytope::new(corners, loops, self.polytope.cuts + 1)
    }
}

impl Polytope {
    fn check_euler(&self) -> Result<(), CutError> {
        let ends: usize = self.faces.iter().map(|face| face.corners.len()).sum();
        let is_simple = self.faces.iter().all(|face| face.corners.len() >= 3);
        let closes =
            self.corners.len() + self.faces.len() == ends / 2 + 2 && ends.is_multiple_of(2);
        if is_simple && closes && self.corners.len() >= 4 {
            Ok(())
        } else {
            Err(CutError::Euler)
        }
    }
}

/// Links edges to the one loop that they form.
fn link(edges: &[[u32; 2]]) -> Result<Vec<u32>, CutError> {
    let &[start, mut end] = edges.first().ok_or(CutError::OpenCap)?;
    let mut linked = vec![start];
    while end != start {
        if linked.len() > edges.len() {
            return Err(CutError::OpenCap);
        }
        linked.push(end);
        let mut followers = edges.iter().filter(|edge| edge[0] == end);
        match (followers.next(), followers.next()) {
            (Some(edge), None) => end = edge[1],
            _ => return Err(CutError::OpenCap),
        }
    }
    if linked.len() == edges.len() && linked.len() >= 3 {
        Ok(linked)
    } else {
        Err(CutError::OpenCap)
    }
}
