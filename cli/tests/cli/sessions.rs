//! Sessions of users: a program, commands, and what they print, in `tests/sessions/*.md`.
//!
//! A page is a heading and any number of pairs of fenced blocks: the program under the command that gets it as
//! `part.nc`, and the exit code with what is printed, the output first. `UPDATE_EXPECT=1` writes what is printed anew.

use std::fs;

use super::*;

const FENCE: &str = "```";

/// What a command prints, as the page shows it.
fn printed(done: &Done) -> String {
    let mut text = done.out.clone();
    if !text.is_empty() && !done.err.is_empty() {
        text += "---\n";
    }
    text += &done.err;
    format!("{FENCE}exit {}\n{}\n{FENCE}\n", done.code, text.trim_end())
}

/// The page as it is right.
fn run(page: &str) -> String {
    let mut right = String::new();
    let mut rest = page;
    while let Some(at) = rest.find(&format!("{FENCE}ncc ")) {
        let (before, from) = rest.split_at(at);
        let end = from[3..].find(&format!("\n{FENCE}\n")).expect("the end of a program") + 3;
        let (command, program) = from[3..end].split_once('\n').expect("a command and a program");
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("part.nc"), format!("{program}\n")).unwrap();
        let arguments: Vec<&str> = command.split(' ').skip(1).chain(["part.nc"]).collect();
        let done = ncc(folder.path(), &arguments);
        right += before;
        right += &from[..end + 5];
        right += "\n";
        right += &printed(&done);
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
