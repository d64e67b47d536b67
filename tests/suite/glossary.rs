//! One word for one concept: phrases that never occur in the words that users read, and the glossary's word for each.
//!
//! Read here: messages, book, README, the command line's code, dictionaries and profiles. `in force` is looked for in
//! the comments of all crates too. Only phrases without another use are listed: `stands` and `says so` are left to people.

use std::fs;

use ncc_tests::corpus::root;
use ncc_tests::expect::Failures;

use crate::tidy::files;

/// A phrase in small letters, and the word of the glossary.
const NEVER: &[(&str, &str)] = &[
    ("a fault of ncc", "internal error"),
    ("anew", "again"),
    ("anonymous file", "temporary file"),
    ("by way of", "through, intermediate point"),
    ("called up", "active, activated"),
    ("come to from elsewhere", "jump target"),
    ("every way", "every path"),
    ("feed by time", "inverse-time feed"),
    ("feeds by time", "inverse-time feeds"),
    ("fineness", "least increment"),
    ("has a word for", "capability: supports"),
    ("has no word for", "capability: lacks"),
    ("has no words for", "capability: lacks"),
    ("has words for", "capability: supports"),
    ("have no word for", "capability: lack"),
    ("have words for", "capability: support"),
    ("in force", "active"),
    ("in step with", "spindle-synchronised"),
    ("level of return", "initial level, return level"),
    ("places of the machine", "machine coordinates"),
    ("plane of return", "R plane, return plane"),
    ("points of the machine", "reference points"),
    ("refused by name", "refused"),
    ("shift of the origin", "G92 shift"),
    ("sources leave open", "parameter"),
    ("stopped at an angle", "oriented spindle stop"),
    ("taken up", "active, takes effect"),
    ("that can be skipped", "block skip"),
    ("tool that is in", "tool in the spindle"),
    ("tool's centre", "tool centre, tool centre path"),
    ("tool's tip", "tool tip, tool centre point control"),
    ("turned onto", "tilted plane, swivelled to"),
    ("turning axes", "rotary axes"),
    ("turning axis", "rotary axis"),
    ("unit of the last digit", "least increment"),
    ("untaken", "uncovered"),
    ("way onto", "lead-in"),
    ("which way round", "direction"),
    ("worked out", "computed"),
    ("written out", "inlined, unrolled, expanded"),
];

/// Folders and files whose words users read, with the endings of the files.
const READ_BY_USERS: &[(&str, &[&str])] = &[
    ("driver/messages", &[".ftl", ".md"]),
    ("docs/book/src", &[".md"]),
    ("cli/src", &[".rs"]),
    ("ir/dialects/data", &[".toml"]),
    ("machines", &[".toml"]),
];

/// Crates whose comments are read too.
const CRATES: &[&str] = &["ir", "frontends", "backends", "machines", "analysis", "driver", "engine", "cli"];

/// Words of a text in small letters, one blank between them, whatever the marks of comments and lines. `lines` has the
/// offset at which each line begins.
struct Words {
    text: String,
    lines: Vec<usize>,
}

impl Words {
    /// Words of all lines that `counts` takes; any other line ends a sentence, as an empty one does.
    fn of(text: &str, counts: impl Fn(&str) -> bool) -> Words {
        let mut words = Words { text: String::new(), lines: Vec::new() };
        for line in text.lines().map(str::trim) {
            words.lines.push(words.text.len());
            let bare = line.trim_start_matches(['/', '!', '#', '>', '*']).trim_end_matches('\\');
            match bare.trim().is_empty() || !counts(line) {
                true => words.text.push('\n'),
                false => bare.split_whitespace().for_each(|word| {
                    words.text += &word.to_lowercase();
                    words.text.push(' ');
                }),
            }
        }
        words
    }

    /// The lines, from 1, in which a phrase begins.
    fn places(&self, phrase: &str) -> Vec<usize> {
        let of_a_word = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
        let stands_alone = |at: usize| {
            !self.text[..at].ends_with(of_a_word) && !self.text[at + phrase.len()..].starts_with(of_a_word)
        };
        let line = |at: usize| self.lines.partition_point(|begins| *begins <= at);
        self.text.match_indices(phrase).filter(|(at, _)| stands_alone(*at)).map(|(at, _)| line(at)).collect()
    }
}

#[test]
fn phrases_are_found() {
    let found = |text: &str, phrase: &str| Words::of(text, |_| true).places(phrase);
    assert_eq!(found("The plane In  force.\nlasts", "in force"), [1]);
    assert_eq!(found("a\n/// what is in\n/// force here", "in force"), [2]);
    assert_eq!(found("\"a text in \\\n   force\"", "in force"), [1]);
    assert_eq!(found("in\n\nforce", "in force"), [0; 0]);
    assert_eq!(found("unit_in force, in forces, in-force", "in force"), [0; 0]);
    let comments = Words::of("/// in\nlet force = 1;\n// in force", |line| line.starts_with("//"));
    assert_eq!(comments.places("in force"), [3]);
}

#[test]
fn the_glossarys_words_are_used() {
    let mut failures = Failures::default();
    let mut look = |path: &std::path::Path, never: &[(&str, &str)], comments: bool| {
        let name = path.strip_prefix(root()).unwrap_or(path).to_string_lossy().replace('\\', "/");
        let text = fs::read_to_string(path).expect("a text");
        let words = Words::of(&text, |line| !comments || line.starts_with("//"));
        for (phrase, word) in never {
            for line in words.places(phrase) {
                failures
                    .add(format!("{name}:{line}"), format!("`{phrase}`: the glossary's word is `{word}`"));
            }
        }
    };
    for (folder, endings) in READ_BY_USERS {
        files(folder, endings).iter().for_each(|path| look(path, NEVER, false));
    }
    look(&root().join("README.md"), NEVER, false);
    let in_force = NEVER.iter().filter(|(phrase, _)| *phrase == "in force").copied().collect::<Vec<_>>();
    for room in CRATES.iter().filter(|room| **room != "cli") {
        files(room, &[".rs"]).iter().for_each(|path| look(path, &in_force, true));
    }
    failures.finish();
}
