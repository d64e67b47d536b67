//! How a line looks: blanks, capitals, the form of codes and numbers.
//!
//! Pieces stay in their order, and so do the digits that say how exact a number is. Where a number is part
//! of an expression it is kept as written: what is taken away there could be an operator. Not here: taking
//! lines apart (`ncc_frontends::pieces`), block numbers (`number`), and whether it all still says the same
//! (`same`).

use ncc_dialects::{Dialect, Family};
use ncc_frontends::pieces::{Piece, PieceKind as Kind, PlainWord};

/// Letters whose whole numbers name a program or a block. Zeros in front belong to such a name.
const NAMES: &[u8] = b"NOPQL";

/// Appends a line that was taken apart to `to`, without its end.
pub fn line(dialect: &Dialect, line: &[u8], pieces: &[Piece], to: &mut Vec<u8>) {
    let Some(first) = pieces.first() else { return };
    // Structures are shown by their indentation, in languages that have them.
    if dialect.program.macros {
        to.extend_from_slice(&line[..first.start]);
    }
    let start = to.len();
    for (at, piece) in pieces.iter().enumerate() {
        if at > 0 && parted(dialect, line, pieces, at) {
            to.push(b' ');
        }
        let text = piece.text(line);
        match piece.kind {
            Kind::Kept | Kind::Comment | Kind::End | Kind::Skip => to.extend_from_slice(text),
            Kind::Sign if is_needless_plus(pieces, line, at) => {}
            Kind::Number => number(dialect, line, pieces, at, to),
            Kind::Address | Kind::Letter | Kind::Key | Kind::Name | Kind::Sign => {
                to.extend(text.iter().map(u8::to_ascii_uppercase));
            }
        }
    }
    debug_assert!(to.len() >= start);
}

/// Whether a line of such words looks as [`line()`] would write it: most lines do.
pub fn is_laid_out(dialect: &Dialect, line: &[u8], words: &[PlainWord]) -> bool {
    let stays = |word: &PlainWord| {
        let text = line.get(word.start..word.end).unwrap_or_default();
        let zeros = matches!(text, [b'0', b'0'..=b'9', ..]);
        let is_code = !word.negative && matches!(word.letter, b'G' | b'M');
        !zeros && (!is_code || code(dialect, word.letter, text).is_none_or(|code| code == text))
    };
    dialect.block.blanks && words.iter().all(stays)
}

/// Whether a blank stands before a piece.
fn parted(dialect: &Dialect, line: &[u8], pieces: &[Piece], at: usize) -> bool {
    let blanks = dialect.block.blanks;
    let (before, piece) = (&pieces[at - 1], &pieces[at]);
    let written = before.end < piece.start;
    let signed = at > 1 && before.kind == Kind::Sign && is_sign(before.text(line));
    match (before.kind, piece.kind) {
        (_, Kind::End) => false,
        (Kind::End, _) => written && blanks,
        (Kind::Comment, _) | (_, Kind::Comment) => blanks,
        // A word is in one piece: its letter, a sign, and its number, variable or expression.
        (Kind::Address, Kind::Number) => false,
        (Kind::Address, Kind::Sign) => written && !(is_sign(piece.text(line)) || opens(piece.text(line))),
        (Kind::Sign, Kind::Number | Kind::Sign) if signed && pieces[at - 2].kind == Kind::Address => {
            written && piece.kind == Kind::Sign && !opens(piece.text(line))
        }
        (Kind::Skip, Kind::Number) if dialect.family == Family::Word => false,
        (Kind::Skip, Kind::Address) => blanks && before.end - before.start > 1,
        (Kind::Number, Kind::Address | Kind::Skip) if piece.depth == 0 => blanks,
        (Kind::Number, Kind::Name) if piece.depth == 0 => blanks || written,
        (Kind::Number, _) if at == 2 + numbered_from(pieces) && is_number_of_block(line, pieces, at) => {
            blanks || written
        }
        (Kind::Sign, Kind::Address | Kind::Name) if piece.depth == 0 && closes(before.text(line)) => {
            blanks || written
        }
        (Kind::Name, Kind::Address) => true,
        // Letters without numbers: where there are words of several letters, a blank may part them.
        (Kind::Address, Kind::Address) => match dialect.program.macros {
            true => written,
            false => blanks,
        },
        _ => written,
    }
}

/// Index of the piece at which a block number would stand: behind a skip mark.
fn numbered_from(pieces: &[Piece]) -> usize {
    match pieces {
        [Piece { kind: Kind::Skip, .. }, Piece { kind: Kind::Number, .. }, ..] => 2,
        [Piece { kind: Kind::Skip, .. }, ..] => 1,
        _ => 0,
    }
}

/// Whether the number before a piece is that of the block.
fn is_number_of_block(line: &[u8], pieces: &[Piece], at: usize) -> bool {
    at >= 2 && pieces[at - 2].kind == Kind::Address && pieces[at - 2].text(line).eq_ignore_ascii_case(b"N")
}

fn is_sign(text: &[u8]) -> bool {
    matches!(text, b"+" | b"-")
}

fn opens(text: &[u8]) -> bool {
    matches!(text, b"#" | b"[")
}

fn closes(text: &[u8]) -> bool {
    matches!(text, b")" | b"]")
}

/// A plus between the letter of a word and its number.
fn is_needless_plus(pieces: &[Piece], line: &[u8], at: usize) -> bool {
    at > 0
        && pieces[at].text(line) == b"+"
        && pieces[at - 1].kind == Kind::Address
        && pieces.get(at + 1).is_some_and(|next| next.kind == Kind::Number)
}

/// Writes a number: that of a word without zeros in front, that of a code as its dictionary has it.
fn number(dialect: &Dialect, line: &[u8], pieces: &[Piece], at: usize, to: &mut Vec<u8>) {
    let text = pieces[at].text(line);
    let before = at.checked_sub(1).map(|at| &pieces[at]);
    let signed = before.is_some_and(|b| b.kind == Kind::Sign && is_sign(b.text(line)));
    let address = at.checked_sub(1 + usize::from(signed)).map(|at| &pieces[at]);
    let letter = address.filter(|a| a.kind == Kind::Address).map(|a| a.text(line)[0].to_ascii_uppercase());
    // `X01=10`: the number belongs to the address's name.
    let extends = pieces.get(at + 1).is_some_and(|next| next.text(line) == b"=");
    let Some(letter) = letter.filter(|_| !extends) else {
        return to.extend(text.iter().map(u8::to_ascii_uppercase));
    };
    if !signed && let Some(code) = code(dialect, letter, text) {
        return to.extend_from_slice(code);
    }
    let whole = text.iter().take_while(|b| b.is_ascii_digit()).count();
    if NAMES.contains(&letter) && whole == text.len() {
        return to.extend_from_slice(text);
    }
    // One digit before the point stays.
    let zeros = text[..whole].iter().take_while(|b| **b == b'0').count().min(whole.saturating_sub(1));
    to.extend(text[zeros..].iter().map(u8::to_ascii_uppercase));
}

/// The digits of a code in its dictionary, if they say the same number.
fn code<'d>(dialect: &'d Dialect, letter: u8, text: &[u8]) -> Option<&'d [u8]> {
    if !matches!(letter, b'G' | b'M') || text.len() > 6 {
        return None;
    }
    let digits = std::str::from_utf8(text).ok()?;
    let (whole, tenth) = digits.split_once('.').unwrap_or((digits, "0"));
    if tenth.len() != 1 {
        return None;
    }
    let tenths = whole.parse::<u32>().ok()? * 10 + tenth.parse::<u32>().ok()?;
    let row = dialect.code_row(letter, tenths)?;
    let written = row.code.strip_prefix(letter as char)?;
    (zeroless(written) == zeroless(digits)).then_some(written.as_bytes())
}

fn zeroless(digits: &str) -> &str {
    digits.trim_start_matches('0')
}
