//! A request to stop, such as ctrl-C on the command line, and how far the runs of the process have come.
//!
//! Both are the whole process's. Every run of a program looks at the request before each step ([`crate::Runner`]) and
//! ends with [`ncc_ir::diag::Fault::Interrupted`], which names the block that was next. Not here: who asks, what
//! becomes of the output, and who is shown the steps (the command line).

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

static PASSED: AtomicU64 = AtomicU64::new(0);

/// Steps between two of a run that are counted; a power of 2.
const EVERY: u64 = 1 << 16;

/// Asks every run of the process to stop.
pub fn ask() {
    ASKED.store(true, Ordering::Relaxed);
}

/// Whether runs have been asked to stop.
#[inline]
pub fn is_asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// The same, of a run that has made so many steps.
#[inline]
pub(crate) fn is_asked_at(steps: u64) -> bool {
    if steps.is_multiple_of(EVERY) {
        PASSED.fetch_add(EVERY, Ordering::Relaxed);
    }
    is_asked()
}

/// Up to how many steps none is counted, of a run that has made so many.
#[inline]
pub(crate) fn uncounted(steps: u64) -> u64 {
    (steps / EVERY + 1) * EVERY - 1
}

/// A run has made the steps after one number up to another at once.
pub(crate) fn has_made(before: u64, steps: u64) {
    PASSED.fetch_add((steps / EVERY - before / EVERY) * EVERY, Ordering::Relaxed);
}

/// Steps that all runs of the process together have made, rounded down.
pub fn passed() -> u64 {
    PASSED.load(Ordering::Relaxed)
}
