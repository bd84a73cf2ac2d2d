//! Reading meshes, as simply as the examples need.

use accel_dualsplit::Triangle;
use accel_dualsplit::glam::Vec3;

/// The triangles of an OBJ file; polygons are fanned.
pub fn triangles_of(text: &str) -> Result<Vec<Triangle>, Box<dyn std::error::Error>> {
    let mut vertices: Vec<Vec3> = Vec::new();
    let mut triangles = Vec::new();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let coordinates: Vec<f32> = words.map(str::parse).collect::<Result<_, _>>()?;
                vertices.push(Vec3::from_slice(&coordinates));
            }
            Some("f") => {
                let corners: Vec<Vec3> = words
                    .map(|word| {
                        let index: isize = word.split('/').next().unwrap_or_default().parse()?;
                        let index = if index < 0 {
                            vertices.len() as isize + index
                        } else {
                            index - 1
                        };
                        let vertex = vertices.get(index as usize).copied();
                        vertex.ok_or_else(|| format!("no vertex {word}").into())
                    })
                    .collect::<Result<_, Box<dyn std::error::Error>>>()?;
                for pair in corners[1..].windows(2) {
                    triangles.push(Triangle::new(corners[0], pair[0], pair[1]));
                }
            }
            _ => {}
        }
    }
    Ok(triangles)
}
