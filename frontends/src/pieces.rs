//! A text taken apart without loss: for somebody who lays it out again and must not change what it says.
//!
//! Lines come one after the other, because what a line is depends on those before it: a mark that closes
//! the program, a unit that is none. Of a block, every byte but blanks belongs to one piece. A line that
//! the dialect's lexer cannot take apart is reported as such, never guessed at. Not here: what words mean,
//! and how they should look.

use ncc_dialects::{Family, Settings};

use crate::common::plain_words::plain_words;
pub use crate::common::plain_words::{MOST as MOST_PLAIN, PlainWord};
pub use crate::outline::{LineIs, Piece, PieceKind};
use crate::{siemens, word};

/// Takes the lines of one text apart.
#[derive(Clone, Debug)]
pub struct Lines {
    settings: Settings,
    /// Whether a mark has opened the text, or any line has stood without one.
    opened: bool,
    /// Whether the program is over.
    closed: bool,
}

impl Lines {
    /// For a text from its first line on.
    pub fn new(settings: Settings) -> Lines {
        Lines { settings, opened: false, closed: false }
    }

    /// Whether another text is in the state of this one: then both take the same next line apart in the same way.
    pub fn stands_as(&self, other: &Lines) -> bool {
        (self.opened, self.closed) == (other.opened, other.closed)
    }

    /// Another text, of which the same lines were taken apart, has come as far as this one.
    pub fn follow(&mut self, other: &Lines) {
        (self.opened, self.closed) = (other.opened, other.closed);
    }

    /// The words of the next line (without its end), where it is a block of nothing but capitals with numbers, one blank
    /// between each two. Then it need not be taken apart: its pieces are a letter, a minus where there is one, and a number
    /// for each word.
    pub fn plain<'w>(
        &mut self,
        line: &[u8],
        words: &'w mut [PlainWord; MOST_PLAIN],
    ) -> Option<&'w [PlainWord]> {
        let program = &self.settings.dialect.program;
        let of_program = program.number.map_or(0, |letter| letter as u8);
        let begins = |mark: &str| !mark.is_empty() && line.starts_with(mark.as_bytes());
        if self.closed || begins(&program.ignored) || begins(&program.frame) {
            return None;
        }
        let words = match self.settings.dialect.family {
            Family::Word | Family::Sinumerik => plain_words(line, words)?,
            Family::Canon | Family::Ir => return None,
        };
        if words.iter().any(|word| word.letter == of_program) {
            return None;
        }
        self.opened |= self.settings.dialect.family == Family::Word;
        Some(words)
    }

    /// Takes the next line (without its end) apart; `pieces` is emptied first. Families whose lines are
    /// no blocks of words are not taken apart.
    pub fn line(&mut self, line: &[u8], pieces: &mut Vec<Piece>) -> LineIs {
        pieces.clear();
        let dialect = self.settings.dialect;
        let is = match dialect.family {
            Family::Word => {
                let text = line.trim_ascii();
                // The end of a text file in old systems.
                self.closed |= text.first() == Some(&0x1A);
                let mark = dialect.program.frame.as_bytes();
                match () {
                    () if self.closed => LineIs::Outside,
                    () if !dialect.program.ignored.is_empty()
                        && text.starts_with(dialect.program.ignored.as_bytes()) =>
                    {
                        LineIs::Frame
                    }
                    () if !mark.is_empty() && text.starts_with(mark) => {
                        self.closed = std::mem::replace(&mut self.opened, true);
                        LineIs::Frame
                    }
                    () => {
                        self.opened |= !text.is_empty();
                        word::text::pieces::pieces(dialect, line, pieces)
                    }
                }
            }
            Family::Sinumerik => siemens::text::pieces::line(line, &mut self.closed, pieces),
            Family::Canon | Family::Ir => LineIs::Unread,
        };
        // Nothing may be lost.
        let mut at = 0;
        let whole = pieces.iter().all(|piece| {
            let blank = line.get(at..piece.start).is_some_and(is_blank);
            at = piece.end;
            blank
        });
        match is {
            LineIs::Blocks if whole && line.get(at..).is_some_and(is_blank) => LineIs::Blocks,
            LineIs::Blocks => {
                pieces.clear();
                LineIs::Unread
            }
            LineIs::Frame | LineIs::Outside | LineIs::Unread => {
                pieces.clear();
                is
            }
        }
    }
}

fn is_blank(text: &[u8]) -> bool {
    text.iter().all(|byte| matches!(byte, b' ' | b'\t'))
}
