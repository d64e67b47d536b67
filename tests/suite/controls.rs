//! What one control does and another does not: `tests/controls/<from>-to-<to>/<name>.<extension>` beside `<name>.out`,
//! which holds the program that is written, or nothing where it is refused, and what the user is told.
//!
//! `<name>.options` states options of the two machines, one a line: `to arc_tolerance=0.02`.

use std::fs;
use std::path::Path;

use ncc_driver::job::Job;
use ncc_driver::render::Loudness;
use ncc_tests::corpus;
use ncc_tests::expect::{self, Failures};
use ncc_tests::translate::{job, told, translate};

/// Files beside the programs.
const BESIDE: [&str; 2] = ["out", "options"];

/// States the options of a case.
fn state(job: &mut Job, path: &Path) -> Result<(), String> {
    let Ok(text) = fs::read_to_string(path) else { return Ok(()) };
    for line in text.lines() {
        let (side, option) = line.split_once(' ').ok_or("no side")?;
        let (name, value) = option.split_once('=').ok_or("no value")?;
        let settings = if side == "from" { &mut job.from } else { &mut job.to };
        settings.choose(name, value).map_err(|fault| format!("{line}: {fault:?}"))?;
    }
    Ok(())
}

#[test]
fn what_controls_do_apart() {
    let mut failures = Failures::default();
    let (mut written, mut refused) = (0, 0);
    for folder in corpus::files(&corpus::root().join("tests/controls")) {
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let (from, to) = name.split_once("-to-").expect("a folder named after a pair");
        for path in corpus::files(&folder) {
            if BESIDE.iter().any(|own| path.extension().is_some_and(|e| e == *own)) {
                continue;
            }
            let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let what = format!("{name}/{file}");
            let text = fs::read(&path).expect("a program");
            let mut job = Job { head: false, ..job(from, to, &file) };
            failures.check(&what, state(&mut job, &path.with_extension("options")));
            let (outcome, mut said) = translate(&job, &text);
            match outcome.release.is_ok() {
                true => written += 1,
                false => refused += 1,
            }
            said.extend_from_slice(b"----\n");
            said.extend(told(&job, &file, &text, &outcome.diagnostics, Loudness::Usual).bytes());
            failures.check(&what, expect::file(&path.with_extension("out"), &said));
            let bug = outcome.diagnostics.iter().find(|d| (601..=602).contains(&d.fault.code()));
            if let Some(bug) = bug {
                failures.add(&what, format!("{:?}", bug.fault));
            }
        }
    }
    assert!(written > 0 && refused > 0, "{written} written, {refused} refused");
    failures.finish();
}
