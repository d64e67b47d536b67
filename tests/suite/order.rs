//! The order in which passes run: which pass ran right behind which, over all programs into five dialects.
//!
//! `tests/order.txt` has a line for each such pair: `^` is the beginning of a translation. A pass that moves
//! changes the file, and so does one that nothing needs any more.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::rc::Rc;

use ncc_passes::PASSES;
use ncc_passes::watch::watch;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::{self, Failures};
use ncc_tests::translate::{job, translate};

/// Targets that lack different things.
const TARGETS: [&str; 5] = ["fanuc", "siemens", "linuxcnc", "grbl", "canon"];

#[test]
fn passes_run_in_their_order() {
    let pairs: Rc<RefCell<BTreeSet<(&str, &str)>>> = Rc::default();
    let programs = corpus::all().into_iter().chain(DIALECTS.into_iter().flat_map(corpus::computing));
    for program in programs {
        for to in TARGETS {
            let (pairs, mut last) = (Rc::clone(&pairs), "^");
            let _watch = watch(Box::new(move |pass, _| {
                if last != pass {
                    pairs.borrow_mut().insert((last, pass));
                }
                last = pass;
            }));
            translate(&job(program.dialect, to, &program.file), &program.text);
        }
    }
    let listed = |name: &str| name == "^" || PASSES.iter().any(|pass| pass.name == name);
    let unlisted: Vec<_> = pairs.borrow().iter().filter(|(a, b)| !listed(a) || !listed(b)).copied().collect();
    assert!(unlisted.is_empty(), "not in the table: {unlisted:?}");
    let mut text = String::new();
    for (first, second) in pairs.borrow().iter() {
        let _ = writeln!(text, "{first} {second}");
    }
    let mut failures = Failures::default();
    let path = corpus::root().join("tests/order.txt");
    failures.check("the order of passes", expect::file(&path, text.as_bytes()));
    failures.finish();
}
