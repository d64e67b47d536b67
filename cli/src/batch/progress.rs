//! How many programs of a batch are done, on a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// How often the line is renewed at most, times a second.
const RATE: u8 = 10;

/// A bar on stderr, or nothing where nobody would see it.
pub(super) struct Progress {
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Of so many programs.
    pub(super) fn new(programs: usize, wanted: bool) -> Progress {
        let bar = wanted.then(|| {
            let target = ProgressDrawTarget::stderr_with_hz(RATE);
            let style = ProgressStyle::with_template("{bar:24} {pos} of {len} programs");
            let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
            ProgressBar::with_draw_target(Some(programs as u64), target).with_style(style)
        });
        Progress { bar: bar.filter(|bar| !bar.is_hidden()) }
    }

    /// One more is done.
    pub(super) fn ended(&self) {
        if let Some(bar) = &self.bar {
            bar.inc(1);
        }
    }

    /// Takes the bar away while something else is written.
    pub(super) fn aside(&self, write: impl FnOnce()) {
        match &self.bar {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
