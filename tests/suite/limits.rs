//! How long things are: functions of more than 100 lines, files of more than 600, two `bool` parameters side by side.
//! A function that is one `match` of short arms is a table: it is marked so, and may have any length.
//!
//! `tests/limits.txt` has a line for each that is over its limit, with its length. None may grow, and none may come to it:
//! `UPDATE_EXPECT=1` writes the list anew only where it got shorter.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use ncc_tests::corpus::root;
use ncc_tests::expect::{self, Failures};

/// Most lines of a function, without those that are blank or a comment.
const FUNCTION: usize = 100;

/// Most lines of an arm of a table, which is a function that is one `match`.
const ARM: usize = 20;

/// Most lines of a file.
const FILE: usize = 600;

/// Folders with the code of the product.
const ROOMS: &[&str] = &["ir", "frontends", "backends", "machines", "analysis", "driver", "engine", "cli"];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            if !path.ends_with("tests") && !path.ends_with("target") {
                sources(&path, found);
            }
        } else if path.extension().is_some_and(|e| e == "rs") && !path.ends_with("tests.rs") {
            found.push(path);
        }
    }
}

/// The name of a function that begins in a line, and how far it is indented.
fn begins(line: &str) -> Option<(&str, usize)> {
    let text = line.trim_start();
    let indent = line.len() - text.len();
    let (before, rest) = text.split_once("fn ")?;
    let plain = before.split_whitespace().all(|word| {
        word.starts_with("pub")
            || ["const", "unsafe", "extern", "\"C\"", "in"].contains(&word)
            || word.ends_with(')')
    });
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_')?;
    plain.then_some((&rest[..end], indent))
}

/// How far a line is indented.
fn indent(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

/// Whether lines of code are one `match` of short arms, with little before and behind it.
fn is_table(code: &[&str]) -> bool {
    let matches = code.iter().enumerate().filter(|(_, line)| line.contains("match ") && line.ends_with('{'));
    matches.into_iter().any(|(at, line)| {
        let depth = indent(line);
        let arms = code[at + 1..].iter().take_while(|line| indent(line) > depth);
        let (mut lines, mut arm, mut longest) = (0, 0, 0);
        for line in arms {
            let begins = indent(line) == depth + 4 && !line.trim_start().starts_with(['}', ')']);
            arm = if begins { 1 } else { arm + 1 };
            longest = longest.max(arm);
            lines += 1;
        }
        lines * 10 >= code.len() * 8 && longest <= ARM
    })
}

/// What is over its limit in a file: `what` to how much.
fn over(name: &str, text: &str, found: &mut BTreeMap<String, usize>) {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let lines: Vec<&str> = text.lines().collect();
    if lines.len() > FILE {
        found.insert(format!("file {name}"), lines.len());
    }
    for (at, line) in lines.iter().enumerate() {
        let Some((function, indent)) = begins(line) else { continue };
        let close = format!("{}}}", " ".repeat(indent));
        // The signature ends where its body begins, or with a semicolon.
        let Some(open) =
            lines[at..].iter().position(|l| l.ends_with('{') || l.ends_with(';') || l.ends_with('}'))
        else {
            continue;
        };
        let signature = lines[at..=at + open].join(" ");
        let arguments =
            signature.split_once('(').map_or("", |(_, rest)| rest.split(" -> ").next().unwrap_or(rest));
        let two = arguments.split(',').map(|one| one.trim().trim_end_matches(['{', ')', ' ']));
        let two: Vec<bool> = two.map(|one| one.ends_with(": bool")).collect();
        if two.windows(2).any(|pair| pair == [true, true]) {
            found.insert(format!("bools {name} {function}"), 2);
        }
        if !lines[at + open].ends_with('{') {
            continue;
        }
        let body = lines[at + open + 1..].iter().take_while(|l| **l != close).copied();
        let code: Vec<&str> =
            body.filter(|l| !l.trim().is_empty() && !l.trim_start().starts_with("//")).collect();
        if code.len() > FUNCTION {
            if is_table(&code) {
                // It grows by a row where there is one more thing to say.
                found.insert(format!("table {name} {function}"), 0);
            } else {
                found.insert(format!("function {name} {function}"), code.len());
            }
        }
    }
}

#[test]
fn nothing_grows_over_its_limit() {
    let (mut paths, mut found) = (Vec::new(), BTreeMap::new());
    ROOMS.iter().for_each(|room| sources(&root().join(room), &mut paths));
    assert!(paths.len() > 400, "{}", paths.len());
    for path in paths {
        let name = path.strip_prefix(root()).unwrap_or(&path).to_string_lossy().replace('\\', "/");
        over(&name, &fs::read_to_string(&path).expect("a source file"), &mut found);
    }
    let list = root().join("tests/limits.txt");
    let before = fs::read_to_string(&list).unwrap_or_default();
    let allowed: BTreeMap<&str, usize> = before
        .lines()
        .filter_map(|line| line.rsplit_once(' ').and_then(|(what, much)| Some((what, much.parse().ok()?))))
        .collect();
    let mut failures = Failures::default();
    let mut text = String::new();
    for (what, much) in &found {
        let _ = writeln!(text, "{what} {much}");
        match allowed.get(what.as_str()) {
            Some(most) if much <= most => {}
            Some(most) => failures.add(what, format!("{much}, was {most}")),
            None if what.starts_with("table ") => {}
            None if before.is_empty() => {}
            None => failures.add(what, format!("{much} is over the limit")),
        }
    }
    if failures.count() == 0 {
        failures.check("the list", expect::file(&list, text.as_bytes()));
    }
    failures.finish();
}
