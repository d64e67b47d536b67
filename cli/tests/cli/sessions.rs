//! Sessions of users: files, commands, and what they print, in `tests/sessions/*.md`.
//!
//! A page is a heading and any number of pairs of fenced blocks: the program under the command that gets it as
//! `part.nc`, and the exit code with what is printed, the output first, then each file that the command has made. A
//! command without a program gets no `part.nc`. A block `file NAME` before it is a file that is there too, for all
//! commands up to the next heading. `UPDATE_EXPECT=1` writes what is printed anew.

use std::collections::BTreeMap;
use std::fs;

use super::*;

const FENCE: &str = "```";

/// What a command prints and makes, as the page shows it.
fn printed(done: &Done, made: &BTreeMap<String, String>) -> String {
    let mut text = done.out.clone();
    if !text.is_empty() && !done.err.is_empty() {
        text += "---\n";
    }
    text += &done.err;
    for (name, made) in made {
        text += &format!("--- {name}\n{made}");
    }
    format!("{FENCE}exit {}\n{}\n{FENCE}\n", done.code, text.trim_end())
}

/// The files below a folder, by their names.
fn files(folder: &Path, below: &str) -> BTreeMap<String, String> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = format!("{below}{}", entry.file_name().into_string().unwrap());
        match entry.file_type().unwrap().is_dir() {
            true => all.extend(files(&entry.path(), &format!("{name}/"))),
            false => drop(all.insert(name, fs::read_to_string(entry.path()).unwrap())),
        }
    }
    all
}

/// The page as it is right.
fn run(page: &str) -> String {
    let mut right = String::new();
    let mut rest = page;
    let mut there: BTreeMap<&str, &str> = BTreeMap::new();
    let blocks = [format!("{FENCE}ncc "), format!("{FENCE}file "), "\n#".to_owned()];
    while let Some(at) = blocks.iter().filter_map(|block| rest.find(block.as_str())).min() {
        let (before, from) = rest.split_at(at);
        right += before;
        if from.starts_with('\n') {
            there.clear();
            right += "\n#";
            rest = &from[2..];
            continue;
        }
        let end = from[3..].find(&format!("\n{FENCE}\n")).expect("the end of a block") + 3;
        let (head, text) = from[3..end].split_once('\n').unwrap_or((&from[3..end], ""));
        right += &from[..end + 5];
        if let Some(name) = head.strip_prefix("file ") {
            there.insert(name, text);
            rest = &from[end + 5..];
            continue;
        }
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in &there {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            let end = if text.is_empty() { "" } else { "\n" };
            fs::write(path, format!("{text}{end}")).unwrap();
        }
        let mut arguments: Vec<&str> = head.split(' ').skip(1).collect();
        if !text.is_empty() {
            fs::write(folder.path().join("part.nc"), format!("{text}\n")).unwrap();
            arguments.push("part.nc");
        }
        let before = files(folder.path(), "");
        let done = ncc(folder.path(), &arguments);
        let mut made = files(folder.path(), "");
        made.retain(|name, text| before.get(name) != Some(text));
        right += "\n";
        right += &printed(&done, &made);
        let behind = &from[end + 5..];
        rest = match behind.trim_start().strip_prefix(&format!("{FENCE}exit ")) {
            Some(shown) => {
                &shown[shown.find(&format!("\n{FENCE}\n")).expect("the end of what is printed") + 5..]
            }
            None => behind,
        };
    }
    right + rest
}

#[test]
fn sessions_print_what_their_pages_show() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/sessions");
    let mut differ = Vec::new();
    let mut pages: Vec<PathBuf> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    pages.sort();
    assert!(pages.len() > 3, "{pages:?}");
    for path in pages {
        let page = fs::read_to_string(&path).unwrap();
        let right = run(&page);
        if std::env::var_os("UPDATE_EXPECT").is_some() {
            fs::write(&path, right).unwrap();
        } else if right != page {
            differ.push(format!("── {}\n{right}", path.display()));
        }
    }
    assert!(differ.is_empty(), "UPDATE_EXPECT=1 writes them anew\n{}", differ.join("\n"));
}
