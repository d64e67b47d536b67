//! Lines of nothing but words with numbers, told by their bytes alone: for somebody who asks for the words of a line, and
//! not for what they mean.
//!
//! ```text
//! X0.148 Y-99.835      two words: X and 0.148, Y and -99.835
//! X=10, X 10, x10      left to the lexers
//! ```
//!
//! A letter is followed by a number here, with a minus between them or not, so that it begins no word of a language with
//! names. One blank stands between two words, so that a line has one form.

use super::words::{Digits, tenths};
use crate::outline::Word;

/// Most words of such a line.
pub const MOST: usize = 12;

/// Bytes of the longest number; every lexer takes as many digits.
const LONGEST: usize = 15;

/// A letter with its number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PlainWord {
    /// A capital.
    pub letter: u8,
    /// Whether a minus stands before the number.
    pub negative: bool,
    /// Where the digits begin.
    pub start: usize,
    /// Where they end.
    pub end: usize,
}

impl PlainWord {
    /// As the lexers tell it.
    pub(crate) fn to_word(self, line: &[u8]) -> Word<'_> {
        let digits = line.get(self.start..self.end).and_then(Digits::parse);
        Word::Numbered { letter: self.letter, tenths: digits.and_then(tenths) }
    }
}

/// The words of a line without its end, if it is one of these; `words` is the memory for them.
pub(crate) fn plain_words<'w>(line: &[u8], words: &'w mut [PlainWord; MOST]) -> Option<&'w [PlainWord]> {
    let (mut at, mut count) = (0, 0);
    loop {
        let letter = *line.get(at)?;
        if !letter.is_ascii_uppercase() {
            return None;
        }
        at += 1;
        let negative = line.get(at) == Some(&b'-');
        at += usize::from(negative);
        let start = at;
        let mut point = false;
        while let Some(&byte) = line.get(at) {
            if byte == b'.' && !point && at > start {
                point = true;
            } else if !byte.is_ascii_digit() {
                break;
            }
            at += 1;
        }
        if at == start || at - start > LONGEST {
            return None;
        }
        *words.get_mut(count)? = PlainWord { letter, negative, start, end: at };
        count += 1;
        match line.get(at) {
            None => return words.get(..count),
            Some(b' ') => at += 1,
            Some(_) => return None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Word, words};
    use ncc_dialects::{Dialect, Family};

    /// What the lexers tell of a line: a comment after it, which has no words, keeps the short way off.
    fn by_lexer(dialect: &'static Dialect, line: &str) -> Vec<(u8, Option<u32>)> {
        let comment = &dialect.comment;
        let sign = if comment.open.trim().is_empty() { &comment.line } else { &comment.open };
        told(dialect, &format!("{line} {sign}{}", comment.close))
    }

    fn told(dialect: &'static Dialect, line: &str) -> Vec<(u8, Option<u32>)> {
        let mut found = Vec::new();
        words(dialect, line.as_bytes(), &mut |word| {
            found.push(match word {
                Word::Numbered { letter, tenths } => (letter, tenths),
                Word::Letter(letter) => (letter, Some(u32::MAX)),
                Word::Name(name) => (name[0], None),
            });
        });
        found
    }

    /// The short way tells what the lexer of each dialect tells.
    #[test]
    fn words_are_those_of_the_lexers() {
        let mut met = 0;
        for dialect in ncc_dialects::builtins() {
            if matches!(dialect.family, Family::Canon | Family::Ir) {
                continue;
            }
            for letter in b'A'..=b'Z' {
                for value in ["1", "-1", "0.5", "-0.25", "43.1", "10.", "007", "999999999999999"] {
                    let letter = letter as char;
                    for line in [
                        format!("{letter}{value}"),
                        format!("N10 {letter}{value} Y5"),
                        format!("X1.5 {letter}{value} G1 F100"),
                        format!("{letter}{value} {letter}{value}"),
                    ] {
                        let mut words = [PlainWord::default(); MOST];
                        met += u32::from(plain_words(line.as_bytes(), &mut words).is_some());
                        assert_eq!(told(dialect, &line), by_lexer(dialect, &line), "{}: {line}", dialect.id);
                    }
                }
            }
        }
        assert!(met > 1000);
    }

    #[test]
    fn other_lines_are_left_to_the_lexers() {
        let mut words = [PlainWord::default(); MOST];
        for line in [
            "",
            "X",
            "X ",
            "X1 ",
            " X1",
            "X1  Y1",
            "x1",
            "X1Y1",
            "X1.2.3",
            "X.5",
            "X=1",
            "X+1",
            "X--1",
            "X1;",
            "IF1",
            "X1234567890123456",
            "%",
            "A1 B1 C1 D1 E1 F1 G1 H1 I1 J1 K1 L1 M1",
        ] {
            assert_eq!(plain_words(line.as_bytes(), &mut words), None, "{line}");
        }
    }
}
