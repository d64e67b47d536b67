//! A request to stop, such as ctrl-C on the command line.
//!
//! It holds for the whole process. Every run of a program looks at it before each step ([`crate::Runner`]) and
//! ends with [`ncc_ir::diag::Fault::Interrupted`], which names the block that was next. Not here: who asks, and what
//! becomes of the output (the command line).

use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// Asks every run of the process to stop.
pub fn ask() {
    ASKED.store(true, Ordering::Relaxed);
}

/// Whether runs have been asked to stop.
#[inline]
pub fn is_asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}
