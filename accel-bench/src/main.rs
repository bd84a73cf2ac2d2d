//! The `accel-bench` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    accel_bench::cli::run()
}
