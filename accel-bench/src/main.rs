//! The `accel-bench` command.

fn main() {}
