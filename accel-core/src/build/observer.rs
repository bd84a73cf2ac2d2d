//! Watching a build, and stopping it.

/// Watches a build from any thread. The unit type `()` watches nothing.
pub trait BuildObserver: Sync {
    /// `done` of `total` references have reached their leaves. Called now and
    /// then, from several threads, in no particular order.
    fn progress(&self, done: usize, total: usize) {
        let _ = (done, total);
    }

    /// Asked now and then; true makes the build end soon with
    /// [`BuildError::Cancelled`](crate::BuildError::Cancelled).
    fn is_cancelled(&self) -> bool {
        false
    }
}

impl BuildObserver for () {}
