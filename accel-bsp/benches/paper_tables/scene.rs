//! Scenes, and the memory that builds take.

use accel_bsp::Triangle;
use accel_core::testing::{families, mesh_file};

use crate::Failure;

/// The triangles of an OBJ file, polygons fanned, or of a family of test scenes.
pub(crate) fn load(name: &str) -> Result<Vec<Triangle>, Failure> {
    if let Some(family) = families::find(name) {
        return Ok(family.scene(0, family.full_size));
    }
    mesh_file::load(name)
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
