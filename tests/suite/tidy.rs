//! The house's rules that no compiler checks.

use std::fs;
use std::path::{Path, PathBuf};

use ncc_dialects::{Dialect, Family};
use ncc_tests::corpus::root;
use ncc_tests::expect::Failures;

/// Longest source file, in lines.
const LONGEST: usize = 700;

/// Files with one of these endings under a folder of the repository.
pub(crate) fn files(folder: &str, endings: &[&str]) -> Vec<PathBuf> {
    fn walk(folder: &Path, endings: &[&str], into: &mut Vec<PathBuf>) {
        let Ok(entries) = fs::read_dir(folder) else { return };
        for path in entries.filter_map(|e| Some(e.ok()?.path())) {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_symlink()
                || name == ".git"
                || name == "target"
                || name == "node_modules"
                || name == "proptest-regressions"
            {
                continue;
            }
            if path.is_dir() {
                walk(&path, endings, into);
            } else if endings.is_empty() || endings.iter().any(|e| name.ends_with(e)) {
                into.push(path);
            }
        }
    }
    let mut all = Vec::new();
    walk(&root().join(folder), endings, &mut all);
    all.sort();
    all
}

pub(crate) fn text(path: &Path) -> String {
    String::from_utf8_lossy(&fs::read(path).unwrap_or_default()).into_owned()
}

/// Rust code without comments and without the contents of strings; lines are kept.
pub(crate) fn code(text: &str, keep_strings: bool) -> String {
    let mut out = String::new();
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '/' if chars.peek() == Some(&'/') => {
                for c in chars.by_ref() {
                    if c == '\n' {
                        out.push('\n');
                        break;
                    }
                }
            }
            '\'' => {
                // A character, or a lifetime.
                out.push(c);
                let mut ahead = chars.clone();
                match (ahead.next(), ahead.next()) {
                    (Some('\\'), _) => {
                        chars.next();
                        chars.next();
                        for c in chars.by_ref() {
                            if c == '\'' {
                                break;
                            }
                        }
                    }
                    (Some(_), Some('\'')) => {
                        chars.next();
                        chars.next();
                    }
                    _ => {}
                }
            }
            '"' => {
                out.push('"');
                while let Some(c) = chars.next() {
                    match c {
                        '\\' => {
                            chars.next();
                        }
                        '"' => break,
                        '\n' => out.push('\n'),
                        c if keep_strings => out.push(c),
                        _ => {}
                    }
                }
                out.push('"');
            }
            c => out.push(c),
        }
    }
    out
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| !c.is_ascii_alphanumeric()).filter(|w| !w.is_empty())
}

/// Rooms that know controls by their capabilities alone.
const NO_DIALECT: &[&str] = &[
    "ir/src",
    "ir/exec/src",
    "ir/passes/src",
    "frontends/src/common",
    "frontends/src/word",
    "backends/src/common",
    "backends/src/word",
    "machines/src",
    "analysis",
];

/// Rooms that print nothing.
const SILENT: &[&str] = &["ir", "frontends", "backends", "machines", "analysis"];

#[test]
fn shared_code_names_no_dialect() {
    let named = |d: &&'static Dialect| matches!(d.family, Family::Word | Family::Sinumerik);
    let mut ids: Vec<&str> = ncc_dialects::builtins().filter(named).map(|d| d.id.as_str()).collect();
    assert!(ids.len() >= 4);
    ids.push("sinumerik");
    let mut failures = Failures::default();
    for folder in NO_DIALECT {
        let files = files(folder, &[".rs", ".lalrpop", ".js"]);
        assert!(!files.is_empty(), "{folder}");
        for path in files {
            // Tests may take a dialect as an example.
            if path.components().any(|c| c.as_os_str() == "tests") || path.ends_with("tests.rs") {
                continue;
            }
            let all = text(&path);
            let all = all.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
            for (number, line) in code(all, true).lines().enumerate() {
                // A file of data is named as it pleases.
                if line.contains("include_str!(\"../data/") {
                    continue;
                }
                if words(line).any(|w| ids.iter().any(|id| w.eq_ignore_ascii_case(id))) {
                    failures.add(format!("{}:{}", path.display(), number + 1), line);
                }
            }
        }
    }
    failures.finish();
}

#[test]
fn only_the_command_line_prints() {
    let mut failures = Failures::default();
    for folder in SILENT {
        let files = files(folder, &[".rs", ".lalrpop"]);
        assert!(!files.is_empty(), "{folder}");
        for path in files {
            // A benchmark tells its figures.
            if path.components().any(|c| c.as_os_str() == "benches") {
                continue;
            }
            for (number, line) in code(&text(&path), false).lines().enumerate() {
                if ["println!", "print!", "eprintln!", "eprint!", "dbg!"].iter().any(|m| line.contains(m)) {
                    failures.add(format!("{}:{}", path.display(), number + 1), line);
                }
            }
        }
    }
    failures.finish();
}

#[test]
fn files_are_short() {
    let mut failures = Failures::default();
    for path in files("", &[".rs", ".lalrpop"]) {
        let lines = text(&path).lines().count();
        if lines > LONGEST {
            failures.add(path.display(), format!("{lines} lines; at most {LONGEST}"));
        }
    }
    failures.finish();
}

#[test]
fn rust_files_say_what_they_are_for() {
    let mut failures = Failures::default();
    for path in files("", &[".rs"]) {
        let all = text(&path);
        // A build script is one line of what it builds.
        if !all.starts_with("//!") && !path.ends_with("build.rs") {
            failures.add(path.display(), "does not open with `//!`");
        }
    }
    failures.finish();
}

#[test]
fn no_paths_of_one_machine() {
    let mut failures = Failures::default();
    let places = ["/work", "/tmp", "/home", "/root"].map(|place| format!("{place}/"));
    for path in files("", &[]) {
        if path.ends_with("Cargo.lock") {
            continue;
        }
        for (number, line) in text(&path).lines().enumerate() {
            if places.iter().any(|p| line.contains(p.as_str())) {
                failures.add(format!("{}:{}", path.display(), number + 1), line.trim());
            }
        }
    }
    failures.finish();
}

/// A meaning has a source: every row of a dictionary names one that the dictionary lists.
#[test]
fn dictionary_rows_have_a_source() {
    let mut failures = Failures::default();
    for dialect in ncc_dialects::builtins().filter(|d| d.family == Family::Word) {
        for (row, source) in rows(dialect) {
            let named = dialect.sources.keys().any(|tag| words(source).any(|w| words(tag).next() == Some(w)))
                || source.starts_with("parameter");
            if !named {
                failures.add(format!("{} {row}", dialect.id), format!("source = {source:?}"));
            }
        }
    }
    failures.finish();
}

fn rows(d: &Dialect) -> Vec<(String, &str)> {
    let mut rows: Vec<(String, &str)> = vec![
        ("program".into(), &d.program.source),
        ("comment".into(), &d.comment.source),
        ("block".into(), &d.block.source),
        ("arc".into(), &d.arc.source),
        ("cycles".into(), &d.cycles.source),
    ];
    rows.extend(d.address.iter().map(|r| (format!("address {}", r.letter), r.source.as_str())));
    rows.extend(d.cycle.iter().map(|r| (format!("cycle {}", r.code), r.source.as_str())));
    rows.extend(d.code.iter().map(|r| (format!("code {}", r.code), r.source.as_str())));
    rows.extend(d.option.iter().map(|r| (format!("option {}", r.name), r.source.as_str())));
    rows.extend(d.behaviour.iter().map(|r| (format!("behaviour {}", r.name), r.source.as_str())));
    let p = &d.power_on;
    let facts = [
        ("units", p.units.as_ref().map(|f| &f.source)),
        ("distance", p.distance.as_ref().map(|f| &f.source)),
        ("plane", p.plane.as_ref().map(|f| &f.source)),
        ("feed_mode", p.feed_mode.as_ref().map(|f| &f.source)),
        ("return_level", p.return_level.as_ref().map(|f| &f.source)),
        ("length_offset", p.length_offset.as_ref().map(|f| &f.source)),
        ("no_origin_shift", p.no_origin_shift.as_ref().map(|f| &f.source)),
    ];
    rows.extend(facts.into_iter().filter_map(|(name, s)| Some((format!("power_on {name}"), s?.as_str()))));
    rows
}

/// A new `Op` must fail to compile until each writer has answered for it.
#[test]
fn backends_answer_for_every_op() {
    let mut failures = Failures::default();
    for path in files("backends/src", &[".rs"]) {
        let code = code(&text(&path), false);
        for (at, arms) in matches_in(&code) {
            let on_op = arms.iter().any(|arm| arm.starts_with("Op::"));
            let catch_all = arms.iter().any(|arm| {
                let pattern = arm.split("=>").next().unwrap_or("").trim();
                pattern == "_" || pattern.starts_with("_ if")
            });
            if on_op && catch_all {
                let line = code[..at].lines().count();
                failures.add(format!("{}:{line}", path.display()), "a `_` arm in a match on `Op`");
            }
        }
    }
    failures.finish();
}

/// Where each `match` begins, and its arms as text.
fn matches_in(code: &str) -> Vec<(usize, Vec<String>)> {
    let mut found = Vec::new();
    for (at, _) in code.match_indices("match ") {
        let before = code[..at].chars().next_back().unwrap_or(' ');
        if before.is_alphanumeric() || before == '_' {
            continue;
        }
        let Some(open) = code[at..].find('{').map(|o| at + o) else { continue };
        let (mut depth, mut arm, mut arms) = (0, String::new(), Vec::new());
        for c in code[open..].chars() {
            match c {
                '{' | '(' | '[' => depth += 1,
                '}' | ')' | ']' => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                break;
            }
            // An arm ends at a comma, or at the brace that closes its block.
            let ends = depth == 1 && (c == ',' || (c == '}' && arm.contains("=>")));
            if ends {
                arms.push(std::mem::take(&mut arm).trim().to_owned());
            } else if !(depth == 1 && c == '{' && arm.is_empty()) {
                arm.push(c);
            }
        }
        arms.push(arm.trim().to_owned());
        found.push((at, arms));
    }
    found
}

#[test]
fn the_scan_for_matches_finds_a_catch_all() {
    let code = "fn f() { match op { Op::A(x) => { g(x) } Op::B { .. } | Op::C => 1, _ => 2 } }";
    let arms = &matches_in(code)[0].1;
    assert_eq!(arms.len(), 3, "{arms:?}");
    assert!(arms[2].starts_with("_ "), "{arms:?}");
}
