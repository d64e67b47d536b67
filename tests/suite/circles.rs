//! No file of these rooms names another that names it, on whatever detour: each can be read with those below it alone.
//!
//! Not here: methods, which a file may call of a type below it wherever they stand.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use ncc_tests::corpus::root;
use ncc_tests::expect::Failures;

use crate::rooms::leaves;
use crate::tidy::{code, files, text};

/// Crates whose files form no circle.
const ROOMS: &[&str] = &["frontends"];

/// The path of a module from the root of its crate.
type Module = Vec<String>;

/// The module of a file under `src`.
fn module(path: &Path) -> Module {
    let path = path.with_extension("");
    let mut parts: Module = path.iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if parts.last().is_some_and(|last| last == "mod" || last == "lib") {
        parts.pop();
    }
    parts
}

/// The other modules that code of one names by `crate::`, `super::` and the names of its own children. What it offers
/// further by `pub use` it does not need itself.
fn named(own: &Module, code: &str, all: &BTreeMap<Module, String>) -> BTreeSet<Module> {
    let mut found = BTreeSet::new();
    let mut before = String::new();
    for (at, c) in code.char_indices() {
        let within = before.chars().next_back().is_some_and(|b| b.is_alphanumeric() || b == '_');
        let path = !within && !before.ends_with("::") && (c.is_alphabetic() || c == '_');
        before.push(c);
        let line = code[..at].rsplit('\n').next().unwrap_or_default();
        if !path || line.starts_with("pub use ") {
            continue;
        }
        let mut paths = BTreeSet::new();
        leaves(&code[at..], "", &mut paths);
        for path in paths.iter().filter(|path| path.contains("::")) {
            let mut parts = path.split("::").peekable();
            let first = parts.peek().copied().unwrap_or_default();
            let child: Module = own.iter().cloned().chain([first.to_owned()]).collect();
            let mut full = match first {
                "crate" => Vec::new(),
                "super" => own.clone(),
                _ if all.contains_key(&child) => own.clone(),
                _ => continue,
            };
            for part in parts {
                match part {
                    "super" => drop(full.pop()),
                    "crate" | "self" => {}
                    part => full.push(part.to_owned()),
                }
            }
            while !all.contains_key(&full) && full.pop().is_some() {}
            found.extend(Some(full).filter(|full| full != own));
        }
    }
    found
}

/// The modules that come to themselves by way of others, and one of those.
fn circles(all: &BTreeMap<Module, String>) -> Vec<(Module, Module)> {
    let names: BTreeMap<_, _> = all.iter().map(|(own, code)| (own, named(own, code, all))).collect();
    let reaches = |from: &Module| {
        let mut seen: BTreeSet<&Module> = BTreeSet::new();
        let mut ahead: Vec<&Module> = names[from].iter().collect();
        while let Some(next) = ahead.pop() {
            if seen.insert(next) {
                ahead.extend(names.get(next).into_iter().flatten());
            }
        }
        seen.contains(from)
    };
    let circle: BTreeSet<&Module> = all.keys().filter(|own| reaches(own)).collect();
    let next = |own: &Module| names[own].iter().find(|to| circle.contains(to)).cloned().unwrap_or_default();
    circle.iter().map(|own| ((*own).clone(), next(own))).collect()
}

#[test]
fn files_form_no_circles() {
    let mut failures = Failures::default();
    for room in ROOMS {
        let src = root().join(room).join("src");
        let found = files(&format!("{room}/src"), &[".rs"]);
        let found = found.iter().filter(|path| !path.ends_with("tests.rs"));
        let all: BTreeMap<Module, String> = found
            .map(|path| {
                let text = text(path);
                let product = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
                (module(path.strip_prefix(&src).expect("a file of the room")), code(product, false))
            })
            .collect();
        assert!(all.len() > 1, "{room} has no files");
        for (own, to) in circles(&all) {
            failures.add(room, format!("{} is in a circle; it names {}", own.join("::"), to.join("::")));
        }
    }
    failures.finish();
}

#[test]
fn circles_are_found() {
    let file = |name: &str, code: &str| (module(Path::new(name)), code.to_owned());
    let found = |files: &[(Module, String)]| circles(&files.iter().cloned().collect()).len();
    let lib = file("lib.rs", "mod word;\npub use word::lower::Lower;\n");
    let word = file("word/mod.rs", "mod facts;\nmod lower;\npub use lower::Lower;\n");
    let facts = file("word/facts.rs", "use super::{lower::Lower, near};\n");
    let lower = file("word/lower.rs", "use crate::other::{Batch};\nfn f() { crate::word::facts::take() }\n");
    assert_eq!(found(&[lib.clone(), word.clone(), facts.clone(), lower]), 2);
    let lower = file("word/lower.rs", "pub struct Lower;\n");
    assert_eq!(found(&[lib, word, facts.clone(), lower.clone()]), 0);
    // A module that uses its child, which uses it.
    let word = file("word/mod.rs", "mod facts;\nuse facts::Kept;\npub(super) fn near() {}\n");
    assert_eq!(found(&[word, facts, lower]), 2);
}
