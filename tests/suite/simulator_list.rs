//! The list of the CNC Web Simulator in the book (`reference/simulator.md`): every row has an answer, and the tests that it names
//! are there.

use std::collections::BTreeSet;
use std::fs;

use ncc_tests::corpus::{files, root};
use ncc_tests::expect::Failures;

/// The answers of the third column.
const ANSWERS: [&str; 5] = ["yes", "in part", "otherwise", "coming", "no"];

/// Names of tests: of the page, and of stock removal.
fn tests() -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for folder in ["studio/tests", "studio/host/tests", "engine/tests", "analysis/simulate/tests"] {
        for file in files(&root().join(folder)) {
            let text = fs::read_to_string(file).expect("a file of tests");
            for opening in ["page(\"", "both(\"", "test(\""] {
                let after = text.split(opening).skip(1).filter_map(|rest| rest.split('"').next());
                names.extend(after.map(str::to_owned));
            }
            let functions = text.split("fn ").skip(1).filter_map(|rest| rest.split('(').next());
            names.extend(functions.map(str::to_owned));
        }
    }
    names
}

#[test]
fn rows_of_the_list_are_answered_by_tests_that_are_there() {
    let page = fs::read_to_string(root().join("docs/book/src/reference/simulator.md")).expect("the page");
    let tests = tests();
    let (mut failures, mut rows, mut named) = (Failures::default(), BTreeSet::new(), 0);
    for line in page.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| row |")) {
        let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
        let [row, original, answer, how] = cells[..] else {
            failures.add(line, format!("{} columns", cells.len()));
            continue;
        };
        // Codes have no number.
        let name = if row.is_empty() { original.split(':').next().unwrap_or_default() } else { row };
        if !rows.insert(name.to_owned()) {
            failures.add(name, "it is there twice");
        }
        if !ANSWERS.contains(&answer) {
            failures.add(name, format!("`{answer}` is no answer"));
        }
        for test in how.split("*test* `").skip(1).filter_map(|rest| rest.split('`').next()) {
            named += 1;
            if !tests.contains(test) {
                failures.add(name, format!("there is no test `{test}`"));
            }
        }
    }
    assert!(rows.len() == 121 && named >= 60, "{} rows, {named} tests", rows.len());
    failures.finish();
}
