//! The rooms of the house: which crate may know which, which room of a crate its neighbours, and how long
//! a folder is.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use ncc_tests::corpus::root;
use ncc_tests::expect::Failures;

use crate::tidy::{code, files, text};

/// Each crate, and the crates of ours that it may know.
const ARROWS: &[(&str, &[&str])] = &[
    ("ir", &[]),
    ("ir/exec", &["ncc-ir"]),
    ("ir/passes", &["ncc-exec", "ncc-ir"]),
    ("ir/dialects", &["ncc-exec", "ncc-ir"]),
    ("frontends/ir", &["ncc-ir"]),
    ("frontends", &["ncc-dialects", "ncc-ir", "ncc-ir-text", "ncc-passes"]),
    ("backends", &["ncc-dialects", "ncc-exec", "ncc-ir", "ncc-passes"]),
    ("machines", &["ncc-dialects", "ncc-exec", "ncc-ir", "ncc-time"]),
    ("analysis/check", &["ncc-exec", "ncc-ir"]),
    ("analysis/diff", &["ncc-exec", "ncc-ir"]),
    ("analysis/plot", &["ncc-exec", "ncc-ir", "ncc-time"]),
    ("analysis/simulate", &[]),
    // It judges the compiler, so it knows nothing of it.
    ("tests/interpreter", &[]),
    ("analysis/time", &["ncc-exec", "ncc-ir"]),
    (
        "driver",
        &[
            "ncc-backends",
            "ncc-check",
            "ncc-dialects",
            "ncc-exec",
            "ncc-frontends",
            "ncc-ir",
            "ncc-machines",
            "ncc-passes",
            "ncc-plot",
            "ncc-simulate",
            "ncc-diff",
            "ncc-time",
        ],
    ),
    ("studio/host", &["ncc-engine", "ncc-exec"]),
    (
        "service",
        // The lexers split a program into the words by which it is found.
        &[
            "ncc-dialects",
            "ncc-driver",
            "ncc-engine",
            "ncc-exec",
            "ncc-frontends",
            "ncc-machines",
            "ncc-studio",
        ],
    ),
    (
        "engine",
        &[
            "ncc-backends",
            "ncc-dialects",
            "ncc-driver",
            "ncc-frontends",
            "ncc-ir",
            "ncc-machines",
            "ncc-simulate",
            "ncc-time",
        ],
    ),
];

/// Rooms of the crates that read and write: each, and what it may name of its neighbours.
const NEIGHBOURS: &[(&str, &str, &[&str])] = &[
    ("frontends", "common", &[]),
    ("frontends", "word", &["common"]),
    ("frontends", "siemens", &["common"]),
    ("frontends", "canon", &["common"]),
    ("frontends", "ir", &["common"]),
    ("backends", "common", &[]),
    ("backends", "word", &["common"]),
    ("backends", "siemens", &["common"]),
    ("backends", "canon", &["common"]),
    ("backends", "ir", &["common"]),
];

/// Most files and folders in a folder of source files.
const MOST: usize = 25;

/// Folders that have more, and how many: none may grow, and one that is short enough is taken out of here.
const LONGER: &[(&str, usize)] = &[];

/// Crates of ours under a heading of a manifest.
fn ours(manifest: &str, heading: &str) -> BTreeSet<String> {
    let table: toml::Table = manifest.parse().expect("a manifest");
    let names = table.get(heading).and_then(|part| part.as_table()).into_iter().flat_map(|part| part.keys());
    names.filter(|name| name.starts_with("ncc-")).cloned().collect()
}

#[test]
fn crates_know_only_those_below_them() {
    let mut failures = Failures::default();
    for (folder, may) in ARROWS {
        let manifest = fs::read_to_string(root().join(folder).join("Cargo.toml")).expect("a manifest");
        let may: BTreeSet<String> = may.iter().map(|name| (*name).to_owned()).collect();
        let known = ours(&manifest, "dependencies");
        if known != may {
            failures.add(folder, format!("knows {known:?}; the rooms are {may:?}"));
        }
    }
    failures.finish();
}

/// The paths of a `use` tree, each with `before` in front; other code ends it.
pub(crate) fn leaves(tree: &str, before: &str, found: &mut BTreeSet<String>) {
    let path_end = tree.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == ':'));
    let (path, rest) = tree.split_at(path_end.unwrap_or(tree.len()));
    let path = format!("{before}{path}");
    let Some(inner) = rest.strip_prefix('{') else {
        found.insert(path.trim_end_matches(':').to_owned());
        return;
    };
    let (mut open, mut from) = (0, 0);
    for (at, c) in inner.char_indices() {
        match c {
            '{' => open += 1,
            ',' | '}' if open == 0 => {
                let leaf = inner[from..at].trim();
                if !leaf.is_empty() {
                    leaves(leaf, &path, found);
                }
                from = at + 1;
                if c == '}' {
                    return;
                }
            }
            '}' => open -= 1,
            _ => {}
        }
    }
}

/// Paths from a crate's root that code of a module names, those of `use` trees one by one. `depth` is how many
/// times `super` leads from the module to the root.
fn from_root(code: &str, depth: usize) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let supers = "super::".repeat(depth);
    for root in ["crate::", supers.as_str()] {
        for (at, _) in code.match_indices(root) {
            let before = code[..at].chars().next_back().unwrap_or(' ');
            // A chain from a module within the file is longer; `$crate` is another crate's.
            if !before.is_ascii_alphanumeric() && !['_', '$'].contains(&before) {
                leaves(code[at + root.len()..].trim_start_matches("super::"), "", &mut found);
            }
        }
    }
    found
}

#[test]
fn rooms_know_only_the_neighbours_that_they_may() {
    let mut failures = Failures::default();
    let rooms: BTreeSet<&str> = NEIGHBOURS.iter().map(|(_, room, _)| *room).collect();
    for (folder, room, may) in NEIGHBOURS {
        let src = root().join(folder).join("src");
        let all = files(&format!("{folder}/src/{room}"), &[".rs", ".lalrpop"]);
        assert!(!all.is_empty(), "{folder} has no room {room}");
        for path in all {
            let parts: Vec<_> = path.strip_prefix(&src).expect("a file of the crate").iter().collect();
            let depth = parts.len() - usize::from(path.ends_with("mod.rs"));
            for named in from_root(&code(&text(&path), false), depth) {
                let first = named.split("::").next().unwrap_or_default();
                let may_name = may.iter().any(|own| named == *own || named.starts_with(&format!("{own}::")));
                if rooms.contains(first) && first != *room && !may_name {
                    failures.add(path.display(), format!("names {named}; {room} may name {may:?}"));
                }
            }
        }
    }
    failures.finish();
}

#[test]
fn paths_from_the_root_are_found() {
    let code = "use crate::common::words::{Digits, Word};\nuse crate::{Batch, word::{self, lower::Lower}};\n\
                fn f() { super::super::siemens::g(); super::near(); }";
    let found: Vec<String> = from_root(code, 2).into_iter().collect();
    let all = [
        "Batch",
        "common::words::Digits",
        "common::words::Word",
        "siemens::g",
        "word::lower::Lower",
        "word::self",
    ];
    assert_eq!(found, all);
}

#[test]
fn folders_are_short() {
    fn walk(folder: &Path, found: &mut Vec<(String, usize)>) {
        let Ok(entries) = fs::read_dir(folder) else { return };
        let entries: Vec<_> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
        let name = folder.strip_prefix(root()).unwrap_or(folder).to_string_lossy().replace('\\', "/");
        found.push((name, entries.len()));
        entries.iter().filter(|path| path.is_dir()).for_each(|path| walk(path, found));
    }
    let mut found = Vec::new();
    let folders = ARROWS.iter().map(|(folder, _)| *folder).chain(["cli"]);
    folders.for_each(|folder| walk(&root().join(folder).join("src"), &mut found));
    let mut failures = Failures::default();
    for (name, count) in found {
        let most = LONGER.iter().find(|(longer, _)| *longer == name).map_or(MOST, |(_, most)| *most);
        if count > most {
            failures.add(&name, format!("{count} files; at most {most}"));
        } else if most > MOST && count < most {
            failures.add(&name, format!("{count} files: say so in LONGER"));
        }
    }
    failures.finish();
}
