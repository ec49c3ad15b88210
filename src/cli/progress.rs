//! A progress bar on standard error, only when that is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::ops::ControlFlow;
use std::time::Duration;

/// A bar that follows a sweep's callback.
pub struct Bar(ProgressBar);

impl Bar {
    /// A bar with a name; invisible unless standard error is a terminal.
    pub fn new(name: &str) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template("{msg} {wide_bar} {percent}% {eta}")
            .expect("the template is well-formed");
        bar.set_style(style);
        bar.set_message(name.to_owned());
        Self(bar)
    }

    /// The callback of a sweep.
    pub fn advance(&self, done: usize, all: usize) -> ControlFlow<()> {
        self.0.set_length(all as u64);
        self.0.set_position(done as u64);
        ControlFlow::Continue(())
    }

    /// What is being done; the clock of the bar runs meanwhile, however long it takes.
    pub fn doing(&self, what: String) {
        self.0.enable_steady_tick(Duration::from_millis(200));
        self.0.set_message(what);
    }

    /// Whether nobody sees it.
    pub fn is_hidden(&self) -> bool {
        self.0.is_hidden()
    }

    /// The callback of a march: the time simulated.
    pub fn march(&self, time: f64, end: f64) -> ControlFlow<()> {
        let percent = (100.0 * time / end) as u64;
        if percent != self.0.position() {
            self.0.set_length(100);
            self.0.set_position(percent);
        }
        ControlFlow::Continue(())
    }

    /// Removes the bar.
    pub fn finish(&self) {
        self.0.finish_and_clear();
    }
}
