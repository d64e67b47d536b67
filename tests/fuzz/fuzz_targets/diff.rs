//! The first byte picks the dialect, the rest is two programs with a NUL between; without one, a program
//! and itself. What differs from the one to the other differs from the other to the one, and a program
//! is the same as itself.
#![no_main]

use libfuzzer_sys::fuzz_target;
use ncc::review::diff::document;
use ncc_dialects::{Settings, builtins};
use serde_json::Value;

fuzz_target!(|data: &[u8]| {
    let [from, text @ ..] = data else { return };
    let dialects: Vec<_> = builtins().collect();
    let settings = || Settings::new(dialects[usize::from(*from) % dialects.len()]);
    let found = |a: &[u8], b: &[u8]| -> Option<Value> {
        let document = document([(settings(), a), (settings(), b)], None).expect("anonymous files")?;
        Some(serde_json::from_str(&document).expect("JSON"))
    };
    let compared = |document: &Value, keys: [&str; 3]| keys.map(|key| document["compared"][key].clone());
    let (a, b) = match text.iter().position(|byte| *byte == 0) {
        Some(at) => (&text[..at], &text[at + 1..]),
        None => (text, text),
    };
    let (there, back) = (found(a, b), found(b, a));
    match (&there, &back) {
        (Some(there), Some(back)) => {
            assert_eq!(there["equal"], back["equal"], "{}\n{}", there["summary"], back["summary"]);
            let (to, fro) = (["same", "only_a", "only_b"], ["same", "only_b", "only_a"]);
            assert_eq!(compared(there, to), compared(back, fro));
            assert!(a != b || there["equal"] == true, "{}", there["summary"]);
        }
        (None, None) => {}
        (Some(_), None) | (None, Some(_)) => panic!("executed one way round only"),
    }
    document([(settings(), a), (settings(), b)], Some(&[])).expect("anonymous files");
});
