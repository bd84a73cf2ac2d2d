//! Scenes, and the memory that builds take.

use accel_bsp::Triangle;
use accel_bsp::glam::Vec3;
use accel_core::testing::families;

use crate::Failure;

/// The triangles of an OBJ file, polygons fanned, or of a family of test scenes.
pub(crate) fn load(name: &str) -> Result<Vec<Triangle>, Failure> {
    if let Some(family) = families::find(name) {
        return Ok(family.scene(0, family.full_size));
    }
    let mut positions: Vec<Vec3> = Vec::new();
    let mut triangles = Vec::new();
    for line in std::fs::read_to_string(name)?.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let numbers: Result<Vec<f32>, _> = words.take(3).map(str::parse).collect();
                let [x, y, z] = numbers?[..] else {
                    return Err(format!("a vertex without three numbers: {line}").into());
                };
                positions.push(Vec3::new(x, y, z));
            }
            Some("f") => {
                let corner = |word: &str| corner(word, &positions);
                let corners = words.map(corner).collect::<Result<Vec<_>, _>>()?;
                let fan = corners.windows(2).skip(1);
                triangles.extend(fan.map(|pair| Triangle::new(corners[0], pair[0], pair[1])));
            }
            _ => {}
        }
    }
    Ok(triangles)
}

/// The position that a word of a face names: from 1, or backwards from -1.
fn corner(word: &str, positions: &[Vec3]) -> Result<Vec3, Failure> {
    let number: i64 = word.split('/').next().unwrap_or_default().parse()?;
    let index = if number < 0 {
        positions.len() as i64 + number
    } else {
        number - 1
    };
    let position = usize::try_from(index)
        .ok()
        .and_then(|index| positions.get(index));
    Ok(*position.ok_or_else(|| format!("no vertex {word}"))?)
}

/// Makes [`peak_memory`] start anew, where the system (Linux) can.
pub(crate) fn reset_peak_memory() {
    // Without it the figure is the process's peak so far: too large, not wrong.
    std::fs::write("/proc/self/clear_refs", "5").ok();
}

/// The most bytes resident since the last reset, where the system (Linux) tells.
pub(crate) fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kilobytes)
}
