//! A line on the terminal while a program with loops and calls is executed: how many blocks, and where it ends.
//!
//! ```text
//! part.nc ⠹ 12,400,000 blocks executed; a run gives up after 50,000,000; Ctrl-C stops it
//! ```
//!
//! It goes before anything else is printed. Not here: the bar of `ncc time`, which knows how far the text has been read,
//! and that of several programs.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use ncc_driver::render::terminal::one_line;
use ncc_exec::{MOST_STEPS, halt};

/// Before so long nothing is shown: most programs are done by then.
const PATIENCE: Duration = Duration::from_millis(1500);

/// How often the line is renewed.
const TICK: Duration = Duration::from_millis(200);

/// A line on stderr as long as this lives, or nothing where nobody would see it.
pub(crate) struct Running {
    shown: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Running {
    /// Of a program with this name.
    pub(crate) fn shown(name: &str, wanted: bool) -> Running {
        let bar = wanted.then(|| {
            let style = ProgressStyle::with_template("{prefix} {spinner} {msg}");
            let style = style.unwrap_or_else(|_| ProgressStyle::default_spinner());
            ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr())
                .with_style(style)
                .with_prefix(one_line(name))
        });
        let shown = bar.filter(|bar| !bar.is_hidden()).map(|bar| {
            let (over, asked) = channel();
            let before = halt::passed();
            let show = move || {
                let mut wait = PATIENCE;
                while asked.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                    wait = TICK;
                    let passed = halt::passed() - before;
                    if passed > 0 {
                        bar.set_message(words(passed));
                        bar.tick();
                    }
                }
                bar.finish_and_clear();
            };
            (over, std::thread::spawn(show))
        });
        Running { shown }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if let Some((over, thread)) = self.shown.take() {
            drop(over);
            let _ = thread.join();
        }
    }
}

/// How far it has come.
fn words(passed: u64) -> String {
    let [passed, most] = [passed, MOST_STEPS].map(grouped);
    format!("{passed} blocks executed; a run gives up after {most}; Ctrl-C stops it")
}

/// A number with a comma before each three digits.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_says_how_far_and_how_long() {
        let line = words(1_245_184);
        assert_eq!(line, "1,245,184 blocks executed; a run gives up after 50,000,000; Ctrl-C stops it");
        assert_eq!([0, 12, 999, 1000].map(grouped), ["0", "12", "999", "1,000"]);
    }
}
