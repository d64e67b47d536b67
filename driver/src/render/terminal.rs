//! Keeps control characters of programs, profiles and file names away from a terminal.
//!
//! `ESC [2J` in a comment becomes `␛[2J`. Colours of ncc's own go past the filter, as calls of [`WriteColor`].
//! Not here: what is written to files and pipes as data.

use std::io::{self, Write};

use codespan_reporting::term::termcolor::{ColorSpec, WriteColor};

use super::text::visible;

/// Longest character in UTF-8, in bytes.
const LONGEST: usize = 4;

/// A writer that gets pictures in place of control characters; line ends and tabs stay.
#[derive(Debug)]
pub struct Shown<W: Write> {
    into: W,
    /// A character, or CR before LF, of which the rest has not come yet.
    begun: Vec<u8>,
}

impl<W: Write> Shown<W> {
    /// A filter before `into`.
    pub fn new(into: W) -> Shown<W> {
        Shown { into, begun: Vec::with_capacity(LONGEST) }
    }

    /// Writes what has begun as it is, and gives the writer back.
    ///
    /// # Errors
    /// Writing.
    pub fn finish(mut self) -> io::Result<W> {
        self.settle()?;
        Ok(self.into)
    }

    /// Nothing more comes of what has begun.
    fn settle(&mut self) -> io::Result<()> {
        match std::mem::take(&mut self.begun).as_slice() {
            [] => Ok(()),
            b"\r" => self.into.write_all("␍".as_bytes()),
            _ => self.into.write_all("\u{fffd}".as_bytes()),
        }
    }
}

/// The text for a terminal, and what has begun at its end: a character, or CR, of which the rest may follow.
fn shown(text: &[u8]) -> (String, &[u8]) {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while !rest.is_empty() {
        let (valid, behind) = match std::str::from_utf8(rest) {
            Ok(valid) => (valid, &[][..]),
            Err(error) => {
                let (valid, behind) = rest.split_at(error.valid_up_to());
                let valid = std::str::from_utf8(valid).unwrap_or_default();
                (valid, behind)
            }
        };
        let mut characters = valid.chars().peekable();
        while let Some(c) = characters.next() {
            match (c, characters.peek()) {
                ('\n', _) => out.push(c),
                ('\r', Some('\n')) => out.push(c),
                ('\r', None) if behind.is_empty() => return (out, b"\r"),
                _ => out.push(visible(c)),
            }
        }
        rest = behind;
        if let Err(error) = std::str::from_utf8(rest) {
            match error.error_len() {
                None => return (out, rest),
                Some(len) => {
                    out.push('\u{fffd}');
                    rest = &rest[len..];
                }
            }
        }
    }
    (out, &[])
}

/// A short text of the user's, such as a file name, for a terminal.
pub fn one_line(text: &str) -> String {
    text.chars().map(visible).collect()
}

impl<W: Write> Write for Shown<W> {
    fn write(&mut self, text: &[u8]) -> io::Result<usize> {
        let plain = |b: &u8| matches!(b, b' '..=b'~' | b'\n' | b'\t');
        if self.begun.is_empty() && text.iter().all(plain) {
            self.into.write_all(text)?;
            return Ok(text.len());
        }
        let mut whole = std::mem::take(&mut self.begun);
        whole.extend_from_slice(text);
        let (out, begun) = shown(&whole);
        self.into.write_all(out.as_bytes())?;
        self.begun = begun.to_owned();
        Ok(text.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.into.flush()
    }
}

impl<W: WriteColor> WriteColor for Shown<W> {
    fn supports_color(&self) -> bool {
        self.into.supports_color()
    }

    fn set_color(&mut self, spec: &ColorSpec) -> io::Result<()> {
        self.settle()?;
        self.into.set_color(spec)
    }

    fn reset(&mut self) -> io::Result<()> {
        self.settle()?;
        self.into.reset()
    }

    fn is_synchronous(&self) -> bool {
        self.into.is_synchronous()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(pieces: &[&[u8]]) -> String {
        let mut out = Shown::new(Vec::new());
        for piece in pieces {
            out.write_all(piece).unwrap();
        }
        String::from_utf8(out.finish().unwrap()).unwrap()
    }

    #[test]
    fn no_control_character_passes() {
        for c in (0..0x20u32).chain(0x7f..0xa0) {
            let c = char::from_u32(c).unwrap();
            let text = format!("a{c}b\n");
            let shown = all(&[text.as_bytes()]);
            let passes = matches!(c, '\n' | '\t');
            assert_eq!(shown.contains(c) && c != '\n', passes && c != '\n', "{c:?}");
            assert!(shown.starts_with('a') && shown.ends_with("b\n"), "{c:?}");
        }
        assert_eq!(all(&[b"\x1b]0;x\x07 \x9b31m \xc2\x9b31m"]), "␛]0;x␇ \u{fffd}31m \u{fffd}31m");
    }

    #[test]
    fn pieces_of_a_character_are_put_together() {
        assert_eq!(all(&[b"\xc3", b"\x9c\xe2\x80", b"\xa6"]), "Ü…");
        assert_eq!(all(&[b"\xc2", b"\x9b"]), "\u{fffd}");
        assert_eq!(all(&[b"a\r", b"\nb\rc\r"]), "a\r\nb␍c␍");
        assert_eq!(all(&[b"\xe2\x80"]), "\u{fffd}");
    }

    #[test]
    fn own_colours_pass() {
        use codespan_reporting::term::termcolor::{Ansi, Color};
        let mut out = Shown::new(Ansi::new(Vec::new()));
        out.set_color(ColorSpec::new().set_fg(Some(Color::Red))).unwrap();
        write!(out, "\x1b[2J").unwrap();
        out.reset().unwrap();
        let text = String::from_utf8(out.finish().unwrap().into_inner()).unwrap();
        assert_eq!(text, "\x1b[0m\x1b[31m␛[2J\x1b[0m");
    }
}
