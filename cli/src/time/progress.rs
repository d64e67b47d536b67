//! How far a long program has come, on a terminal.

use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use ncc_driver::render::terminal::one_line;
use ncc_driver::time::drive::Watch;
use ncc_driver::time::duration::hms;

/// Before so long nothing is shown: most programs are done by then.
const PATIENCE: Duration = Duration::from_millis(400);

/// How often the line is renewed at most, times a second.
const RATE: u8 = 10;

/// So many functions of a program kept whole are passed between two looks at the watch.
const EVERY: u32 = 4096;

/// A bar on stderr, or nothing where nobody would see it.
pub(crate) struct Progress {
    bar: Option<ProgressBar>,
    begun: Instant,
    passed: u32,
}

impl Progress {
    /// Of a file of so many bytes.
    pub(crate) fn new(name: &str, bytes: u64, wanted: bool) -> Progress {
        let bar = wanted.then(|| {
            let target = ProgressDrawTarget::stderr_with_hz(RATE);
            let style = ProgressStyle::with_template("{prefix} {bar:24} {percent:>3} %  {msg}");
            let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
            ProgressBar::with_draw_target(Some(bytes), target).with_style(style).with_prefix(one_line(name))
        });
        // Nobody looks: nothing is counted either.
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
