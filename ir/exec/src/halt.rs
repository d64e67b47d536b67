//! A request to stop, such as ctrl-C on the command line, and how far the runs of the process have come.
//!
//! Both are the whole process's. Every run of a program looks at the request before each step ([`crate::Runner`]) and
//! ends with [`ncc_ir::diag::Fault::Interrupted`], which names the block that was next. A server has several pieces of work
//! at once: each is done [`under`] a halt of its own, which runs look at every 65,536 steps. Not here: who asks, what
//! becomes of the output, and who is shown the steps (the command line).

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

static PASSED: AtomicU64 = AtomicU64::new(0);

/// Steps between two of a run that are counted; a power of 2.
const EVERY: u64 = 1 << 16;

/// Asks every run of the process to stop.
pub fn ask() {
    ASKED.store(true, Ordering::Relaxed);
}

/// A request to stop that concerns one piece of work.
#[derive(Clone, Debug, Default)]
pub struct Halt(Arc<AtomicBool>);

thread_local! {
    /// The halt of the work that this thread does.
    static OWN: RefCell<Option<Halt>> = const { RefCell::new(None) };
}

impl Halt {
    /// Asks the work to stop.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the work has been asked to stop.
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Does work on this thread that a halt stops. Threads that the work starts take the halt over ([`own`]).
pub fn under<T>(halt: Option<Halt>, work: impl FnOnce() -> T) -> T {
    /// Puts back what was there before, after a panic too.
    struct Before(Option<Halt>);
    impl Drop for Before {
        fn drop(&mut self) {
            OWN.set(self.0.take());
        }
    }
    let _before = Before(OWN.replace(halt));
    work()
}

/// The halt of the work that this thread does.
pub fn own() -> Option<Halt> {
    OWN.with_borrow(Clone::clone)
}

/// Whether runs have been asked to stop.
pub fn is_asked() -> bool {
    is_asked_of_all() || OWN.with_borrow(|own| own.as_ref().is_some_and(Halt::is_asked))
}

/// The same, of all runs of the process.
#[inline]
pub(crate) fn is_asked_of_all() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// The same, of a run that has made so many steps.
#[inline]
pub(crate) fn is_asked_at(steps: u64) -> bool {
    if steps.is_multiple_of(EVERY) {
        PASSED.fetch_add(EVERY, Ordering::Relaxed);
        return is_asked();
    }
    is_asked_of_all()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_halt_is_of_its_own_work() {
        let (one, other) = (Halt::default(), Halt::default());
        one.ask();
        assert!(under(Some(one.clone()), is_asked));
        assert!(!under(Some(other), is_asked) && !is_asked());
        let inside = under(Some(one), || {
            std::thread::scope(|scope| {
                let halt = own();
                scope.spawn(|| under(halt, is_asked)).join()
            })
        });
        assert!(inside.is_ok_and(|asked| asked) && own().is_none());
    }
}
