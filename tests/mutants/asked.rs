//! Which mutants are asked for, and the work side by side.
//!
//! `NCC_ALL_MUTANTS=1` is every mutant instead of a seeded sample; `NCC_MUTANTS_OF=fanuc/dome,bolt` is the programs
//! whose folder and file say any of these, `NCC_MUTANTS_TO=grbl,canon` the targets.

use std::sync::atomic::{AtomicUsize, Ordering};

use ncc_tests::corpus::Program;

/// Whether every mutant is asked for.
pub(crate) fn all() -> bool {
    std::env::var_os("NCC_ALL_MUTANTS").is_some_and(|v| v == "1")
}

/// Which programs are asked for; the empty text is all of them.
pub(crate) fn of() -> String {
    std::env::var("NCC_MUTANTS_OF").unwrap_or_default()
}

/// Whether a program is asked for.
pub(crate) fn asked(program: &Program) -> bool {
    of().split(',').any(|name| format!("{}/{}", program.dialect, program.file).contains(name))
}

/// Whether a target is asked for.
pub(crate) fn asked_to(target: &str) -> bool {
    let all = std::env::var("NCC_MUTANTS_TO").unwrap_or_default();
    all.is_empty() || all.split(',').any(|name| name == target)
}

/// Does each piece of work once, on as many threads as the machine runs at a time.
pub(crate) fn side_by_side<W: Sync>(work: &[W], each: impl Fn(&W) + Sync) {
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(work) = work.get(next.fetch_add(1, Ordering::Relaxed)) {
                    each(work);
                }
            });
        }
    });
}
