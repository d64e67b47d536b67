//! The first byte picks the dialect, the second how blocks are numbered, the rest is the program. What is
//! laid out says the same, and laid out once more it stays as it is.
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use ncc::fmt::of_text;
use ncc::registry::DialectRegistry;
use ncc_backends::{Layout, Numbering};
use ncc_dialects::{Family, Settings, builtins};
use ncc_driver::problem::Exit;

static KNOWN: LazyLock<Known> = LazyLock::new(DialectRegistry::built_in);

fuzz_target!(|data: &[u8]| {
    let [from, numbers, text @ ..] = data else { return };
    let dialects: Vec<_> = builtins().collect();
    let dialect = dialects[usize::from(*from) % dialects.len()];
    let numbering = match (dialect.family, numbers % 3) {
        (Family::Canon | Family::Ir, _) | (_, 0) => Numbering::Keep,
        (_, 1) => Numbering::Off,
        (_, _) => Numbering::Every { first: 10, step: 10 },
    };
    let crlf = numbers & 0x80 != 0;
    let laid_out = |text: &[u8]| {
        let layout = Layout { numbering: numbering.clone(), crlf };
        of_text(Settings::new(dialect), layout, text, &KNOWN)
    };
    match laid_out(text) {
        Ok(once) => {
            let twice = laid_out(&once).unwrap_or_else(|problem| panic!("once more: {}", problem.message));
            assert_eq!(String::from_utf8_lossy(&twice), String::from_utf8_lossy(&once));
        }
        Err(problem) => assert_eq!(problem.exit, Exit::Refused, "{}", problem.message),
    }
});
