//! What a figure depends on besides the code: machine, features, commit.

use std::path::Path;
use std::process::Command;

use crate::report::model::Environment;

/// The environment of this run.
pub fn describe(threads: usize, seed: u64) -> Environment {
    Environment {
        cpu: cpu_name(),
        features: cpu_features(),
        threads,
        commit: commit(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        seed,
        command: std::env::args().collect::<Vec<_>>().join(" "),
        os: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
    }
}

/// The processor's name, as the system tells it.
fn cpu_name() -> Option<String> {
    let info = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = info.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// The vector instruction sets found at run time.
fn cpu_features() -> Vec<String> {
    let mut features = Vec::new();
    #[cfg(target_arch = "x86_64")]
    {
        let found = [
            ("sse4.2", is_x86_feature_detected!("sse4.2")),
            ("avx", is_x86_feature_detected!("avx")),
            ("avx2", is_x86_feature_detected!("avx2")),
            ("fma", is_x86_feature_detected!("fma")),
            ("avx512f", is_x86_feature_detected!("avx512f")),
        ];
        features.extend(
            found
                .iter()
                .filter(|(_, has)| *has)
                .map(|(name, _)| (*name).to_owned()),
        );
    }
    features
}

/// The commit of the working copy that the program was built from, with a mark
/// if it was changed since; unknown outside of one.
fn commit() -> Option<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    if !folder.is_dir() {
        return None;
    }
    let git = |arguments: &[&str]| {
        let output = Command::new("git")
            .arg("-C")
            .arg(folder)
            .args(arguments)
            .output()
            .ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    let commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    let is_changed = !git(&["status", "--porcelain"])?.is_empty();
    Some(if is_changed {
        format!("{commit} (changed since)")
    } else {
        commit
    })
}
