//! Blocks that are nothing but a straight move, with or without a feed: nearly all of a large
//! program. Written straight from the statement; anything unusual is left untouched to the general
//! way, which writes the same text.

use ncc_ir::canon::{AXES, Distance, Fact, Motion, Units};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::line_table::{AXES_OF_ROW, Row, StatedFeed};
use ncc_ir::program::{Coord, Op, Stmt};

use super::{HIGHEST_NUMBER, Words};
use crate::Numbering;
use crate::common::codes::Code;
use crate::common::number;
use crate::common::number::{LONGEST, ROOM};

/// Room for lines that have not been passed on.
pub(crate) const PAGE: usize = 4096;

/// Room for a line: number, motion code, six axes, feed, line end, and what the last word touches.
const LINE: usize = 10 + 9 + 7 * (LONGEST + 2) + 2 + ROOM + 17;

impl Words {
    /// Writes a plain block, or returns `false` without having written or changed anything.
    #[inline]
    pub(crate) fn plain_block(&mut self, stmts: &[Stmt], out: &mut Vec<u8>) -> bool {
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
        if stmt.skip.is_some() || stmt.comment.is_some() {
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
        let done = self.plain_move::<AXES>((number, to.said), (motion, code), word, feed, out);
        if done {
            self.numbers.seen(number, stmts[0].span);
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
        let done =
            self.plain_move::<AXES_OF_ROW>((number, row.says_motion()), (motion, code), word, feed, out);
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
        feed: Option<Num>,
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
        let mut next = self.numbers.next;
        if self.filled > PAGE - LINE {
            self.pass_on(out);
        }
        let line = &mut self.page;
        let mut at = self.filled;
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
            _ => return false,
        }
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

    /// Passes plain lines on, before anything else is written.
    pub(crate) fn pass_on(&mut self, out: &mut Vec<u8>) {
        out.extend_from_slice(&self.page[..self.filled]);
        self.filled = 0;
    }

    /// Brings the tracker up to the last plain moves, which leave only their words behind.
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
