//! Where ncc's words stand: sentences for users are in `driver/messages`, and not in the code of the libraries.
//!
//! No file of a library has a string with three words side by side.
//!
//! Not counted: comments, tests, what only a developer sees (assertions, `expect`), `about` lines, which name a thing,
//! statements of the neutral text form, and text that another program reads or writes letter for letter.

use std::fs;

use ncc_tests::corpus::root;
use ncc_tests::expect::Failures;

use crate::tidy::files;

/// The libraries.
const ROOMS: &[&str] = &["ir", "frontends", "backends", "machines", "analysis", "driver", "engine"];

/// Words in front of a string that a user never sees, or that is the name of a thing.
const OTHER: &[&str] =
    &["assert", "expect(", "panic!", "unreachable!", "about", "#[", "Pass::named(", "Pass::parametric("];

/// Tables of `about` lines: each string in them names a thing or says what a key takes.
const ABOUT: &[&str] =
    &["analysis/check/src/rule.rs", "ir/src/behaviour.rs", "frontends/src/recognise/sources.rs"];

/// Text that another program reads or writes letter for letter, and ncc must too: the comments of LinuxCNC's
/// interpreter, and the texts by which ncc knows the alarms that it made itself.
const LETTER_FOR_LETTER: &[&str] = &["backends/src/canon/rs274/notes.rs", "ir/src/computed/alarm_texts.rs"];

/// Whether a string is statements of the neutral text form, or a cycle of one: `tap(clockwise, pitch 1.25mm)`. The bracket
/// after the name closes at the end of its line.
fn is_statement(text: &str) -> bool {
    text.split("\\n").all(|line| {
        let name = line.find('(').map_or("", |open| &line[..open]);
        let is_name = |c: char| c.is_ascii_alphabetic() || c == '_' || c == '-';
        let mut open = 0;
        let closes = line.char_indices().find(|(_, c)| {
            open += i32::from(*c == '(') - i32::from(*c == ')');
            *c == ')' && open == 0
        });
        !name.is_empty() && name.chars().all(is_name) && closes.is_some_and(|(at, _)| at + 1 == line.len())
    })
}

/// Whether a string has three words side by side, each of two letters or more.
fn is_sentence(text: &str) -> bool {
    let word = |word: &str| {
        let word = word.trim_matches(|c: char| "`.,:;!?()".contains(c));
        word.chars().count() > 1 && word.chars().all(|c| c.is_lowercase() || c == '\'')
    };
    let words: Vec<bool> = text.split_whitespace().map(word).collect();
    words.windows(3).any(|three| three == [true; 3])
}

/// How many sentences the strings of a file have.
fn sentences(text: &str) -> usize {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let mut rest = text;
    let mut count = 0;
    // The statement before a string tells who reads it.
    let mut before = String::new();
    while let Some(at) = rest.find(['"', '\'', '/', ';', '{', '}']) {
        before += &rest[..at];
        rest = &rest[at..];
        let hashes = before.chars().rev().take_while(|c| *c == '#').count();
        if rest.starts_with("//") {
            rest = rest.split_once('\n').map_or("", |(_, rest)| rest);
        } else if rest.starts_with('"') && before.trim_end_matches('#').ends_with('r') && hashes > 0 {
            // A raw string ends with as many signs as it begins with.
            let (string, after) =
                rest[1..].split_once(&format!("\"{}", "#".repeat(hashes))).unwrap_or_default();
            count += usize::from(is_sentence(string) && !OTHER.iter().any(|o| before.contains(o)));
            rest = after;
        } else if let Some(string) = rest.strip_prefix('"') {
            let mut end = 0;
            while let Some(next) = string[end..].find(['"', '\\']) {
                end += next;
                if string[end..].starts_with('"') {
                    break;
                }
                end += 1 + string[end + 1..].chars().next().map_or(0, char::len_utf8);
            }
            count += usize::from(
                is_sentence(&string[..end])
                    && !is_statement(&string[..end])
                    && !OTHER.iter().any(|o| before.contains(o)),
            );
            rest = string.get(end + 1..).unwrap_or("");
        } else if rest.starts_with("'\"'")
            || rest.starts_with("'{'")
            || rest.starts_with("'}'")
            || rest.starts_with("';'")
        {
            rest = &rest[3..];
        } else {
            if rest.starts_with([';', '{', '}']) {
                before.clear();
            }
            rest = &rest[1..];
        }
    }
    count
}

#[test]
fn sentences_are_found() {
    let found = |text: &str| sentences(text);
    assert_eq!(found("let a = \"this cannot be written\";"), 1);
    assert_eq!(found("// \"this cannot be written\"\nlet a = \"two words\"; let b = 'x';"), 0);
    assert_eq!(found("assert!(a, \"this cannot be written\"); f(\"so it is here\", '\"')"), 1);
    assert_eq!(found("#[cfg(test)]\nmod tests {\n \"this cannot be written\""), 0);
    assert_eq!(found("f(\"G54 X1. Y2.\", \"{from} to {to} and\")"), 0);
    assert_eq!(found("f(r#\"\"(a)\"\"#, 'b'); let a = \"this cannot be written\";"), 1);
    assert_eq!(found("f(r#\"he said \"so\" and this cannot be written\"#)"), 1);
    assert_eq!(found("f(\"tap(clockwise, shift along (X 1mm), pitch feed, after stopped)\")"), 0);
    assert_eq!(found("f(\"setting(s) of the block skip (all)\")"), 1);
}

#[test]
fn words_for_users_are_no_code_of_a_library() {
    let mut failures = Failures::default();
    for room in ROOMS {
        for path in files(room, &[".rs"]) {
            let name = path.strip_prefix(root()).unwrap_or(&path).to_string_lossy().replace('\\', "/");
            let is_test = ["/tests/", "tests.rs", "/benches/", "/examples/", "build.rs", "samples.rs"];
            if is_test.iter().any(|part| name.contains(part))
                || ABOUT.contains(&&*name)
                || LETTER_FOR_LETTER.contains(&&*name)
            {
                continue;
            }
            let count = sentences(&fs::read_to_string(&path).expect("a source file"));
            if count > 0 {
                failures.add(name, format!("{count} sentences: they belong into messages/"));
            }
        }
    }
    failures.finish();
}
