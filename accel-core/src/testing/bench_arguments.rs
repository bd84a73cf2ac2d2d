//! What a benchmark without a harness is asked to do.

/// The arguments that stand behind `--` where Cargo runs a benchmark: without the
/// program's name, and without the option that Cargo adds.
pub fn bench_arguments() -> impl Iterator<Item = String> {
    std::env::args()
        .skip(1)
        .filter(|argument| argument != "--bench")
}
