//! Meshes from files, for tests and examples that want real ones. Reads what
//! well-formed OBJ files hold; the bench has the loader for all others.

use std::error::Error;
use std::path::{Path, PathBuf};

use glam::Vec3;

use crate::Triangle;

/// The file of this name in the folder that the environment variable
/// `ACCEL_SCENES` names; `None` if the variable is not set.
pub fn in_scenes_folder(name: &str) -> Option<PathBuf> {
    Some(Path::new(&std::env::var_os("ACCEL_SCENES")?).join(name))
}

/// The triangles of an OBJ file; polygons are fanned.
///
/// # Errors
/// If the file cannot be read, or a line of vertices or faces not be understood.
pub fn load(path: impl AsRef<Path>) -> Result<Vec<Triangle>, Box<dyn Error>> {
    triangles_of(&std::fs::read_to_string(path)?)
}

fn triangles_of(text: &str) -> Result<Vec<Triangle>, Box<dyn Error>> {
    let mut vertices: Vec<Vec3> = Vec::new();
    let mut triangles = Vec::new();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let coordinates: Vec<f32> = words.map(str::parse).collect::<Result<_, _>>()?;
                let [x, y, z, ..] = coordinates[..] else {
                    return Err(format!("a vertex has three coordinates: {line}").into());
                };
                vertices.push(Vec3::new(x, y, z));
            }
            Some("f") => {
                let corners: Vec<Vec3> = words
                    .map(|word| corner(word, &vertices))
                    .collect::<Result<_, _>>()?;
                let fan = corners.windows(2).skip(1);
                triangles.extend(fan.map(|pair| Triangle::new(corners[0], pair[0], pair[1])));
            }
            _ => {}
        }
    }
    Ok(triangles)
}

/// The vertex that a word of a face names: from the first on, or from the last
/// one read back.
fn corner(word: &str, vertices: &[Vec3]) -> Result<Vec3, Box<dyn Error>> {
    let index: isize = word.split('/').next().unwrap_or_default().parse()?;
    let position = if index < 0 {
        vertices.len().checked_add_signed(index)
    } else {
        usize::try_from(index)
            .ok()
            .and_then(|index| index.checked_sub(1))
    };
    let vertex = position.and_then(|position| vertices.get(position));
    vertex
        .copied()
        .ok_or_else(|| format!("there is no vertex {word}").into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_are_fanned_and_count_from_either_end() {
        let square = "v 0 0 0\nv 1 0 0 1\nv 1 1 0\nv 0 1 0\n";
        let triangles = triangles_of(&format!("{square}f 1/9/9 2 3 -1\n")).unwrap();
        assert_eq!(triangles.len(), 2);
        assert_eq!(triangles[1].c, Vec3::Y);
        for face in ["f 1 2 5", "f 0 1 2", "f -5 1 2", "f a b c", "v 1 2"] {
            assert!(
                triangles_of(&format!("{square}{face}\n")).is_err(),
                "{face}"
            );
        }
    }
}
