//! The comparison of acceleration structures, as a library behind the
//! `accel-bench` command.

pub mod report;
pub mod scene;
