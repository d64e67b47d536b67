//! A payload that was stored: the rows that are made of it are those of its program.

use std::fs;
use std::path::{Path, PathBuf};

use ncc_driver::problem::Exit;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::Failures;

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
