//! A payload that was stored: rows and canonical functions that are made of it are those of its program.

use std::fs;
use std::path::{Path, PathBuf};

use ncc_driver::problem::Exit;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::Failures;
use serde_json::Value;

use crate::shared::beside;
use crate::time::{Folder, time};

/// A payload of a program as a file.
fn store(folder: &Folder, text: &[u8]) -> PathBuf {
    let path = folder.0.join("stored.json");
    fs::write(&path, text).expect("a file");
    path
}

/// A form of a stored payload.
fn stored(form: &str, path: &Path) -> Result<Vec<u8>, Exit> {
    time(&["--from", "payload", "--as", form], &[path])
}

/// Rows with the block left out, which the printed form has not whole.
fn without_blocks(rows: &[u8]) -> Vec<Vec<String>> {
    let fields = |line: &str| {
        let (mut fields, mut quoted) = (vec![String::new()], false);
        for letter in line.chars() {
            quoted ^= letter == '"';
            match letter {
                ',' if !quoted => fields.push(String::new()),
                _ => fields.last_mut().expect("a field").push(letter),
            }
        }
        fields.remove(1);
        fields
    };
    String::from_utf8_lossy(rows).lines().map(fields).collect()
}

/// Every program of the corpus, in both forms; before processing nothing can be made of it where it moves.
#[test]
fn rows_of_a_payload_are_those_of_its_program() {
    let mut failures = Failures::default();
    let (mut same, mut refused) = (0, 0);
    let folder = Folder::new();
    for dialect in DIALECTS {
        for program in corpus::of(dialect) {
            let path = corpus::root().join("corpus").join(dialect).join(&program.file);
            let what = format!("{dialect}/{}", program.file);
            let of = |form: &str, stage: &str| {
                time(&["--from", dialect, "--machine", "fanuc-vmc", "--stage", stage, "--as", form], &[&path])
            };
            let Ok(rows) = of("csv", "after") else { continue };
            let payload = of("payload", "after").expect("it is timed");
            match stored("csv", &store(&folder, &payload)) {
                Ok(again) if again == rows => same += 1,
                other => failures.add(&what, format!("{:?}", other.map(|text| text.len()))),
            }
            let printed = of("payload-printed", "after").expect("it is timed");
            match stored("csv", &store(&folder, &printed)) {
                Ok(again) if without_blocks(&again) == without_blocks(&rows) => {}
                other => failures.add(&what, format!("printed: {:?}", other.map(|text| text.len()))),
            }
            let before = of("payload", "before").expect("it is timed");
            match stored("csv", &store(&folder, &before)) {
                Err(Exit::Refused) => refused += 1,
                // Without a move that takes time, both stages are one.
                Ok(_) if !String::from_utf8_lossy(&rows).contains("STRAIGHT_FEED") => {}
                other => failures.add(&what, format!("before: {:?}", other.map(|text| text.len()))),
            }
        }
    }
    failures.finish();
    assert!(same > 150 && refused > 150, "{same} {refused}");
}

/// Table 12 comes out of the stored payload of table 9, too.
#[test]
fn table_12_is_listed_of_a_payload() {
    let Some(cases) = beside("cases/mach9") else { return };
    let folder = Folder::new();
    for form in ["payload", "payload-printed"] {
        let arguments = ["--machine", "romi-discovery-4022", "--start", "X-9,Y15.588,Z3", "--from-option"];
        let all = [&arguments[..], &["o_word=ignore", "--as", form]].concat();
        let payload = time(&all, &[&cases.join("table9.cn")]).expect("it is timed");
        let listed = stored("canon", &store(&folder, &payload)).expect("a list");
        let listed = String::from_utf8(listed).expect("text");
        let functions: Vec<&str> = listed.lines().filter(|line| !line.starts_with("COMMENT")).collect();
        let printed = fs::read_to_string(cases.join("table12.canon")).expect("the table");
        assert_eq!(functions, printed.lines().collect::<Vec<_>>());
        assert!(
            listed.contains("STRAIGHT_FEED(-15.0, -65.0, -8.0)\nCOMMENT(\"time 3.548387, end "),
            "{listed}"
        );
    }
}

/// What is listed takes as long as the program, on the same machine.
#[test]
fn what_is_listed_takes_as_long() {
    let total = |text: &[u8]| {
        let summary: Value = serde_json::from_slice(text).expect("JSON");
        summary["programs"][0]["total"]["time"].as_f64().expect("a time")
    };
    let mut failures = Failures::default();
    let folder = Folder::new();
    let mut listed = 0;
    for dialect in ["mach9", "fanuc", "canon"] {
        for program in corpus::of(dialect) {
            let path = corpus::root().join("corpus").join(dialect).join(&program.file);
            let what = format!("{dialect}/{}", program.file);
            let of = |from: &str, form: &str, path: &Path| {
                time(&["--from", from, "--machine", "romi-discovery-4022", "--as", form], &[path])
            };
            let Ok(payload) = of(dialect, "payload", &path) else { continue };
            let Ok(list) = stored("canon", &store(&folder, &payload)) else { continue };
            let file = folder.0.join("listed.canon");
            fs::write(&file, list).expect("a file");
            let times = [of(dialect, "json", &path), of("canon", "json", &file)];
            match times {
                [Ok(program), Ok(list)] if (total(&program) - total(&list)).abs() < 0.001 => listed += 1,
                [program, list] => {
                    failures.add(&what, format!("{:?}", [program, list].map(|t| t.map(|t| total(&t)))))
                }
            }
        }
    }
    failures.finish();
    assert!(listed > 60, "{listed}");
}
