//! The first byte picks the source dialect, the second the target, the rest is the program. A
//! panic is a crash, and so is a verification that fails: then two parts of the compiler disagree.
#![no_main]

use libfuzzer_sys::fuzz_target;
use ncc_dialects::{Settings, builtins};
use ncc_driver::job::{Failure, Job};

fuzz_target!(|data: &[u8]| {
    let [from, to, text @ ..] = data else { return };
    let dialects: Vec<_> = builtins().collect();
    let pick = |byte: u8| Settings::new(dialects[usize::from(byte) % dialects.len()]);
    let job = Job::new(pick(*from), pick(*to), "fuzz");
    let outcome = ncc_driver::translate::translate(&job, &mut std::io::Cursor::new(text)).expect("reading from memory");
    assert_ne!(
        outcome.release,
        Err(Failure::VerificationFailed),
        "{} to {}: {:?}",
        job.from.dialect.id,
        job.to.dialect.id,
        outcome.diagnostics.last()
    );
});
