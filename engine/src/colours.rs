//! What an editor colours: stretches of lines with their kinds, by the lexers that the readers have.
//!
//! ```text
//! `N10 G01 X20.5 (SLOT)`    block-number 0..3, code-g 4..7, axis 8..13, comment 14..20
//! ```
//!
//! Kinds come from what a piece is and from the dictionary's role of its letter, never from what a block means: a line of
//! nonsense has colours, too. Columns count the units of UTF-16, as pages do. Not here: colours.

use ncc_dialects::{Dialect, Family, Role, Settings};
use ncc_frontends::pieces::{LineIs, Lines, MOST_PLAIN, Piece, PieceKind, PlainWord};
use serde_json::{Value, json};

use crate::program::Shared;

/// Kinds of stretches; a stretch names one by its place here.
const KINDS: [&str; 16] = [
    "comment",
    "block-number",
    "code-g",
    "code-m",
    "axis",
    "centre",
    "feed",
    "speed",
    "tool",
    "word",
    "number",
    "key",
    "name",
    "sign",
    "kept",
    "frame",
];

fn kind(name: &str) -> usize {
    KINDS.iter().position(|own| *own == name).unwrap_or_default()
}

/// The kind of a word that begins with a letter.
fn word(dialect: &Dialect, letter: u8) -> usize {
    let letter = letter.to_ascii_uppercase();
    let is = |own: Option<char>| own.is_some_and(|own| own == char::from(letter));
    kind(match letter {
        _ if is(dialect.block.number) => "block-number",
        b'G' => "code-g",
        b'M' => "code-m",
        _ => match dialect.address_row(letter).map(|row| row.role) {
            Some(Role::Axis) => "axis",
            Some(Role::CentreX | Role::CentreY | Role::CentreZ | Role::Radius) => "centre",
            Some(Role::Feed) => "feed",
            Some(Role::Speed) => "speed",
            Some(Role::Tool | Role::ToolEdge | Role::LengthEntry | Role::Corrector | Role::RadiusEntry) => {
                "tool"
            }
            Some(Role::Call | Role::Parameter) | None => "word",
        },
    })
}

/// The stretches of a line that was taken apart: a letter with its sign and number is one.
fn stretches(dialect: &Dialect, line: &[u8], pieces: &[Piece], found: &mut Vec<(usize, usize, usize)>) {
    let mut at = 0;
    while let Some(piece) = pieces.get(at) {
        at += 1;
        let mut end = piece.end;
        let kind = match piece.kind {
            PieceKind::Address => {
                let signed = pieces.get(at).is_some_and(|next| matches!(next.text(line), b"-" | b"+"));
                let number = at + usize::from(signed);
                if let Some(number) = pieces.get(number).filter(|next| next.kind == PieceKind::Number) {
                    end = number.end;
                    at += 1 + usize::from(signed);
                }
                word(dialect, line[piece.start])
            }
            PieceKind::Letter | PieceKind::Name => kind("name"),
            PieceKind::Number => kind("number"),
            PieceKind::Key => kind("key"),
            PieceKind::Sign | PieceKind::Skip | PieceKind::End => kind("sign"),
            PieceKind::Kept => kind("kept"),
            PieceKind::Comment => kind("comment"),
        };
        found.push((piece.start, end, kind));
    }
}

/// Where a byte of a line is, in units of UTF-16; a text that is not UTF-8 has a unit for each byte.
pub(crate) fn column(line: &[u8], byte: usize) -> usize {
    match line.is_ascii() {
        true => byte,
        false => std::str::from_utf8(line)
            .map_or(byte, |text| text.get(..byte).map_or(byte, |before| before.encode_utf16().count())),
    }
}

/// The dialect by which a text is coloured that none is recognised for: words of a letter and a number look alike in all.
pub(crate) fn any() -> Option<&'static Dialect> {
    ncc_dialects::builtins().find(|dialect| dialect.family == Family::Word)
}

/// So many lines lie between two places of a text from which it can be taken apart.
const BETWEEN: usize = 5_000;

/// A text, and places from which it can be taken apart, as far as that was done: an editor asks for a few lines, whose colours
/// go by the lines before them.
#[derive(Debug)]
pub(crate) struct Coloured {
    text: Shared,
    dialect: &'static Dialect,
    /// From the first one on: the byte at which a line begins, and the state there.
    places: Vec<(usize, Lines)>,
}

impl Coloured {
    pub(crate) fn new(text: Shared, dialect: &'static Dialect) -> Coloured {
        Coloured { text, dialect, places: vec![(0, Lines::new(Settings::new(dialect)))] }
    }

    pub(crate) fn is_of(&self, text: &Shared, dialect: &'static Dialect) -> bool {
        self.text.is(text) && std::ptr::eq(self.dialect, dialect)
    }

    /// The document: the kinds, and four numbers for each stretch of the lines from `first` on (counted from 1): line, first
    /// column, the column after it, kind.
    pub(crate) fn document(&mut self, first: usize, lines: usize) -> Value {
        let Coloured { text, dialect, places } = self;
        let nearest = (first.saturating_sub(1) / BETWEEN).min(places.len() - 1);
        let (mut at, mut taken) = places[nearest].clone();
        let (mut pieces, mut found) = (Vec::new(), Vec::new());
        let mut plain = [PlainWord::default(); MOST_PLAIN];
        let mut numbers: Vec<usize> = Vec::new();
        let all = text.as_ref()[at..].split(|byte| *byte == b'\n');
        for (number, whole) in (1 + nearest * BETWEEN..first.saturating_add(lines)).zip(all) {
            if number == 1 + places.len() * BETWEEN {
                places.push((at, taken.clone()));
            }
            at += whole.len() + 1;
            let line = whole.strip_suffix(b"\r").unwrap_or(whole);
            // Of the lines before, the state alone is wanted.
            if number < first && taken.plain(line, &mut plain).is_some() {
                continue;
            }
            let is = taken.line(line, &mut pieces);
            if number < first {
                continue;
            }
            found.clear();
            match is {
                LineIs::Blocks => stretches(dialect, line, &pieces, &mut found),
                LineIs::Frame => found.push((0, line.len(), kind("frame"))),
                LineIs::Outside => found.push((0, line.len(), kind("comment"))),
                LineIs::Unread => {}
            }
            for (start, end, kind) in &found {
                numbers.extend([number, column(line, *start), column(line, *end), *kind]);
            }
        }
        json!({ "dialect": dialect.id, "kinds": KINDS, "stretches": numbers })
    }
}
