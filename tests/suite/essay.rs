//! The examples in the heads of ncc-ir: each is a program of the text form that comes back as it is, verified.

use std::fs;

use ncc_driver::job::Job;
use ncc_tests::corpus::root;
use ncc_tests::expect::{Failures, diff};
use ncc_tests::translate::{job, translate};

#[test]
fn examples_of_the_text_form_are_programs() {
    let head = fs::read_to_string(root().join("ir/src/lib.rs")).expect("the essay");
    let lines: Vec<&str> = head.lines().map_while(|line| line.strip_prefix("//!")).collect();
    let text = lines.iter().map(|line| line.strip_prefix(' ').unwrap_or(line)).collect::<Vec<_>>().join("\n");
    let examples: Vec<&str> =
        text.split("```ir\n").skip(1).filter_map(|rest| Some(rest.split_once("```")?.0)).collect();
    let mut failures = Failures::default();
    assert!(examples.len() >= 3, "{}", examples.len());
    for example in examples {
        let (outcome, written) =
            translate(&Job { head: false, ..job("ir", "ir", "example.ir") }, example.as_bytes());
        if outcome.release.is_err() {
            failures.add(example, format!("{:?}", outcome.diagnostics));
        } else if written != example.as_bytes() {
            failures.add("it comes back otherwise", diff(example.as_bytes(), &written));
        }
    }
    failures.finish();
}
