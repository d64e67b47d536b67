//! The short way for the usual lines that are no plain moves ([`super::fast_lower`]): a block of one move, from its
//! line straight to its statements.
//!
//! ```text
//! /2 N10 G2 X5. Y5. I5. J0. F200 (SLOT)      →      SET_FEED_RATE(200) & ARC_FEED(…), both skipped by switch 2
//! ```
//!
//! Such a block has at most a skip mark, a block number, one code of G0 to G3, words of axes, of a centre or a radius, a
//! feed, and a comment at its end. [`read`] finds that out by the bytes alone, with the letters of the dialect; the
//! reader then looks whether every fact is settled that the block depends on, and [`push`] makes the statements.
//!
//! As there: it gives what the long way gives, which a test holds it to, and leaves everything else to that.

use ncc_dialects::{Dialect, Quantity, Role};
use ncc_ir::canon::{Axis, Distance, Fact, Plane, Turn};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::{Arc, Centre, CentreFrom, Coord, Move, Op, Point, Stmt, Text, Turns};
use ncc_ir::source::Span;

use super::fast_lower::{WINDOW, last_window, literal, value};
use super::words::Digits;

/// What a byte is where a word may begin. The first ten are the places of [`Line::words`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Kind {
    X,
    Y,
    Z,
    A,
    B,
    C,
    CentreX,
    CentreY,
    CentreZ,
    Radius,
    Feed,
    /// The letter of G codes.
    Code,
    /// The letter of block numbers.
    Number,
    Skip,
    /// Opens a comment that is closed before the line's end.
    Comment,
    /// The rest of the line is a comment.
    Remark,
    Blank,
    Return,
    End,
    /// Left to the long way.
    Other,
}

const WORDS: usize = 10;
const AXIS_KINDS: [Kind; 6] = [Kind::X, Kind::Y, Kind::Z, Kind::A, Kind::B, Kind::C];
const CENTRE_KINDS: [Kind; 3] = [Kind::CentreX, Kind::CentreY, Kind::CentreZ];

/// Bits of the words of axes.
const AXES: u16 = 0x3F;
/// Bits of the words of rotary axes.
const ROTARY: u16 = 0x38;
/// Bits of the words of a centre.
const CENTRE: u16 = 0x1C0;
/// Bit of the word of a radius.
const RADIUS: u16 = 0x200;

/// What of the dictionary tells the words of such a block apart.
#[derive(Clone, Debug)]
pub(crate) struct Letters {
    kinds: [Kind; 256],
    /// Closes a comment.
    close: u8,
    /// Whether an address may have `=` before its number, and `CR=` is the radius.
    equals: bool,
}

impl Letters {
    /// Those of a dialect without skip marks and comments; `centre` and `radius` are letters, 0 for none.
    pub(crate) fn new(dialect: &Dialect, centre: [u8; 3], radius: u8) -> Letters {
        let mut letters = Letters { kinds: [Kind::Other; 256], close: 0, equals: false };
        let row = |letter: u8| dialect.address_row(letter).filter(|row| row.sure);
        for (axis, kind) in Axis::ALL.into_iter().zip(AXIS_KINDS) {
            let quantity = if axis.is_rotary() { Quantity::Angle } else { Quantity::Length };
            if row(axis.letter()).is_some_and(|row| row.role == Role::Axis && row.quantity == quantity) {
                letters.set(axis.letter(), kind);
            }
        }
        for (letter, kind) in centre.into_iter().zip(CENTRE_KINDS).chain([(radius, Kind::Radius)]) {
            if row(letter).is_some() {
                letters.set(letter, kind);
            }
        }
        if let Some(feed) = dialect.letter_for(Role::Feed).filter(|feed| row(*feed as u8).is_some()) {
            letters.set(feed as u8, Kind::Feed);
        }
        letters.set(b'G', Kind::Code);
        letters.set(dialect.block.number.map_or(0, |letter| letter as u8), Kind::Number);
        // Other words of the dialect, which a move may have, and what makes a line none.
        let corners =
            dialect.corner.words().filter(|(_, word)| !word.comma).map(|(_, word)| word.letter as u8);
        let turns = dialect.arc.turns.map(|letter| letter as u8);
        let repeats = dialect.repeat.letters().into_iter().flatten();
        for letter in corners.chain(turns).chain(repeats).chain(dialect.program.number.map(|l| l as u8)) {
            letters.set(letter, Kind::Other);
        }
        letters.put(b' ', Kind::Blank);
        letters.put(b'\t', Kind::Blank);
        letters.put(b'\r', Kind::Return);
        letters.put(b'\n', Kind::End);
        letters
    }

    /// With these signs: one that marks what is under block skip, one that opens a comment and the one that closes it, or 0
    /// where the line's end does, and one after which the rest of the line is a comment; 0 for none.
    pub(crate) fn with_signs(mut self, skip: u8, [open, close, line]: [u8; 3]) -> Letters {
        self.close = close;
        let open_kind = if close == 0 { Kind::Remark } else { Kind::Comment };
        for (sign, kind) in [(skip, Kind::Skip), (line, Kind::Remark), (open, open_kind)] {
            if sign.is_ascii_punctuation() {
                self.put(sign, kind);
            }
        }
        self
    }

    /// With `X=10` and `CR=5`.
    pub(crate) fn with_equals(self) -> Letters {
        Letters { equals: true, ..self }
    }

    fn set(&mut self, letter: u8, kind: Kind) {
        if letter.is_ascii_alphabetic() {
            self.put(letter.to_ascii_uppercase(), kind);
            self.put(letter.to_ascii_lowercase(), kind);
        }
    }

    fn put(&mut self, byte: u8, kind: Kind) {
        self.kinds[usize::from(byte)] = kind;
    }
}

/// A block as its line shows it.
#[derive(Debug)]
pub(crate) struct Line {
    words: [Digits; WORDS],
    /// Which of them there are, a bit each.
    seen: u16,
    /// Which of them have no point, and are not zero.
    bare: u16,
    /// The number of its G code.
    pub(crate) code: Option<u8>,
    number: Option<u32>,
    pub(crate) feed: Option<(Digits, Span)>,
    /// Its skip level as it is written, 0 where none is.
    pub(crate) skip: Option<u8>,
    /// From its first byte to the end of its last word.
    pub(crate) span: Span,
    /// The text of its comment, between its signs, as indices of the text.
    pub(crate) comment: Option<(usize, usize)>,
    /// From its first byte to the end of its comment.
    pub(crate) whole: Span,
}

impl Default for Line {
    fn default() -> Line {
        Line {
            words: [Digits { mantissa: 0, scale: 0, point: false }; WORDS],
            seen: 0,
            bare: 0,
            code: None,
            number: None,
            feed: None,
            skip: None,
            span: Span::default(),
            comment: None,
            whole: Span::default(),
        }
    }
}

impl Line {
    fn clear(&mut self) {
        (self.seen, self.bare, self.code, self.number) = (0, 0, None, None);
        (self.feed, self.skip, self.comment) = (None, None, None);
    }

    /// Its block number.
    pub(crate) fn number(&self) -> Option<u32> {
        self.number
    }

    /// Whether nothing but a skip mark has been met.
    fn begins(&self) -> bool {
        self.seen == 0 && self.code.is_none() && self.feed.is_none() && self.number.is_none()
    }

    /// Whether every number has a point, or is one of lengths or of angles where these need none.
    pub(crate) fn is_understood(&self, [lengths, angles]: [bool; 2]) -> bool {
        (lengths || self.bare & !ROTARY == 0) && (angles || self.bare & ROTARY == 0)
    }

    /// Whether the way of plain moves could take it.
    pub(crate) fn is_plain(&self) -> bool {
        self.seen & !7 == 0 && self.skip.is_none() && self.comment.is_none()
    }

    /// Whether it has words of rotary axes, each with its letter.
    pub(crate) fn rotary(&self) -> impl Iterator<Item = u8> + '_ {
        let named = |axis: &Axis| axis.is_rotary() && self.seen >> (*axis as u16) & 1 == 1;
        Axis::ALL.into_iter().filter(named).map(Axis::letter)
    }

    /// Whether a length has a point and is not zero.
    pub(crate) fn has_point(&self) -> bool {
        let pointed = |place: usize| {
            (self.seen & !ROTARY) >> place & 1 == 1
                && self.words[place].point
                && self.words[place].mantissa != 0
        };
        (0..WORDS).any(pointed)
    }

    /// The number of X, Y or Z in a unit.
    #[inline]
    pub(crate) fn length(&self, place: usize, unit: Unit) -> Option<Num> {
        (self.seen >> place & 1 == 1).then(|| literal(self.words[place], unit))
    }

    /// Whether it has nothing but words of axes, one at least.
    pub(crate) fn is_straight(&self) -> bool {
        self.seen & AXES != 0 && self.seen & !AXES == 0
    }

    /// Whether it has nothing but words of a plane's axes, one at least: a position, where a cycle is active.
    pub(crate) fn is_position(&self, plane: Plane) -> bool {
        let (first, second, _) = plane.axes();
        let in_plane = 1u16 << first as u16 | 1 << second as u16;
        let alone = self.code.is_none() && self.feed.is_none() && self.skip.is_none();
        alone && self.seen & in_plane != 0 && self.seen & !in_plane == 0
    }

    /// Whether it has the words of an arc in a plane, with an end in it and either a centre in it or a radius.
    pub(crate) fn is_arc(&self, plane: Plane) -> bool {
        let (first, second, normal) = plane.axes();
        let in_plane = 1u16 << first as u16 | 1 << second as u16;
        let outside = (self.centre() >> normal as u16) & 1 == 1;
        self.seen & in_plane != 0 && !outside && (self.centre() != 0) != self.has_radius()
    }

    /// Whether it has the word of a radius.
    pub(crate) fn has_radius(&self) -> bool {
        self.seen & RADIUS != 0
    }

    /// Whether that is zero.
    pub(crate) fn is_radius_zero(&self) -> bool {
        self.words[Kind::Radius as usize].mantissa == 0
    }

    /// Whether it has both words of a centre.
    pub(crate) fn has_whole_centre(&self) -> bool {
        self.centre().count_ones() == 2
    }

    /// Whether it has a word of an axis.
    pub(crate) fn moves(&self, axis: Axis) -> bool {
        self.seen >> axis as u16 & 1 == 1
    }

    /// The words of a centre, a bit each.
    fn centre(&self) -> u16 {
        (self.seen & CENTRE) >> Kind::CentreX as u16
    }

    fn to_expr(&self, place: usize, unit: Unit) -> Option<Expr> {
        (self.seen >> place & 1 == 1).then(|| Expr::Num(literal(self.words[place], unit)))
    }
}

/// Reads the line that begins at `from` of `text`, if it is such a block; gives the index of its `\n`, or the end of
/// the text.
pub(crate) fn read(letters: &Letters, text: &[u8], from: usize, base: u32, line: &mut Line) -> Option<usize> {
    line.clear();
    let mut first = None;
    let (mut at, mut last) = (from, from);
    let end = loop {
        let beyond;
        let here = match text.get(at..).and_then(<[u8]>::first_chunk::<WINDOW>) {
            Some(here) => here,
            None => {
                beyond = last_window(text, at);
                &beyond
            }
        };
        let kind = letters.kinds[usize::from(here[0])];
        let (len, after) = match kind {
            Kind::Blank => {
                at += 1;
                continue;
            }
            Kind::End => break at,
            Kind::Return if here[1] == b'\n' => break at + 1,
            Kind::Feed | Kind::Code | Kind::Number => {
                let (digits, len, after) = value(here, text, at).filter(|_| here[1].is_ascii_digit())?;
                let span = Span::new(base + at as u32, base + (at + len) as u32);
                unsigned(kind, digits, span, line)?;
                (len, after)
            }
            Kind::Skip if line.begins() && line.skip.is_none() => {
                let digit = here[1].is_ascii_digit();
                line.skip = Some(if digit { here[1] - b'0' } else { 0 });
                if digit && here[1] == b'0' {
                    return None;
                }
                first.get_or_insert(at);
                at += 1 + usize::from(digit);
                continue;
            }
            Kind::Comment | Kind::Remark => {
                let (end, after) = comment(letters, kind, text, at, line)?;
                line.whole.end = base + after as u32;
                break end;
            }
            Kind::Other | Kind::Return | Kind::Skip => return None,
            _ => {
                let (kind, before) = if letters.equals { equals(kind, here) } else { (kind, 0) };
                let (digits, len, after) = match before {
                    0 => value(here, text, at)?,
                    _ => value_behind(text, at + before)?,
                };
                put(kind, digits, line)?;
                (before + len, after)
            }
        };
        first.get_or_insert(at);
        last = at + len;
        // Without a branch: whether a blank or the line's end follows is hard to guess.
        at = last + usize::from(after == b' ');
    };
    line.span = Span::new(base + first? as u32, base + last as u32);
    let whole = if line.comment.is_some() { line.whole.end } else { line.span.end };
    line.whole = Span::new(line.span.start, whole);
    Some(end)
}

/// What a word is that may have `=` before its number, and how many bytes stand before that sign.
#[inline(always)]
fn equals(kind: Kind, here: &[u8; WINDOW]) -> (Kind, usize) {
    match (here[1], here[2]) {
        (b'=', _) => (kind, 1),
        (b'R' | b'r', b'=') if kind == Kind::C => (Kind::Radius, 2),
        _ => (kind, 0),
    }
}

/// The number after the sign at `at`, the length of both, and the byte after it.
fn value_behind(text: &[u8], at: usize) -> Option<(Digits, usize, u8)> {
    match text.get(at..).and_then(<[u8]>::first_chunk::<WINDOW>) {
        Some(here) => value(here, text, at),
        None => value(&last_window(text, at), text, at),
    }
}

/// The comment at `at`, which ends the line: gives where the line's end is, and where the comment's.
fn comment(letters: &Letters, kind: Kind, text: &[u8], at: usize, line: &mut Line) -> Option<(usize, usize)> {
    let start = at + 1;
    let rest = text.get(start..)?;
    let end = start + memchr::memchr(b'\n', rest).unwrap_or(rest.len());
    let mut inner = text.get(start..end)?;
    while let [before @ .., b'\r'] = inner {
        inner = before;
    }
    let (inner, after) = if kind == Kind::Comment {
        let close = memchr::memchr(letters.close, inner)?;
        let (inner, behind) = inner.split_at(close);
        if behind.get(1..)?.iter().any(|byte| !matches!(byte, b' ' | b'\t')) {
            return None;
        }
        (inner, start + close + 1)
    } else {
        (inner, start + inner.trim_ascii_end().len())
    };
    // Elsewhere than at a line's end it is another sign.
    if memchr::memchr(b'\r', inner).is_some() {
        return None;
    }
    line.comment = Some((start, start + inner.len()));
    Some((end, after))
}

/// A word of an axis, a centre or a radius.
#[inline(always)]
fn put(kind: Kind, digits: Digits, line: &mut Line) -> Option<()> {
    let bit = 1u16 << kind as u8;
    if line.seen & bit != 0 || !is_in_range(digits) {
        return None;
    }
    line.seen |= bit;
    if !digits.point && digits.mantissa != 0 {
        line.bare |= bit;
    }
    *line.words.get_mut(kind as usize)? = digits;
    Some(())
}

/// A feed, a code or a block number: their numbers begin with a digit.
fn unsigned(kind: Kind, digits: Digits, span: Span, line: &mut Line) -> Option<()> {
    match kind {
        Kind::Feed if line.feed.is_none() && is_in_range(digits) => line.feed = Some((digits, span)),
        Kind::Code if line.code.is_none() && !digits.point && digits.mantissa <= 3 => {
            line.code = Some(digits.mantissa as u8);
        }
        Kind::Number if line.begins() && !digits.point => {
            line.number = Some(u32::try_from(digits.mantissa).ok()?);
        }
        _ => return None,
    }
    Some(())
}

#[inline(always)]
fn is_in_range(digits: Digits) -> bool {
    digits.scale <= 8 && digits.mantissa.unsigned_abs() < 10_000_000
}

/// What the block's move is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Path {
    Traverse,
    Feed,
    /// Whatever is active when the program runs.
    Position,
    /// To a hole of the active cycle.
    Hole,
    Arc {
        plane: Plane,
        turn: Turn,
        /// From where words of its centre are measured.
        from: CentreFrom,
    },
}

/// What is known of the block besides its words.
#[derive(Debug)]
pub(crate) struct Known {
    pub(crate) path: Path,
    pub(crate) unit: Unit,
    pub(crate) distance: Fact<Distance>,
    /// What its feed counts.
    pub(crate) feed: Unit,
    pub(crate) span: Span,
    /// The skip level of its statements.
    pub(crate) skip: Option<u8>,
    pub(crate) comment: Option<Box<Text>>,
}

/// Makes the block's statements.
pub(crate) fn push(line: &Line, known: Known, stmts: &mut Vec<Stmt>) {
    let Known { path, unit, distance, feed, span, skip, comment } = known;
    let mut number = line.number;
    let joined = line.feed.is_some();
    if let Some((digits, span)) = line.feed {
        let op = Op::SetFeedRate(Expr::Num(literal(digits, feed)));
        stmts.push(Stmt { span, number: number.take(), skip, joined: false, comment: None, op });
    }
    let said = line.code.is_some();
    // A statement is large: it goes to its place empty, and is filled there.
    let empty = || Move { said, ..Move::default() };
    let stmt = |op: Op| Stmt { span, number, skip, joined, comment, op };
    match path {
        Path::Traverse => stmts.push(stmt(Op::StraightTraverse(empty()))),
        Path::Feed => stmts.push(stmt(Op::StraightFeed(empty()))),
        Path::Position => stmts.push(stmt(Op::Position(empty()))),
        Path::Hole => stmts.push(stmt(Op::Hole(empty()))),
        Path::Arc { plane, turn, from } => {
            let centre = match line.to_expr(Kind::Radius as usize, unit) {
                Some(radius) => Centre::Radius(radius),
                None => Centre::Point { words: CENTRE_KINDS.map(|k| line.to_expr(k as usize, unit)), from },
            };
            let (plane, to, turns) = (Fact::Known(plane), Point::default(), Turns::NONE);
            stmts.push(stmt(Op::ArcFeed(Box::new(Arc { plane, turn, to, centre, turns, said }))));
        }
    }
    match stmts.last_mut().map(|stmt| &mut stmt.op) {
        Some(Op::StraightTraverse(to) | Op::StraightFeed(to) | Op::Position(to) | Op::Hole(to)) => {
            fill(line, unit, distance, &mut to.to);
        }
        Some(Op::ArcFeed(arc)) => fill(line, unit, distance, &mut arc.to),
        _ => {}
    }
}

fn fill(line: &Line, unit: Unit, distance: Fact<Distance>, to: &mut Point) {
    let mut left = line.seen & AXES;
    while left != 0 {
        let place = left.trailing_zeros() as usize;
        left &= left - 1;
        let unit = if ROTARY >> place & 1 == 1 { Unit::Degree } else { unit };
        let value = Expr::Num(literal(line.words[place], unit));
        to.axes[place] = Some(Coord { value, distance });
    }
}
