//! Progress bars, where somebody watches.

use std::io::IsTerminal;
use std::time::Duration;

use accel_core::BuildObserver;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::cli::interrupt;

/// A bar for `steps` steps of `what`, on standard error; hidden when that is not
/// a terminal. It appears only once something takes a second.
pub fn bar(what: &str, steps: u64) -> ProgressBar {
    let target = if std::io::stderr().is_terminal() {
        ProgressDrawTarget::stderr_with_hz(5)
    } else {
        ProgressDrawTarget::hidden()
    };
    let style = ProgressStyle::with_template("{msg:<44!} {bar:30} {percent:>3} % {eta:>4}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = ProgressBar::with_draw_target(Some(steps), target).with_style(style);
    bar.set_message(what.to_owned());
    bar.enable_steady_tick(Duration::from_secs(1));
    bar
}

/// Shows the progress of a build, and cancels it after Ctrl-C.
pub struct BuildProgress {
    bar: ProgressBar,
}

impl BuildProgress {
    /// For the build of `structure`.
    pub fn new(structure: &str) -> Self {
        Self {
            bar: bar(&format!("building {structure}"), 1),
        }
    }
}

impl BuildObserver for BuildProgress {
    fn progress(&self, done: usize, total: usize) {
        self.bar.set_length(total as u64);
        self.bar.set_position(done as u64);
    }

    fn is_cancelled(&self) -> bool {
        interrupt::is_requested()
    }
}

impl Drop for BuildProgress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
