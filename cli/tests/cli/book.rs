//! The README and the book show what is printed, lead to where they say, and stay short. (Pictures are held in `plot`.)
//!
//! ```text
//! a block `gcode NAME`   is the file NAME, for all commands of the page
//! a block `console`      `$ ncc …` or `$ cat FILE`, and what that prints, the output first
//! ```

use std::fs;

use super::*;

/// Commands of the book whose whole output a page shows.
const SHOWN: [(&str, &[&str]); 4] = [
    (
        "use/simulate.md",
        &["simulate", "corpus/mach9/teste.cn", "--stock", "X-25:25 Y-75:75 Z-12:0", "--tool", "1=flat,50"],
    ),
    ("use/own-dialect.md", &["dialects"]),
    ("use/machines.md", &["machines"]),
    ("use/time.md", &["time", "corpus/mach9/teste.cn", "--machine", "romi-discovery-4022"]),
];

/// Most lines of the README: it fits on three screens.
const README_LINES: usize = 180;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A page of the book, by its place below `docs/book/src`.
pub(crate) fn page(place: &str) -> String {
    fs::read_to_string(root().join("docs/book/src").join(place)).unwrap()
}

/// The README and all pages of the book.
fn pages() -> Vec<PathBuf> {
    let mut pages = vec![root().join("README.md")];
    let mut folders = vec![root().join("docs/book/src")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            match entry.is_dir() {
                true => folders.push(entry),
                false if entry.extension().is_some_and(|end| end == "md") => pages.push(entry),
                false => {}
            }
        }
    }
    pages.sort();
    pages
}

#[test]
fn the_book_shows_what_is_printed() {
    for (place, arguments) in SHOWN {
        let printed = ncc(&root(), arguments).exits(0).out;
        let block = format!("```\n{printed}```\n");
        let arguments = arguments.join(" ");
        assert!(page(place).contains(&block), "ncc {arguments}: {place} does not show\n{printed}");
    }
}

/// The fenced blocks of a page: the info string and the text of each.
fn blocks(page: &str) -> Vec<(&str, &str)> {
    let mut found = Vec::new();
    let mut rest = page;
    while let Some(at) = rest.find("\n```") {
        let Some((head, text)) = rest[at + 4..].split_once('\n') else { break };
        let end =
            if text.starts_with("```") { 0 } else { text.find("\n```").map_or(text.len(), |at| at + 1) };
        found.push((head, &text[..end]));
        rest = text[end..].strip_prefix("```").unwrap_or_default();
    }
    found
}

/// Copies a folder.
fn copy(from: &Path, to: &Path) {
    fs::create_dir(to).unwrap();
    for entry in fs::read_dir(from).unwrap().map(Result::unwrap) {
        let to = to.join(entry.file_name());
        match entry.file_type().unwrap().is_dir() {
            true => copy(&entry.path(), &to),
            false => drop(fs::copy(entry.path(), to).unwrap()),
        }
    }
}

/// Runs a command of a `console` block and returns its output.
fn console(folder: &Path, command: &str) -> String {
    let words: Vec<&str> = command.split(' ').collect();
    match words[..] {
        ["ncc", ref arguments @ ..] => {
            let done = ncc(folder, arguments);
            done.out + &done.err
        }
        ["cat", file] => fs::read_to_string(folder.join(file)).unwrap(),
        _ => panic!("`{command}` is neither ncc nor cat"),
    }
}

/// With `UPDATE_EXPECT=1` the pages get what is printed.
#[test]
fn consoles_print_what_their_pages_show() {
    let update = std::env::var_os("UPDATE_EXPECT").is_some();
    let mut commands = 0;
    for path in pages() {
        let text = fs::read_to_string(&path).unwrap();
        let mut updated = text.clone();
        let folder = tempfile::tempdir().unwrap();
        if text.contains(" corpus/") && text.contains("```console") {
            copy(&root().join("corpus"), &folder.path().join("corpus"));
        }
        for (head, text) in blocks(&text) {
            if let Some(name) = head.strip_prefix("gcode ") {
                fs::write(folder.path().join(name), text).unwrap();
            }
            if head != "console" {
                continue;
            }
            let printed = text.lines().filter_map(|line| line.strip_prefix("$ ")).map(|command| {
                commands += 1;
                format!("$ {command}\n{}", console(folder.path(), command))
            });
            let printed = printed.collect::<String>();
            match update {
                true => {
                    updated = updated
                        .replace(&format!("```console\n{text}```"), &format!("```console\n{printed}```"))
                }
                false => assert_eq!(printed, text, "{}", path.display()),
            }
        }
        if updated != text {
            fs::write(&path, updated).unwrap();
        }
    }
    assert!(commands >= 5, "{commands}");
}

#[test]
fn links_lead_somewhere() {
    let book = root().join("docs/book/src").canonicalize().unwrap();
    let listed = page("SUMMARY.md");
    for path in pages() {
        let text = fs::read_to_string(&path).unwrap();
        let links = text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(link, _)| link);
        for link in links.filter(|link| !link.starts_with("http") && !link.starts_with('#')) {
            let file = link.split('#').next().unwrap_or(link);
            let to = path.parent().unwrap().join(file).canonicalize();
            let to = to.unwrap_or_else(|_| panic!("{}: {link} leads nowhere", path.display()));
            // The rendered book contains only files below `docs/book/src`.
            let inside = to.starts_with(&book) || path.ends_with("README.md");
            assert!(inside, "{}: {link} leads out of the book", path.display());
        }
        if let Ok(place) = path.canonicalize().unwrap().strip_prefix(&book) {
            let place = place.to_str().unwrap().replace('\\', "/");
            assert!(
                place == "SUMMARY.md" || listed.contains(&format!("({place})")),
                "{place} is not in the summary"
            );
        }
    }
}

#[test]
fn the_readme_is_short() {
    let lines = fs::read_to_string(root().join("README.md")).unwrap().lines().count();
    assert!(lines <= README_LINES, "{lines} lines");
}
