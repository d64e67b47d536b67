//! Progress bar of `ncc time` for a long program, on a terminal. It shows the share of the file and the machine time.
//!
//! Not here: the estimate, which calls the bar ([`Watch`]).

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use ncc_driver::render::terminal::one_line;
use ncc_driver::time::drive::Watch;
use ncc_driver::time::duration::hms;

/// Delay before the bar appears. Most programs end earlier.
const PATIENCE: Duration = Duration::from_millis(400);

/// Highest number of updates per second.
const RATE: u8 = 10;

/// Number of calls of [`Watch::now`] between two updates of the bar.
const EVERY: u32 = 4096;

/// A bar on stderr; no bar if stderr is not a terminal.
pub(crate) struct Progress {
    bar: Option<ProgressBar>,
    begun: Instant,
    passed: u32,
}

impl Progress {
    /// Makes the bar of file `name` with a length of `bytes`; no bar unless `wanted`.
    pub(crate) fn new(name: &str, bytes: u64, wanted: bool) -> Progress {
        let bar = wanted.then(|| {
            let target = ProgressDrawTarget::stderr_with_hz(RATE);
            let style = ProgressStyle::with_template("{prefix} {bar:24} {percent:>3} %  {msg}");
            let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
            ProgressBar::with_draw_target(Some(bytes), target).with_style(style).with_prefix(one_line(name))
        });
        // A hidden bar would only cost time.
        let bar = bar.filter(|bar| !bar.is_hidden());
        Progress { bar, begun: Instant::now(), passed: 0 }
    }
}

impl Watch for Progress {
    fn at(&mut self, bytes: u64, now: f64) {
        if let Some(bar) = &self.bar
            && self.begun.elapsed() > PATIENCE
        {
            bar.set_message(hms(now));
            bar.set_position(bytes);
        }
    }

    fn now(&mut self, now: f64) {
        self.passed += 1;
        if self.passed == EVERY {
            self.passed = 0;
            if let Some(bar) = &self.bar {
                self.at(bar.length().unwrap_or(0), now);
            }
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
