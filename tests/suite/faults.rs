//! Wrong programs and what is said about them: `tests/faults/<from>-to-<to>/<name>.<extension>`
//! beside `<name>.stderr`, as the user sees it.

use ncc_driver::render::Loudness;
use ncc_tests::corpus;
use ncc_tests::expect::{self, Failures};
use ncc_tests::translate::{job, stopping, told, translate};

/// Programs that are only warned of; all others must be refused.
const ONLY_WARNED: [&str; 6] =
    ["no-end", "nobody-calls", "text-after-end", "no-percent-end", "spindle-stands", "spindle-stopped"];

#[test]
fn wrong_programs_and_their_diagnostics() {
    let mut failures = Failures::default();
    let mut programs = 0;
    let mut codes = std::collections::BTreeSet::new();
    for folder in corpus::files(&corpus::root().join("tests/faults")) {
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let (from, to) = name.split_once("-to-").expect("a folder named after a pair");
        for path in corpus::files(&folder) {
            if path.extension().is_none_or(|e| e == "stderr") {
                continue;
            }
            programs += 1;
            let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let text = std::fs::read(&path).expect("a program");
            let job = job(from, to, &file);
            let (outcome, _) = translate(&job, &text);
            let said = told(&job, &file, &text, &outcome.diagnostics, Loudness::Usual);
            let what = format!("{name}/{file}");
            failures.check(&what, expect::file(&path.with_extension("stderr"), said.as_bytes()));
            if outcome.release.is_ok() != ONLY_WARNED.contains(&stem.as_str()) {
                failures.add(&what, format!("released: {:?}", outcome.release));
            }
            codes.extend(stopping(&job, &outcome));
        }
    }
    assert!(programs >= 40, "{programs} wrong programs");
    println!("{programs} wrong programs, {} codes", codes.len());
    failures.finish();
}

/// Every left-over expectation belongs to a program.
#[test]
fn no_orphans() {
    let mut failures = Failures::default();
    for folder in corpus::files(&corpus::root().join("tests/faults")) {
        let files = corpus::files(&folder);
        for path in files.iter().filter(|p| p.extension().is_some_and(|e| e == "stderr")) {
            let stem = path.file_stem();
            if !files.iter().any(|p| p != path && p.file_stem() == stem) {
                failures.add(path.display(), "no program");
            }
        }
    }
    failures.finish();
}
