//! `ncc git-diff`: a driver for git, which calls it with seven arguments.
//!
//! It prints the difference of what both versions do; of their texts, if one of them cannot be
//! executed, and says so. The exit code is 0 always: git takes anything else for a driver that has died.

use std::fmt::Write as _;
use std::fs::File;
use std::io::Write;
use std::path::Path;

use codespan_reporting::term::termcolor::{Buffer, WriteColor};
use ncc_driver::guess::{Guess, guess};
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::questions;
use ncc_driver::review::diff::motion::motion;
use ncc_driver::review::diff::tell::{Account, decoded};
use ncc_driver::side::Side;
use ncc_driver::source::not_milling;

use super::args::GitDiff;
use super::{SHOWN, plain, text, unified};
use crate::files;
use crate::project::Look;
use crate::registry::DialectRegistry;
use crate::review::side::{Asked, open};

/// Runs the verb.
///
/// # Errors
/// The arguments are not those of git, or stdout cannot be written.
pub fn run(args: &GitDiff, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    let word = |i: usize| args.git.get(i).map_or("", String::as_str);
    if args.git.len() == 1 {
        return print(&format!("{}: unmerged\n", word(0)));
    }
    if args.git.len() < 7 {
        return Err(Problem::usage(
            "git calls this with seven arguments",
            "put `diff.ncc.command = ncc git-diff` into git's configuration; to compare files: ncc diff A B",
        ));
    }
    let (path, old, new) = (word(0), word(1), word(4));
    let nothing = |file: &str| file == "/dev/null" || Path::new(file) == Path::new("nul");
    let mut out = format!("diff --ncc {path}\n");
    if let (true, true) = (args.git.len() > 8, !word(7).is_empty()) {
        out += &format!("renamed to {}\n", word(7));
    }
    match (nothing(old), nothing(new)) {
        (true, true) => {}
        (true, false) => out += &format!("new program: {}\n", extent(new)),
        (false, true) => out += &format!("deleted program: {}\n", extent(old)),
        (false, false) => out += &both(args, known, [old, new], path, err),
    }
    print(&out)
}

fn print(text: &str) -> Result<Exit, Problem> {
    files::to_stdout(&mut |out| out.write_all(text.as_bytes()))?;
    Ok(Exit::Done)
}

fn extent(file: &str) -> String {
    let lines = std::fs::read(file).map(|text| memchr::memchr_iter(b'\n', &text).count());
    lines.map_or_else(|e| e.to_string(), |n| format!("{n} blocks"))
}

/// The dialect of both versions: of the new one, else of the old one, else by the path.
fn dialect<'a>(args: &'a GitDiff, known: &'a DialectRegistry, versions: [&str; 2]) -> Option<&'a str> {
    if let Some(from) = &args.from {
        return Some(from);
    }
    versions.iter().rev().find_map(|file| match guess(&mut File::open(file).ok()?, known.all()).ok()? {
        Guess::Sure(dialect, ..) => Some(dialect.id.as_str()),
        Guess::Unsure(_) => None,
    })
}

fn both(
    args: &GitDiff,
    known: &DialectRegistry,
    versions: [&str; 2],
    path: &str,
    err: &mut dyn WriteColor,
) -> String {
    // Files of git have names of their own: they are never taken for `DIALECT:PATH`.
    let names = versions
        .map(|file| if Path::new(file).is_absolute() { file.to_owned() } else { format!("./{file}") });
    let look = Look::Git(Path::new(path));
    // The machine of a project file says which dialect it is.
    let named = match known.project(look, err) {
        Ok(row) => row.is_some_and(|row| row.machine.is_some()),
        Err(problem) => return format!("not compared: {}\n", problem.message),
    };
    let from = if named { args.from.as_deref() } else { dialect(args, known, versions) };
    let asked =
        |operand| Asked { look: Some(look), operand, from, options: &args.from_option, ..Asked::default() };
    if let Some(told) = of_texts(known, versions, path) {
        return told;
    }
    let mut quiet = Buffer::no_color();
    let opened = open([&asked(&names[0]), &asked(&names[1])], false, known, &mut quiet);
    let mut sides = match opened {
        Ok(sides) => sides,
        Err(problem) => return format!("not compared: {}\n", problem.message),
    };
    for (side, version) in sides.iter_mut().zip(["old", "new"]) {
        side.source.shown = format!("{path} ({version})");
    }
    let most = if args.all { usize::MAX } else { SHOWN };
    differences(&mut sides, most, err).unwrap_or_else(|e| format!("not compared: {e}\n"))
}

/// The difference of the texts, where a version is no milling program.
fn of_texts(known: &DialectRegistry, versions: [&str; 2], path: &str) -> Option<String> {
    let mut sources = versions.map(|file| files::open(Path::new(file)).ok());
    let mut out = String::new();
    for (source, version) in sources.iter_mut().zip(["old", "new"]) {
        if let Some(other) = not_milling::refusal(source.as_mut()?, known.all_for_mills()).ok()? {
            let _ = writeln!(out, "{path} ({version}) looks like {}; the texts are compared", other.kind);
        }
    }
    if out.is_empty() {
        return None;
    }
    let [old, new] = versions.map(|file| {
        let text = std::fs::read(file).unwrap_or_default();
        text.split_inclusive(|b| *b == b'\n').map(|line| decoded(line) + "\n").collect::<String>()
    });
    let names = ["old", "new"].map(|version| format!("{path} ({version})"));
    let difference = similar::TextDiff::from_lines(&old, &new);
    out += &difference.unified_diff().header(&names[0], &names[1]).to_string();
    Some(out)
}

fn differences(sides: &mut [Side; 2], most: usize, err: &mut dyn WriteColor) -> std::io::Result<String> {
    let found = motion(sides, None)?;
    for (side, course) in sides.iter_mut().zip(&found.courses) {
        // What cannot be reported changes nothing about what was found.
        let _ = questions::note(&side.job, &mut side.source, &course.diagnostics, !course.refused, err);
    }
    let mut out = Vec::new();
    if !found.refused() {
        plain::write(&mut out, &Account::of(&found, sides)?, most)?;
        return Ok(String::from_utf8_lossy(&out).into_owned());
    }
    for (side, course) in sides.iter().zip(&found.courses) {
        if course.refused {
            let dialect = &side.dialect().id;
            writeln!(out, "{} cannot be executed as {dialect}; the texts are compared", side.source.shown)?;
        }
    }
    unified(&mut out, &text::compare(sides, &[])?, most)?;
    Ok(String::from_utf8_lossy(&out).into_owned())
}
