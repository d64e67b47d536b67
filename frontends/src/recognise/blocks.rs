//! A line cut into what all these languages share: letters with numbers, names, comments.

use std::ops::Range;

/// A letter with what follows it.
#[derive(Clone, Debug)]
pub(super) struct Word {
    /// The letter, a capital.
    pub(super) letter: u8,
    /// Its number; `None` is a value that is computed, or none.
    pub(super) value: Option<f64>,
    /// Digits before the point, leading zeros too.
    pub(super) digits: usize,
    /// Whether there is a point.
    pub(super) point: bool,
    /// Bytes of the text.
    pub(super) place: Range<usize>,
}

impl Word {
    /// Ten times the number of a code; `None` is no code.
    pub(super) fn tenths(&self) -> Option<u32> {
        let tenths = self.value? * 10.0;
        ((0.0..1e6).contains(&tenths) && tenths.fract() == 0.0).then_some(tenths as u32)
    }
}

/// A line.
#[derive(Debug, Default)]
pub(super) struct Block {
    /// Its words.
    pub(super) words: Vec<Word>,
    /// Its words of several letters, as they are written.
    pub(super) names: Vec<(Vec<u8>, Range<usize>)>,
    /// What is neither comment nor blank, in capitals.
    pub(super) code: Vec<u8>,
    /// All of it, in capitals, without blanks at its ends.
    pub(super) text: Vec<u8>,
    /// Bytes of the text, without blanks at the ends.
    pub(super) place: Range<usize>,
    /// Its letters, a bit each.
    pub(super) letters: u32,
    /// Whether a macro or a subprogram is called, whose arguments may be any letters.
    pub(super) calls: bool,
}

/// A bit for a letter.
pub(super) fn bit(letter: u8) -> u32 {
    1 << (letter.to_ascii_uppercase() - b'A')
}

/// A number of a few digits, as the library's parser gives it: the quotient of two integers that a float holds exactly
/// is rounded once.
fn short(text: &[u8]) -> Option<f64> {
    let (negative, text) = text.strip_prefix(b"-").map_or((false, text), |rest| (true, rest));
    let (mut whole, mut divisor, mut point) = (0u32, 1u32, false);
    if text.len() > 9 || !text.iter().any(u8::is_ascii_digit) {
        return None;
    }
    for byte in text {
        match byte {
            b'0'..=b'9' => {
                whole = whole * 10 + u32::from(byte - b'0');
                divisor *= if point { 10 } else { 1 };
            }
            b'.' if !point => point = true,
            _ => return None,
        }
    }
    let value = f64::from(whole) / f64::from(divisor);
    Some(if negative { -value } else { value })
}

impl Block {
    /// Reads a line that begins at `base`.
    pub(super) fn read(&mut self, line: &[u8], base: usize) {
        self.words.clear();
        self.names.clear();
        self.code.clear();
        self.letters = 0;
        let start = line.iter().take_while(|b| b.is_ascii_whitespace()).count();
        let trimmed = line.trim_ascii();
        self.text.clear();
        self.text.extend(trimmed.iter().map(u8::to_ascii_uppercase));
        self.place = base + start..base + start + trimmed.len();
        self.cut(base + start);
        let calls = |word: &Word| {
            matches!((word.letter, word.tenths()), (b'G', Some(650 | 660 | 661)) | (b'M', Some(970 | 980)))
        };
        self.calls = self.words.iter().any(calls) || self.names.iter().any(|(name, _)| name == b"CALL");
        if !self.calls {
            self.letters = self.words.iter().fold(0, |all, word| all | bit(word.letter));
        }
    }

    fn cut(&mut self, base: usize) {
        let text = std::mem::take(&mut self.text);
        let mut at = 0;
        while let Some(&byte) = text.get(at) {
            match byte {
                b'(' => {
                    let end = text[at..].iter().position(|b| *b == b')');
                    at += end.map_or(text.len() - at, |end| end + 1);
                }
                b';' => break,
                b'"' => {
                    let end = text[at + 1..].iter().position(|b| *b == b'"');
                    at += end.map_or(text.len() - at, |end| end + 2);
                }
                b'<' => {
                    let end = text[at..].iter().position(|b| *b == b'>');
                    at += end.map_or(1, |end| end + 1);
                }
                b'A'..=b'Z' => at = self.letters(&text, at, base),
                _ => {
                    if !byte.is_ascii_whitespace() {
                        self.code.push(byte);
                    }
                    at += 1;
                }
            }
        }
        self.text = text;
    }

    /// A word or a name; gives where it ends.
    fn letters(&mut self, text: &[u8], from: usize, base: usize) -> usize {
        let letters = text[from..].iter().take_while(|b| b.is_ascii_uppercase()).count();
        if letters > 1 {
            let name = text[from..].iter().take_while(|b| b.is_ascii_alphanumeric() || **b == b'_').count();
            self.code.extend_from_slice(&text[from..from + name]);
            self.names.push((text[from..from + name].to_vec(), base + from..base + from + name));
            return from + name;
        }
        let blanks = |at: usize| text[at..].iter().take_while(|b| b.is_ascii_whitespace()).count();
        let mut at = from + 1;
        at += blanks(at);
        if text.get(at) == Some(&b'=') {
            at += 1;
            at += blanks(at);
        }
        let number = text[at..].iter().take_while(|b| b"+-.0123456789".contains(b)).count();
        let digits = &text[at..at + number];
        let end = if number == 0 { from + 1 } else { at + number };
        let whole = digits.iter().filter(|b| !b"+-".contains(b)).take_while(|b| b.is_ascii_digit()).count();
        self.words.push(Word {
            letter: text[from],
            value: short(digits).or_else(|| std::str::from_utf8(digits).ok()?.parse().ok()),
            digits: whole,
            point: digits.contains(&b'.'),
            place: base + from..base + end,
        });
        self.code.extend(text[from..end].iter().filter(|b| !b.is_ascii_whitespace()));
        end
    }

    /// Whether there is a word of this letter.
    pub(super) fn has(&self, letter: u8) -> bool {
        self.letters & bit(letter) != 0
    }

    /// The first word of a letter.
    pub(super) fn word(&self, letter: u8) -> Option<&Word> {
        self.words.iter().find(|word| word.letter == letter).filter(|_| !self.calls)
    }

    /// The codes of a letter, in tenths: `G5.1` is 51.
    pub(super) fn codes(&self, letter: u8) -> impl Iterator<Item = (u32, &Word)> {
        let own = self.words.iter().filter(move |word| word.letter == letter);
        own.filter_map(|word| Some((word.tenths()?, word)))
    }

    /// Whether there is a code, in tenths.
    pub(super) fn code(&self, letter: u8, tenths: u32) -> bool {
        self.codes(letter).any(|(code, _)| code == tenths)
    }

    /// Whether there is nothing in it but comments.
    pub(super) fn is_empty(&self) -> bool {
        self.code.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_number_is_what_the_library_reads() {
        for text in ["0", "-0", "1", "12.5", "-.25", "100.", "0.001", "99999999", "1.2345678", "-7.0001"] {
            let bits = |value: f64| value.to_bits();
            assert_eq!(short(text.as_bytes()).map(bits), text.parse().ok().map(bits), "{text}");
        }
        for text in ["", "-", ".", "-.", "1.2.3", "1-2", "+1", "1234567890", "1e3"] {
            assert_eq!(short(text.as_bytes()), None, "{text}");
        }
    }
}
