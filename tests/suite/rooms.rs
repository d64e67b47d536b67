//! The rooms of the house: which crate may know which, and how long a folder is.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use ncc_tests::corpus::root;
use ncc_tests::expect::Failures;

/// Each crate, and the crates of ours that it may know.
const ARROWS: &[(&str, &[&str])] = &[
    ("ir", &[]),
    ("ir/exec", &["ncc-ir"]),
    ("ir/passes", &["ncc-exec", "ncc-ir"]),
    ("ir/dialects", &["ncc-exec", "ncc-ir"]),
    ("frontends", &["ncc-dialects", "ncc-ir", "ncc-passes"]),
    ("backends", &["ncc-dialects", "ncc-exec", "ncc-ir", "ncc-passes"]),
    ("machines", &["ncc-dialects", "ncc-exec", "ncc-ir", "ncc-time"]),
    ("analysis/check", &["ncc-exec", "ncc-ir"]),
    ("analysis/diff", &["ncc-exec", "ncc-ir"]),
    ("analysis/plot", &["ncc-exec", "ncc-ir", "ncc-time"]),
    ("analysis/time", &["ncc-exec", "ncc-ir"]),
];

/// Most files and folders in a folder of source files.
const MOST: usize = 25;

/// Folders that have more, and how many: none may grow, and one that is short enough is taken out of here.
const LONGER: &[(&str, usize)] =
    &[("frontends/src/word", 52), ("cli/src", 46), ("frontends/src/siemens", 39), ("backends/src/word", 28)];

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
