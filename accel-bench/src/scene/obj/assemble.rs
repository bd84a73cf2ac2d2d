//! From what tobj returns to a mesh in the order of the file.

use glam::Vec3;

use super::faults::{FaultKind, FaultReport};
use super::survey::Survey;
use super::triangulate::Triangulator;
use crate::scene::Mesh;

/// Puts the vertices back into the order of the file, without those that no
/// face uses, and splits the faces in their order. Fails if tobj's model is
/// not the one that the filter passed on.
pub(super) fn assemble(
    model: &tobj::Mesh,
    mut survey: Survey,
) -> Result<(Mesh, FaultReport), &'static str> {
    let (points, []) = model.positions.as_chunks::<3>() else {
        return Err("coordinates are missing");
    };
    if points.len() != survey.first_uses.len() {
        return Err("vertices are missing");
    }
    let order = final_order(&survey);
    let mut positions = vec![Vec3::ZERO; points.len()];
    for (&point, &index) in points.iter().zip(&order) {
        positions[index as usize] = Vec3::from_array(point);
    }
    let mut indices = Vec::with_capacity(model.indices.len());
    for &index in &model.indices {
        indices.push(*order.get(index as usize).ok_or("an index has no vertex")?);
    }
    let mesh = Mesh {
        triangles: split_faces(&indices, &model.face_arities, &positions, &mut survey)?,
        positions,
    };
    survey.report_unused_vertices();
    Ok((mesh, survey.faults))
}

/// Per vertex of tobj, its index in the mesh.
fn final_order(survey: &Survey) -> Vec<u32> {
    let mut next = 0;
    let used_before: Vec<u32> = survey
        .used
        .iter()
        .map(|&used| {
            let index = next;
            next += u32::from(used);
            index
        })
        .collect();
    let first_uses = survey.first_uses.iter();
    first_uses
        .map(|&vertex| used_before[vertex as usize])
        .collect()
}

/// `arities` has the number of corners per face; it is empty if all are
/// triangles.
fn split_faces(
    indices: &[u32],
    arities: &[u32],
    positions: &[Vec3],
    survey: &mut Survey,
) -> Result<Vec<[u32; 3]>, &'static str> {
    if arities.is_empty() {
        let (triangles, []) = indices.as_chunks::<3>() else {
            return Err("a face is cut short");
        };
        return Ok(triangles.to_vec());
    }
    let mut triangles = Vec::with_capacity(survey.triangles as usize);
    let mut triangulator = Triangulator::default();
    let mut polygon_lines = survey.polygon_lines.iter();
    let mut rest = indices;
    for &arity in arities {
        let corners;
        (corners, rest) = rest
            .split_at_checked(arity as usize)
            .ok_or("a face is cut short")?;
        let proper = triangulator.split(corners, positions, &mut triangles);
        if arity > 3 {
            let line = *polygon_lines.next().ok_or("a face is not from the file")?;
            if !proper {
                survey.faults.add(FaultKind::UnsplittablePolygon, line);
            }
        }
    }
    Ok(triangles)
}
