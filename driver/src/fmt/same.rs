//! Checks a laid-out line: compares its pieces with those of the line before `layout` changed it.
//!
//! ```text
//! G01 X+05.0    equal to    g1 x5.0        L010    not equal to    L10
//! ```
//!
//! Numbers are compared digit by digit. `layout` may drop a plus between an address and its number, and leading
//! zeros. The check does not use the rules of `layout`, so it also finds faults in them.
//! Not here: the meaning of words. `number` checks new block numbers against the jumps.

use ncc_frontends::pieces::{LineIs, Piece, PieceKind as Kind};

/// A line with its pieces, in the order of the text.
#[derive(Clone, Copy)]
pub struct Taken<'l> {
    pub(crate) is: LineIs,
    pub(crate) line: &'l [u8],
    pub(crate) pieces: &'l [Piece],
}

/// Whether two lines differ at most in layout. Lines that hold no blocks are compared byte for byte.
pub fn same(a: Taken, b: Taken) -> bool {
    if a.is != b.is {
        return false;
    }
    if a.is != LineIs::Blocks {
        return a.line == b.line;
    }
    let (mut a, mut b) = (Said { taken: a, at: 0 }, Said { taken: b, at: 0 });
    loop {
        match (a.next(), b.next()) {
            (None, None) => return true,
            (Some(x), Some(y)) if x == y => {}
            (Some(_) | None, Some(_) | None) => return false,
        }
    }
}

/// A piece in the form in which it is compared.
#[derive(Debug, PartialEq)]
enum Says<'l> {
    /// Compared without case. The number is the depth of the piece.
    Word(Kind, u32, Capitals<'l>),
    /// Compared byte for byte.
    Text(Kind, &'l [u8]),
    /// Digits without leading zeros, then the point with the digits after it.
    Number(&'l [u8], Option<&'l [u8]>),
}

#[derive(Debug)]
struct Capitals<'l>(&'l [u8]);

impl PartialEq for Capitals<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.0.eq_ignore_ascii_case(other.0)
    }
}

struct Said<'l> {
    taken: Taken<'l>,
    at: usize,
}

impl<'l> Said<'l> {
    fn next(&mut self) -> Option<Says<'l>> {
        let Taken { line, pieces, .. } = self.taken;
        let piece = pieces.get(self.at)?;
        let text = piece.text(line);
        if text == b"+" && self.at > 0 {
            let before = pieces.get(self.at - 1).map(|p| p.kind);
            let after = pieces.get(self.at + 1).map(|p| p.kind);
            if (before, after) == (Some(Kind::Address), Some(Kind::Number)) {
                self.at += 1;
                return self.next();
            }
        }
        let named = self.at.checked_sub(1).and_then(|at| pieces.get(at)).is_some_and(|before| {
            before.kind == Kind::Address
                && matches!(
                    before.text(line).first(),
                    Some(b'N' | b'O' | b'P' | b'Q' | b'L' | b'n' | b'o' | b'p' | b'q' | b'l')
                )
        });
        self.at += 1;
        Some(match piece.kind {
            // The digits are a name: `L010` is not `L10`.
            Kind::Number if named && !text.contains(&b'.') => Says::Text(piece.kind, text),
            Kind::Number if text.iter().all(|b| b.is_ascii_digit() || *b == b'.') => {
                let point = text.iter().position(|b| *b == b'.');
                let whole = &text[..point.unwrap_or(text.len())];
                let zeros = whole.iter().take_while(|b| **b == b'0').count();
                Says::Number(&whole[zeros..], point.map(|at| &text[at..]))
            }
            Kind::Kept | Kind::Comment => Says::Text(piece.kind, text),
            Kind::Number
            | Kind::Address
            | Kind::Letter
            | Kind::Key
            | Kind::Name
            | Kind::Sign
            | Kind::Skip
            | Kind::End => Says::Word(piece.kind, piece.depth, Capitals(text)),
        })
    }
}
