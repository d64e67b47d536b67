//! The first byte picks the source dialect, the second the target, the rest is the program. A
//! panic is a crash, and so is a verification that fails: then two parts of the compiler disagree.
#![no_main]

use libfuzzer_sys::fuzz_target;
use ncc::job::{Failure, Job};
use ncc_dialects::{Settings, builtins};

fuzz_target!(|data: &[u8]| {
    let [from, to, text @ ..] = data else { return };
    let dialects: Vec<_> = builtins().collect();
    let pick = |byte: u8| Settings::new(dialects[usize::from(byte) % dialects.len()]);
    let job = Job {
        from: pick(*from),
        to: pick(*to),
        machines: ncc::machines::pair::Machines::default(),
        layout: ncc_backends::Layout::default(),
        passes: Vec::new(),
        fold: None,
        verify: true,
        head: true,
        start: [None; 6],
        program_number: None,
        source_name: "fuzz".to_owned(),
        allow: Vec::new(),
        deny: Vec::new(),
    };
    let outcome = ncc::translate::translate(&job, &mut &text[..]).expect("reading from memory");
    assert_ne!(
        outcome.release,
        Err(Failure::VerificationFailed),
        "{} to {}: {:?}",
        job.from.dialect.id,
        job.to.dialect.id,
        outcome.diagnostics.last()
    );
});
