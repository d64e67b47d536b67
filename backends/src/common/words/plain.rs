//! Blocks that are nothing but a straight move, with or without a feed: nearly all of a large
//! program. Written straight from the statement; anything unusual is left untouched to the general
//! way, which writes the same text.

use ncc_ir::canon::{AXES, Distance, Fact, Motion, Units};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::line_table::{AXES_OF_ROW, Row, StatedFeed};
use ncc_ir::program::{Arc, Coord, Op, Point, Stmt};
use ncc_ir::source::Span;

use super::{HIGHEST_NUMBER, Words};
use crate::Numbering;
use crate::common::Sink;
use crate::common::codes::Code;
use crate::common::number;
use crate::common::number::{LONGEST, ROOM, Shaped};

/// Room for lines that have not been passed on.
pub(crate) const PAGE: usize = 4096;

/// Room for a line: number, motion code, six axes, feed, line end, and what the last word touches.
const LINE: usize = 10 + 9 + 7 * (LONGEST + 2) + 2 + ROOM + 17;

/// A word after those of the axes: its name, with all that stands before its number, and that. There are three at most,
/// beside three axes.
#[derive(Clone, Copy)]
pub(crate) struct Behind<'n> {
    pub(crate) name: &'n str,
    pub(crate) value: Shaped,
}

impl Behind<'_> {
    /// The place of a word that is not there.
    pub(crate) const NONE: Behind<'static> =
        Behind { name: "", value: Shaped { mantissa: 0, scale: 0, point: false, rounded: false } };
}

impl Words {
    /// Writes a plain block, or returns `false` without having written or changed anything.
    #[inline]
    pub(crate) fn plain_block(&mut self, stmts: &[Stmt], sink: &mut Sink) -> bool {
        match stmts {
            [Stmt { comment: Some(comment), .. }] | [_, Stmt { comment: Some(comment), .. }] => {
                self.commented(stmts, comment, sink)
            }
            _ => self.plain_words(stmts, sink.out),
        }
    }

    /// The same of a block with a comment after its words.
    fn commented(&mut self, stmts: &[Stmt], comment: &str, sink: &mut Sink) -> bool {
        self.pass_on(sink.out);
        if !self.plain_words(stmts, sink.out) {
            return false;
        }
        let (words, eol) = (self.filled - self.eol.len(), self.eol);
        sink.out.extend_from_slice(&self.page[..words]);
        self.filled = 0;
        let start = sink.out.len() - words;
        if self.dialect.block.blanks {
            sink.out.push(b' ');
        }
        let mut after = std::mem::take(&mut self.block.after);
        let changed = self.comments.write(comment, sink.out, &mut after, eol);
        let length = sink.out.len() - start;
        sink.out.extend_from_slice(eol);
        sink.out.append(&mut after);
        self.block.after = after;
        let at = stmts.last().map_or(Span::default(), |stmt| stmt.span);
        if changed {
            sink.report(Fault::CommentReformatted, at);
        }
        self.check_length(length, at, sink);
        true
    }

    /// The words of a block, whatever its comment.
    #[inline]
    fn plain_words(&mut self, stmts: &[Stmt], out: &mut Vec<u8>) -> bool {
        let (stmt, feed) = match stmts {
            [stmt] => (stmt, None),
            [Stmt { op: Op::SetFeedRate(feed), skip: None, comment: None, .. }, stmt] => (stmt, Some(feed)),
            _ => return false,
        };
        let (to, motion, code) = if let Op::StraightFeed(to) = &stmt.op {
            (to, Motion::Feed, self.codes.feed)
        } else if let Op::StraightTraverse(to) = &stmt.op {
            (to, Motion::Traverse, self.codes.traverse)
        } else {
            return false;
        };
        let feed = match feed {
            None => None,
            Some(Expr::Num(num)) => Some(*num),
            Some(_) => return false,
        };
        if stmt.skip.is_some() {
            return false;
        }
        let Some(distance) = self.active.distance else { return false };
        let axes = &to.to.axes;
        let word = |axis: usize| match &axes[axis] {
            None => Some(None),
            Some(Coord { value: Expr::Num(num), distance: own }) if *own == Fact::Known(distance) => {
                Some(Some(*num))
            }
            Some(_) => None,
        };
        let number = stmts[0].number;
        let done = self.plain_move::<AXES>((number, to.said), (motion, code), word, (&[], feed), out);
        if done {
            self.numbers.seen(number, stmts[0].span);
        }
        done
    }

    /// Writes a block that is nothing but words of X, Y and Z at which the active motion goes rapidly; or returns `false`
    /// without having written or changed anything.
    pub(crate) fn plain_point(&mut self, stmt: &Stmt, to: &Point, out: &mut Vec<u8>) -> bool {
        let code = (Motion::Traverse, self.codes.traverse);
        self.active.motion == Some(Motion::Traverse) && self.plain_to(stmt, (to, false), code, &[], out)
    }

    /// Writes a block that is nothing but an arc to a point of words from zero, with these words of its centre or radius;
    /// or returns `false` without having written or changed anything.
    ///
    /// No end of it is rounded: it is no line, and no full circle (`arc`).
    pub(crate) fn plain_arc(&mut self, stmt: &Stmt, arc: &Arc, centre: &[Behind], out: &mut Vec<u8>) -> bool {
        let code = self.codes.arcs[arc.turn as usize].filter(|code| code.unsure.is_none());
        let plain = self.active.distance == Some(Distance::Absolute)
            && self.active.plane.is_some()
            && arc.plane.known() == self.active.plane
            && arc.turns.is_none()
            && !self.tracker.cycle_in_doubt;
        plain && self.plain_to(stmt, (&arc.to, arc.said), (Motion::Arc(arc.turn), code), centre, out)
    }

    /// A move to a point of X, Y and Z, in a block of its own.
    fn plain_to(
        &mut self,
        stmt: &Stmt,
        (to, said): (&Point, bool),
        code: (Motion, Option<Code>),
        behind: &[Behind],
        out: &mut Vec<u8>,
    ) -> bool {
        let Some(distance) = self.active.distance else { return false };
        let (axes, rotary) = to.axes.split_at(AXES_OF_ROW);
        if stmt.skip.is_some() || stmt.comment.is_some() || rotary.iter().any(Option::is_some) {
            return false;
        }
        let word = |axis: usize| match &axes[axis] {
            None => Some(None),
            Some(Coord { value: Expr::Num(num), distance: own }) if *own == Fact::Known(distance) => {
                Some(Some(*num))
            }
            Some(_) => None,
        };
        let done = self.plain_move::<AXES_OF_ROW>((stmt.number, said), code, word, (behind, None), out);
        if done {
            self.numbers.seen(stmt.number, stmt.span);
        }
        done
    }

    /// Writes a line of a table, with the feed that it states, or returns `false` without having written or changed
    /// anything.
    #[inline]
    pub(crate) fn plain_row(
        &mut self,
        row: &Row,
        unit: Unit,
        feed: Option<&StatedFeed>,
        out: &mut Vec<u8>,
    ) -> bool {
        let motion = row.motion();
        let code = if motion == Motion::Feed { self.codes.feed } else { self.codes.traverse };
        if self.active.distance != Some(Distance::Absolute) {
            return false;
        }
        let first = feed.map_or_else(|| row.span(), |(_, span)| *span);
        let (number, feed) = (row.number(), feed.map(|(feed, _)| *feed));
        let word = |axis: usize| Some(row.word(axis, unit));
        let says = (number, row.says_motion());
        let done = self.plain_move::<AXES_OF_ROW>(says, (motion, code), word, (&[], feed), out);
        if done {
            self.numbers.seen(number, first);
        }
        done
    }

    /// Writes a line by the words of its first axes; `word` gives that of an axis, or `None` where it is not plain.
    #[inline]
    fn plain_move<const MOST: usize>(
        &mut self,
        (number, said): (Option<u32>, bool),
        (motion, code): (Motion, Option<Code>),
        word: impl Fn(usize) -> Option<Option<Num>>,
        (behind, feed): (&[Behind], Option<Num>),
        out: &mut Vec<u8>,
    ) -> bool {
        let Some(code) = code else { return false };
        if self.preamble.is_some()
            || self.residual
            || self.corner.is_some()
            || self.surfaces.unsaid.is_some()
            || self.numbers.waiting.is_some()
        {
            return false;
        }
        let blanks = usize::from(self.dialect.block.blanks);
        let (Some(distance), Some(units)) = (self.active.distance, self.active.units) else {
            return false;
        };
        let unit = match units {
            Units::Mm => Unit::Mm,
            Units::Inch => Unit::Inch,
        };
        if self.filled > PAGE - LINE {
            self.pass_on(out);
        }
        let Some((mut at, next)) = self.number_of_line(number) else { return false };
        let line = &mut self.page;
        let start = at;
        let mut named = 0u8;
        if said || self.active.motion != Some(motion) {
            let (text, len) = code.padded();
            line[at..at + 8].copy_from_slice(text);
            at += len;
            line[at] = b' ';
            at += blanks;
        }
        for axis in 0..MOST {
            let Some(word) = word(axis) else { return false };
            let Some(n) = word else { continue };
            let Some(letter) = &self.codes.axes[axis] else { return false };
            if !(n.unit == unit || (axis > 2 && n.unit == Unit::Degree)) {
                return false;
            }
            let Some(shaped) = number::plain(n, &letter.format) else { return false };
            line[at] = letter.letter;
            at = number::write(line, at + 1, shaped);
            line[at] = b' ';
            at += blanks;
            self.last_words[axis] = n;
            named |= 1 << axis;
        }
        if at == start {
            return false;
        }
        for Behind { name, value } in behind {
            line[at..at + name.len()].copy_from_slice(name.as_bytes());
            at = number::write(line, at + name.len(), *value);
            line[at] = b' ';
            at += blanks;
        }
        if let Some(n) = feed {
            let Some(letter) = &self.codes.feed_word else { return false };
            let Some(shaped) = number::plain(n, &letter.format) else { return false };
            if n.unit != unit {
                return false;
            }
            line[at] = letter.letter;
            at = number::write(line, at + 1, shaped);
            line[at] = b' ';
            at += blanks;
            self.active.feed = Some(n);
        }
        at -= blanks;
        // One byte too many of a short line end is overwritten, or never taken.
        line[at..at + 2].copy_from_slice(&if self.eol.len() == 2 { *b"\r\n" } else { *b"\n\n" });
        at += self.eol.len();
        self.filled = at;
        self.numbers.next = next;
        self.named |= named;
        if distance == Distance::Incremental {
            self.settle();
        }
        if self.active.motion != Some(motion) {
            self.active.motion = Some(motion);
            self.tracker.modes.motion = Some(motion);
            self.tracker.cycle = None;
        }
        true
    }

    /// Writes the number of a block with which its line begins; gives where it ends, and the number that comes next.
    #[inline]
    fn number_of_line(&mut self, number: Option<u32>) -> Option<(usize, u32)> {
        let (line, mut at) = (&mut self.page, self.filled);
        let blanks = usize::from(self.dialect.block.blanks);
        let mut next = self.numbers.next;
        match (self.numbers.numbering, self.dialect.block.number, number) {
            (Numbering::Off, _, _) => {}
            (Numbering::Keep, Some(letter), Some(number)) if number < 100_000_000 => {
                line[at] = letter as u8;
                at = number::write_digits(line, at + 1, number);
                line[at] = b' ';
                at += blanks;
            }
            (Numbering::Keep, _, None) => {}
            (Numbering::Every { first, step }, Some(letter), _) if next < 100_000_000 => {
                line[at] = letter as u8;
                at = number::write_digits(line, at + 1, next);
                line[at] = b' ';
                at += blanks;
                next = next.saturating_add(step);
                if next > HIGHEST_NUMBER {
                    next = first;
                }
            }
            _ => return None,
        }
        Some((at, next))
    }

    /// Passes plain lines on, before anything else is written.
    pub(crate) fn pass_on(&mut self, out: &mut Vec<u8>) {
        out.extend_from_slice(&self.page[..self.filled]);
        self.filled = 0;
    }

    /// Brings the tracker up to the last plain moves, which leave only their words.
    pub(crate) fn settle(&mut self) {
        let distance = self.active.distance;
        let named = std::mem::take(&mut self.named);
        for (axis, n) in self.last_words.iter().enumerate() {
            if named >> axis & 1 == 1 {
                let position = &mut self.tracker.position[axis];
                *position = match (distance, n.nanos(false)) {
                    (Some(Distance::Absolute), value) => value,
                    (Some(Distance::Incremental), Some(by)) => position.and_then(|p| p.checked_add(by)),
                    (Some(Distance::Incremental) | None, _) => None,
                };
            }
        }
    }
}
