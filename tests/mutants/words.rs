//! Mutants of an emitted text: every word is deleted, each of its digits changed, its sign
//! flipped, its code replaced by every sibling; neighbouring blocks are swapped.
//!
//! Words are found by a scan of its own, that knows nothing of the compiler's readers.

use std::ops::Range;

/// How a dialect's text is made up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// Letters and numbers; comments between these marks, the second one empty for the line's end.
    Letters(char, Option<char>),
    /// Functions with arguments; texts in quotation marks, notes after `#`.
    Functions,
    /// Letters and numbers, names with `=` and a value, calls with arguments, labels; comments to the
    /// end of the line, texts in quotation marks.
    Names,
}

/// A word of a text.
#[derive(Clone, Debug)]
pub(crate) struct Word {
    /// Where it stands.
    pub(crate) at: Range<usize>,
    /// What it is.
    pub(crate) is: Is,
}

/// What a word is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Is {
    /// A letter with a number; between them there may be `=`, and `AC(…)` or `IC(…)` about it.
    Letter(u8),
    /// A name with a value: `CR=5`, `I1=AC(3)`.
    Named,
    /// A label, with its colon.
    Label,
    /// A number of a function's arguments.
    Number,
    /// A name.
    Name,
    /// A comment or text.
    Text,
    /// A sign such as `%`, `/` or `&`.
    Sign,
}

/// What was done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Change {
    /// A word was deleted.
    Deleted,
    /// One of its digits was changed.
    Digit,
    /// Its sign was flipped.
    Sign,
    /// Its code was replaced by this one.
    Sibling(String),
    /// Its block and the next were swapped.
    Swapped,
}

/// A changed text.
#[derive(Clone, Debug)]
pub(crate) struct Mutant {
    /// What was done.
    pub(crate) change: Change,
    /// The word that it was done to; for swapped blocks, both of them.
    pub(crate) at: Range<usize>,
    /// What the word is.
    pub(crate) is: Is,
    /// The text.
    pub(crate) text: Vec<u8>,
}

/// The words of a text.
pub(crate) fn words(text: &[u8], form: Form) -> Vec<Word> {
    let mut words = Vec::new();
    let mut line_start = 0;
    for line in text.split_inclusive(|b| *b == b'\n') {
        match form {
            Form::Letters(open, close) => letters(line, line_start, open, close, &mut words),
            Form::Functions => functions(line, line_start, &mut words),
            Form::Names => super::names::words(line, line_start, &mut words),
        }
        line_start += line.len();
    }
    words
}

fn letters(line: &[u8], base: usize, open: char, close: Option<char>, words: &mut Vec<Word>) {
    let mut at = 0;
    while at < line.len() {
        let from = at;
        let c = line[at];
        at += 1;
        let is = if c == open as u8 {
            let end = match close {
                Some(close) => line[at..].iter().position(|b| *b == close as u8).map(|n| at + n + 1),
                None => line.iter().position(|b| *b == b'\r' || *b == b'\n'),
            };
            at = end.unwrap_or(line.len());
            Is::Text
        } else if c.is_ascii_alphabetic() {
            while at < line.len() && (line[at].is_ascii_digit() || b"+-.".contains(&line[at])) {
                at += 1;
            }
            Is::Letter(c)
        } else if c.is_ascii_whitespace() {
            continue;
        } else {
            // A skip mark and its level are one word.
            while c == b'/' && at < line.len() && line[at].is_ascii_digit() {
                at += 1;
            }
            Is::Sign
        };
        words.push(Word { at: base + from..base + at, is });
    }
}

fn functions(line: &[u8], base: usize, words: &mut Vec<Word>) {
    let mut at = 0;
    while at < line.len() {
        let from = at;
        let c = line[at];
        at += 1;
        let name = |b: u8| b.is_ascii_alphanumeric() || b == b'_' || b == b'-';
        let is = if c == b'"' {
            while at < line.len() && line[at] != b'"' {
                at += if line[at] == b'\\' { 2 } else { 1 };
            }
            at = (at + 1).min(line.len());
            Is::Text
        } else if c == b'#' {
            at = line.iter().position(|b| *b == b'\r' || *b == b'\n').unwrap_or(line.len()).max(at);
            Is::Text
        } else if c.is_ascii_digit() || c == b'-' || c == b'.' {
            while at < line.len() && (line[at].is_ascii_digit() || line[at] == b'.') {
                at += 1;
            }
            // The unit belongs to the number.
            while at < line.len() && line[at].is_ascii_lowercase() {
                at += 1;
            }
            Is::Number
        } else if c.is_ascii_alphabetic() {
            while at < line.len() && name(line[at]) {
                at += 1;
            }
            Is::Name
        } else if c == b'/' || c == b'&' {
            Is::Sign
        } else {
            continue;
        };
        words.push(Word { at: base + from..base + at, is });
    }
}

/// Codes that may be taken for each other, as written in any of the dialects.
const SIBLINGS: &[&[&str]] = &[
    &["G0", "G1", "G2", "G3"],
    &["G17", "G18", "G19"],
    &["G20", "G21"],
    &["G70", "G71", "G700", "G710"],
    &["G90", "G91"],
    &["G98", "G99"],
    &["G43", "G49"],
    &["G54", "G55", "G56", "G57", "G58", "G59", "G500", "G505", "G506"],
    &["G80", "G81", "G82", "G83", "G85", "G89"],
    &["G24", "G25"],
    &["G4", "G40", "G94", "G66"],
    &["M0", "M1", "M2", "M30"],
    &["M3", "M4", "M5"],
    &["M7", "M8", "M9"],
    &["M98", "M99"],
    &["STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "HOLE", "POSITION"],
    &["START_SPINDLE_CLOCKWISE", "START_SPINDLE_COUNTERCLOCKWISE", "STOP_SPINDLE_TURNING"],
    &["FLOOD_ON", "MIST_ON", "FLOOD_OFF", "MIST_OFF", "COOLANT_OFF"],
    &["PROGRAM_STOP", "OPTIONAL_PROGRAM_STOP", "PROGRAM_END"],
    &["SET_FEED_RATE", "SET_SPINDLE_SPEED", "DWELL"],
    &["SELECT_TOOL", "USE_TOOL_LENGTH_OFFSET", "CHANGE_TOOL"],
    &["START_CYCLE", "END_CYCLE"],
    &["mm", "inch"],
    &["CANON_UNITS_MM", "CANON_UNITS_INCHES"],
    &["CANON_PLANE_XY", "CANON_PLANE_YZ", "CANON_PLANE_XZ"],
    &["XY", "ZX", "YZ"],
    &["X", "Y", "Z", "A", "B", "C"],
    &["I", "J", "K"],
    &["absolute", "incremental"],
    &["initial", "retract"],
    &["clockwise", "counterclockwise"],
    &["raise-first", "plane-first"],
    &["drill", "bore"],
    &["start", "zero"],
    &["inc", "entry"],
    &["CYCLE81", "CYCLE82", "CYCLE83", "CYCLE85"],
    &["HOLES1", "HOLES2", "CYCLE801", "CYCLE802"],
    &["TRANS", "ATRANS", "SCALE", "ROT", "MIRROR"],
    &["ROT", "AROT", "TRANS"],
    &["SCALE", "ASCALE", "MIRROR"],
    &["MIRROR", "AMIRROR", "TRANS"],
    &["ATRANS", "AROT", "ASCALE", "AMIRROR"],
    &["CIP", "CT", "G2", "G3"],
    &["SUPA", "G53", "G153"],
    &["M17", "RET", "M30"],
    &["CR", "AR", "TURN"],
    &["I1", "J1", "K1"],
    &["SET_FRAME", "ADD_FRAME"],
    &["translate", "scale"],
    &["USE_TOOL_EDGE", "USE_TOOL_LENGTH_OFFSET"],
];

/// All mutants of a text.
pub(crate) fn mutants(text: &[u8], form: Form) -> Vec<Mutant> {
    let mut all = Vec::new();
    for word in words(text, form) {
        let mut make = |change, with: &[u8]| {
            let mut changed = text[..word.at.start].to_vec();
            changed.extend_from_slice(with);
            changed.extend_from_slice(&text[word.at.end..]);
            all.push(Mutant { change, at: word.at.clone(), is: word.is, text: changed });
        };
        let old = &text[word.at.clone()];
        make(Change::Deleted, b"");
        if word.is == Is::Text {
            continue;
        }
        for (place, digit) in old.iter().enumerate().filter(|(_, b)| b.is_ascii_digit()) {
            let mut new = old.to_vec();
            new[place] = b'0' + (digit - b'0' + 1) % 10;
            make(Change::Digit, &new);
        }
        let number = value_at(old, word.is);
        if matches!(word.is, Is::Letter(_) | Is::Named | Is::Number) {
            let mut new = old.to_vec();
            match old.get(number) {
                Some(b'-') => drop(new.remove(number)),
                _ => new.insert(number, b'-'),
            }
            make(Change::Sign, &new);
        }
        let (name, value) = match old.iter().position(|b| *b == b'=') {
            Some(equals) => (&old[..equals], &old[equals..]),
            None => (old, &b""[..]),
        };
        let name = plain_code(&String::from_utf8_lossy(name));
        for group in SIBLINGS.iter().filter(|g| g.contains(&name.as_str())) {
            for sibling in group.iter().filter(|s| **s != name) {
                make(Change::Sibling((*sibling).to_owned()), &[sibling.as_bytes(), value].concat());
            }
        }
        // From zero, or from where the axis stands.
        for (mark, other) in [("=AC(", "=IC("), ("=IC(", "=AC(")] {
            if value.starts_with(mark.as_bytes()) {
                let new = [&old[..old.len() - value.len()], other.as_bytes(), &value[4..]].concat();
                make(Change::Sibling(other[1..3].to_owned()), &new);
            }
        }
    }
    all.extend(swapped(text));
    all
}

/// Where the number of a word begins.
fn value_at(word: &[u8], is: Is) -> usize {
    let at = match word.iter().position(|b| *b == b'=') {
        Some(equals) => equals + 1,
        None => usize::from(matches!(is, Is::Letter(_))),
    };
    let marked = [&b"AC("[..], b"IC("].iter().any(|mark| word[at..].starts_with(mark));
    if marked { at + 3 } else { at }
}

/// `G01` is `G1`.
fn plain_code(word: &str) -> String {
    match word.as_bytes() {
        [b'G' | b'M', b'0', _, ..] => format!("{}{}", &word[..1], &word[2..]),
        _ => word.to_owned(),
    }
}

fn swapped(text: &[u8]) -> Vec<Mutant> {
    let lines: Vec<&[u8]> = text.split_inclusive(|b| *b == b'\n').collect();
    let mut all = Vec::new();
    let mut start = 0;
    for pair in lines.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        if a != b && b.ends_with(b"\n") {
            let mut changed = text[..start].to_vec();
            changed.extend_from_slice(b);
            changed.extend_from_slice(a);
            changed.extend_from_slice(&text[start + a.len() + b.len()..]);
            let at = start..start + a.len() + b.len();
            all.push(Mutant { change: Change::Swapped, at, is: Is::Sign, text: changed });
        }
        start += a.len();
    }
    all
}
