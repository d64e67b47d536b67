//! `ncc time` with a machine's tables of work offsets and tools' lengths: programs in
//! `tests/time/tables`, each with what was computed by hand for it in its first comments.
//!
//! `machine:` names the profile; `seconds:` is the time of each function that takes any, in order;
//! `assumed:` is a line about tables that the summary has; no others are there.
//! `not canonical:` is why canonical functions cannot say it.

use std::fs;
use std::path::Path;

use ncc_tests::corpus::{files, root};
use ncc_tests::expect::Failures;

use crate::time::time;

#[test]
fn times_that_depend_on_tables() {
    let mut failures = Failures::default();
    let mut programs = 0;
    for path in files(&root().join("tests/time/tables")) {
        if path.extension().is_some_and(|e| e != "toml") {
            programs += 1;
            failures.check(path.display(), program(&path));
        }
    }
    assert!(programs >= 8, "{programs}");
    failures.finish();
}

/// Values of a key in the comments.
fn said<'t>(text: &'t str, key: &str) -> Vec<&'t str> {
    let lines = text.lines().filter_map(|line| line.strip_prefix("; ").or(line.strip_prefix('(')));
    let values = lines.filter_map(|line| line.trim_end_matches(')').strip_prefix(key));
    values.map(str::trim).collect()
}

fn program(path: &Path) -> Result<(), String> {
    let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
    let [machine] = said(&text, "machine:")[..] else { return Err("names no machine".into()) };
    let machine = path.with_file_name(machine);
    let machine = machine.to_str().ok_or("a name")?;
    let run = |form| time(&["--machine", machine, "--as", form], &[path]).map_err(|e| format!("{e:?}"));

    let csv = String::from_utf8(run("csv")?).map_err(|e| e.to_string())?;
    let figures = csv.lines().skip(1).filter_map(|row| row.rsplit(',').nth(1)?.parse::<f64>().ok());
    let figures: Vec<f64> = figures.filter(|seconds| *seconds != 0.0).collect();
    let [by_hand] = said(&text, "seconds:")[..] else { return Err("no seconds".into()) };
    let by_hand: Vec<f64> = by_hand.split_whitespace().filter_map(|n| n.parse().ok()).collect();
    let same = figures.len() == by_hand.len()
        && figures.iter().zip(&by_hand).all(|(figure, by_hand)| (figure - by_hand).abs() < 1e-6);
    if !same {
        return Err(format!("by hand {by_hand:?}\n    not {figures:?}"));
    }

    let wordless = !said(&text, "not canonical:").is_empty();
    if wordless && run("canon").is_ok() {
        return Err("canonical functions have words for it".into());
    }
    if !wordless {
        let canon = String::from_utf8(run("canon")?).map_err(|e| e.to_string())?;
        let end = canon.rsplit_once(", end ").and_then(|(_, end)| end.split('"').next()?.parse::<f64>().ok());
        let total: f64 = by_hand.iter().sum();
        if end.is_none_or(|end| (end - total).abs() > 1e-6) {
            return Err(format!("as canon it ends at {end:?}, not {total}"));
        }
    }

    let json: serde_json::Value = serde_json::from_slice(&run("json")?).map_err(|e| e.to_string())?;
    let lines = json["programs"][0]["assumed"].as_array().ok_or("no assumptions")?;
    let of_others =
        |line: &&str| line.starts_with("for the upper bound") || line.starts_with("the tool starts");
    let told: Vec<&str> = lines.iter().filter_map(|l| l.as_str()).filter(|l| !of_others(l)).collect();
    let assumed = said(&text, "assumed:");
    if told != assumed {
        return Err(format!("assumed {assumed:?}\n    not {told:?}"));
    }
    Ok(())
}
