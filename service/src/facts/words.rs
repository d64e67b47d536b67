//! Words and codes of a text, whether or not it can be executed.
//!
//! ```text
//! `N10 G01 X20.5 T03 (Rough slot)`    codes G1; words g1, t3, rough, slot
//! ```
//!
//! Lines are taken apart by the lexer of the dialect. Coordinates, feeds and block numbers are no words: nobody looks for them,
//! and a program has as many as it has blocks. Not here: the meaning of a code.

use std::collections::{BTreeMap, BTreeSet};

use ncc_dialects::{Dialect, Family, Role, Settings};
use ncc_frontends::pieces::{LineIs, Lines, Piece, PieceKind};

/// Bytes of a text that are looked at.
const LOOKED_AT: usize = 16 << 20;

/// Words of a program at most.
const MOST: usize = 20_000;

/// Characters of a word at most; the rest of a longer one is left out.
const LONGEST: usize = 40;

/// Words and codes of a text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Words {
    /// Distinct G and M codes as the trade writes them: `G1`, `G54.1`.
    pub(crate) codes: BTreeSet<String>,
    /// Distinct cycles: codes and names that the dictionary has as cycles.
    pub(crate) cycles: BTreeSet<String>,
    /// Words in small letters, each with the first line (from 1) that has it, and that line's first byte.
    pub(crate) words: BTreeMap<String, (i64, i64)>,
    /// Lines that are not empty.
    pub(crate) lines: u64,
    /// Whether the text is longer, or has more words, than is looked at.
    pub(crate) is_cut: bool,
}

/// A code without leading zeros: `G01` is `G1`, `G54.10` stays.
pub(crate) fn code(letter: char, number: &str) -> Option<String> {
    let (whole, part) = number.split_once('.').unwrap_or((number, ""));
    let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if number.is_empty() || number.len() > 12 || !digits(whole) || !digits(part) {
        return None;
    }
    let whole = match whole.trim_start_matches('0') {
        "" => "0",
        whole => whole,
    };
    let dot = if part.bytes().all(|digit| digit == b'0') { "" } else { "." };
    let part = if dot.is_empty() { "" } else { part };
    Some(format!("{}{whole}{dot}{part}", letter.to_ascii_uppercase()))
}

/// Words of plain text in small letters: letters, digits and `_`, and a point between digits.
pub(crate) fn words(text: &str, mut found: impl FnMut(String)) {
    let mut word = String::new();
    let mut signs = text.chars().peekable();
    while let Some(sign) = signs.next() {
        let follows = signs.peek().is_some_and(char::is_ascii_digit);
        let is_point = sign == '.' && word.ends_with(|last: char| last.is_ascii_digit()) && follows;
        if sign.is_alphanumeric() || sign == '_' || is_point {
            word.extend(sign.to_lowercase());
        } else if !word.is_empty() {
            found(settled(std::mem::take(&mut word)));
        }
    }
    if !word.is_empty() {
        found(settled(word));
    }
}

/// A word as it is kept: not too long, and a code without leading zeros.
fn settled(word: String) -> String {
    let mut signs = word.chars();
    let letter = signs.next().filter(|letter| matches!(letter, 'g' | 'm'));
    if let Some(code) = letter.and_then(|letter| code(letter, signs.as_str())) {
        return code.to_lowercase();
    }
    match word.char_indices().nth(LONGEST) {
        Some((end, _)) => word[..end].to_owned(),
        None => word,
    }
}

/// Text of a line; bytes that are no UTF-8 are signs of Latin-1.
fn text_of(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|byte| char::from(*byte)).collect(),
    }
}

impl Words {
    /// Those of a text; of one without a known dialect, as a text of letters and numbers.
    pub(crate) fn of(text: &[u8], dialect: Option<&'static Dialect>) -> Words {
        let any = || ncc_dialects::builtins().find(|dialect| dialect.family == Family::Word);
        let mut all = Words::default();
        let Some(dialect) = dialect.or_else(any) else { return all };
        let looked_at = &text[..text.len().min(LOOKED_AT)];
        all.is_cut = looked_at.len() < text.len();
        let (mut lines, mut pieces) = (Lines::new(Settings::new(dialect)), Vec::new());
        let (mut number, mut place) = (0, 0);
        for line in looked_at.split_inclusive(|byte| *byte == b'\n') {
            number += 1;
            let content = line.trim_ascii_end();
            all.lines += u64::from(!content.is_empty());
            let at = (number, place);
            match lines.line(content, &mut pieces) {
                LineIs::Blocks => all.block(dialect, content, &pieces, at),
                LineIs::Frame | LineIs::Outside | LineIs::Unread => all.plain(&text_of(content), at),
            }
            place += i64::try_from(line.len()).unwrap_or_default();
        }
        all
    }

    fn word(&mut self, word: String, at: (i64, i64)) {
        if self.words.len() >= MOST && !self.words.contains_key(&word) {
            self.is_cut = true;
            return;
        }
        self.words.entry(word).or_insert(at);
    }

    /// A text that is no block: numbers alone are no words.
    fn plain(&mut self, text: &str, at: (i64, i64)) {
        words(text, |word| {
            if word.chars().any(char::is_alphabetic) {
                self.word(word, at);
            }
        });
    }

    fn block(&mut self, dialect: &Dialect, line: &[u8], pieces: &[Piece], at: (i64, i64)) {
        let mut rest = pieces.iter().peekable();
        while let Some(piece) = rest.next() {
            let text = text_of(piece.text(line));
            match piece.kind {
                PieceKind::Address => {
                    let Some(next) = rest.next_if(|next| next.kind == PieceKind::Number) else { continue };
                    let letter = text.chars().next().unwrap_or(' ');
                    self.address(dialect, letter, &text_of(next.text(line)), at);
                }
                // After a tool's name, `T="MILL" M6`, the lexer of Siemens sees a letter of an expression.
                PieceKind::Letter if piece.depth == 0 && matches!(text.as_str(), "G" | "M" | "g" | "m") => {
                    if let Some(next) = rest.next_if(|next| next.kind == PieceKind::Number) {
                        self.address(
                            dialect,
                            text.chars().next().unwrap_or(' '),
                            &text_of(next.text(line)),
                            at,
                        );
                    }
                }
                PieceKind::Comment => words(&text, |word| self.word(word, at)),
                PieceKind::Name | PieceKind::Kept => {
                    self.plain(&text, at);
                    let name = text.to_uppercase();
                    if dialect.call.iter().any(|row| row.name == name) {
                        self.cycles.insert(name);
                    }
                }
                PieceKind::Key
                | PieceKind::Letter
                | PieceKind::Number
                | PieceKind::Sign
                | PieceKind::Skip
                | PieceKind::End => {}
            }
        }
    }

    /// A letter with its number.
    fn address(&mut self, dialect: &Dialect, letter: char, number: &str, at: (i64, i64)) {
        let letter = letter.to_ascii_uppercase();
        let Some(code) = code(letter, number) else { return };
        if matches!(letter, 'G' | 'M') {
            let is_cycle = dialect.cycle.iter().any(|row| row.code == code)
                || dialect.pattern.iter().any(|row| row.code() == code);
            if is_cycle {
                self.cycles.insert(code.clone());
            }
            self.word(code.to_lowercase(), at);
            self.codes.insert(code);
            return;
        }
        let is_number = dialect.block.number == Some(letter);
        let byte = u8::try_from(letter).unwrap_or_default();
        let is_word = match dialect.address_row(byte).map(|row| row.role) {
            Some(
                Role::Axis
                | Role::CentreX
                | Role::CentreY
                | Role::CentreZ
                | Role::Radius
                | Role::Feed
                | Role::Speed,
            ) => false,
            Some(
                Role::Tool
                | Role::ToolEdge
                | Role::LengthEntry
                | Role::Corrector
                | Role::RadiusEntry
                | Role::Call
                | Role::Parameter,
            )
            | None => !is_number,
        };
        if is_word {
            self.word(code.to_lowercase(), at);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(dialect: &str, text: &str) -> Words {
        Words::of(text.as_bytes(), ncc_dialects::builtin(dialect))
    }

    fn all(words: &Words) -> Vec<&str> {
        words.words.keys().map(String::as_str).collect()
    }

    #[test]
    fn codes_and_words_of_a_text_are_found() {
        let words = of(
            "fanuc",
            "%\nO0012 (Bügel 6.8)\nN10G00G90X1.5M06T03\nN20G081Z-3.R1.F100\nG54.1P2\n%\nlost G99\n",
        );
        let codes: Vec<_> = words.codes.iter().map(String::as_str).collect();
        assert_eq!(codes, ["G0", "G54.1", "G81", "G90", "M6"]);
        assert_eq!(words.cycles.iter().map(String::as_str).collect::<Vec<_>>(), ["G81"]);
        for (word, at) in
            [("bügel", (2, 2)), ("6.8", (2, 2)), ("o12", (2, 2)), ("t3", (3, 21)), ("lost", (7, 70))]
        {
            assert_eq!(words.words.get(word), Some(&at), "{word} of {:?}", all(&words));
        }
        assert!(
            !words.words.keys().any(|word| word.starts_with('x') || word.starts_with('n')),
            "{:?}",
            all(&words)
        );
        assert_eq!((words.lines, words.is_cut), (7, false));
    }

    #[test]
    fn names_of_siemens_are_words_and_cycles() {
        let words = of("siemens", "T=\"FRAESER_10\" M6\nMCALL CYCLE81(10,0,2,-5) ; Bohren\nSLOT_3\n");
        assert_eq!(words.cycles.iter().map(String::as_str).collect::<Vec<_>>(), ["CYCLE81"]);
        for word in ["fraeser_10", "bohren", "slot_3", "cycle81", "m6"] {
            assert!(words.words.contains_key(word), "{word} of {:?}", all(&words));
        }
    }

    #[test]
    fn a_text_of_any_bytes_has_few_words() {
        let many: String = (0..30_000).map(|n| format!("(w{n})\n")).collect();
        let words = of("fanuc", &many);
        assert_eq!((words.words.len(), words.is_cut), (MOST, true));
        let long = Words::of(&[b'x'; 100], None);
        assert!(long.words.keys().all(|word| word.len() == LONGEST), "{:?}", all(&long));
        assert_eq!(Words::of(b"(\xFCber)\n", None).words.get("über"), Some(&(1, 0)));
        assert_eq!(
            [code('g', "01"), code('M', "6.0"), code('G', "-1"), code('G', "")],
            [Some("G1".into()), Some("M6".into()), None, None]
        );
    }
}
