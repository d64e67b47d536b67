//! Programs that are not for a mill: each kind is recognised, and no milling program is taken for one.

use std::fs;
use std::path::{Path, PathBuf};

use ncc_frontends::recognise::recognise;
use ncc_frontends::recognise::signs::Kind;
use ncc_tests::corpus::root;
use ncc_tests::expect::Failures;

/// Folders of `tests/recognise`, and what their programs look like.
const KINDS: [(&str, Option<Kind>); 8] = [
    ("lathe", Some(Kind::Lathe)),
    ("heidenhain", Some(Kind::Heidenhain)),
    ("okuma", Some(Kind::Okuma)),
    ("mazatrol", Some(Kind::Mazatrol)),
    ("wire-edm", Some(Kind::WireEdm)),
    ("printer", Some(Kind::Printer)),
    ("text", Some(Kind::Text)),
    ("mill", None),
];

fn files(folder: &Path, into: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    for path in paths {
        match path.is_dir() {
            true => files(&path, into),
            false => into.push(path),
        }
    }
}

fn kind(path: &Path) -> Option<Kind> {
    recognise(&fs::read(path).unwrap_or_default()).map(|finding| finding.kind)
}

#[test]
fn every_kind_is_recognised() {
    let mut failures = Failures::default();
    for (folder, expected) in KINDS {
        let mut all = Vec::new();
        files(&root().join("tests/recognise").join(folder), &mut all);
        assert!(all.len() >= 2, "{folder}: {} programs", all.len());
        for path in all {
            let found = kind(&path);
            if found != expected {
                failures.add(path.display(), format!("{found:?} instead of {expected:?}"));
            }
        }
    }
    failures.finish();
}

#[test]
fn no_milling_program_is_refused() {
    let mut all = Vec::new();
    for folder in ["corpus", "tests/faults", "tests/anywhere", "tests/fold", "tests/computing", "tests/check"]
    {
        files(&root().join(folder), &mut all);
    }
    let mut outputs = Vec::new();
    files(&root().join("tests/expected"), &mut outputs);
    // Listings and reports are no programs.
    outputs.retain(|path| path.extension().is_some_and(|ending| ending != "json" && ending != "txt"));
    all.extend(outputs);
    let shared = root().join("../shared/programs");
    match shared.is_dir() {
        true => files(&shared, &mut all),
        false => println!("skipped: {} is absent", shared.display()),
    }
    assert!(all.len() > 500, "{}", all.len());
    let mut failures = Failures::default();
    for path in all {
        if let Some(found) = kind(&path).filter(|_| !is_prose(&path)) {
            failures.add(path.display(), format!("taken for {found:?}"));
        }
    }
    failures.finish();
}

/// Whether a file describes programs, or is a report on one, and is none.
fn is_prose(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "md" || ending == "txt" || ending == "stderr")
}
