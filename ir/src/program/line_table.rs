//! Lines of a piece of a program in a table: a row of 24 bytes instead of one or two statements of 184.
//!
//! ```text
//! N80 X0.396 Z-0.147 F1800    a row with the mantissas 396, 0, -147, and a feed in the list beside it
//! ```
//!
//! Nearly all of a long program is such lines. A reader fills a table, a writer and the verification go through it row by
//! row. Nobody else does: passes get statements that stand for it ([`LineTable::stand_in`]). Whatever cannot be done with a
//! table is done with its statements ([`LineTable::unpack`]).
//!
//! Not here: long stretches of a program that is kept whole (`packed`), which take a tenth of the memory, not a sixth.

use crate::canon::{Axis, Distance, Fact, Motion};
use crate::expr::Expr;
use crate::expr::num::{Num, Unit};
use crate::program::{Coord, Lines, Move, Op, Stmt};
use crate::source::Span;

/// Axes of a row: X, Y and Z.
pub const AXES_OF_ROW: usize = Axis::A as usize;

/// Bits of [`Row::form`]: six for each axis, of which four are the digits after the point.
const BITS: usize = 6;
const POINT: u32 = 1 << 4;
const NAMED: u32 = 1 << 5;
const TRAVERSE: u32 = 1 << 18;
const SAID: u32 = 1 << 19;
const FEED: u32 = 1 << 20;
/// The rest is the length of the block.
const LENGTH: u32 = 21;

/// Bits that are the same in two texts that say the same line: how the point and the code are written is not.
const SAME: u32 = {
    let axis = NAMED | (POINT - 1);
    axis | axis << BITS | axis << (2 * BITS) | TRAVERSE | FEED
};

/// No block number.
const UNNUMBERED: u32 = u32::MAX;

/// Rows at the end of a table that stand for themselves: a pass may look back by so many.
const TAIL: usize = 8;

/// A feed, and the place of its word.
pub type StatedFeed = (Num, Span);

/// A block that goes along a line, with or without a feed before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    mantissas: [i32; AXES_OF_ROW],
    form: u32,
    start: u32,
    number: u32,
}

impl Default for Row {
    fn default() -> Row {
        Row { mantissas: [0; AXES_OF_ROW], form: 0, start: 0, number: UNNUMBERED }
    }
}

impl Row {
    /// Its words of X, Y and Z.
    #[inline(always)]
    pub fn word(&self, axis: usize, unit: Unit) -> Option<Num> {
        let form = self.form >> (BITS * axis);
        let mantissa = i64::from(self.mantissas[axis]);
        (form & NAMED != 0).then_some(Num {
            mantissa,
            scale: (form & (POINT - 1)) as u8,
            point: form & POINT != 0,
            unit,
        })
    }

    /// Axes that have words, a bit each.
    #[inline(always)]
    pub fn axes(&self) -> u8 {
        let named = |axis: usize| (self.form >> (BITS * axis + 5) & 1) << axis;
        (named(0) | named(1) | named(2)) as u8
    }

    /// Whether it goes at feed or rapidly.
    #[inline(always)]
    pub fn motion(&self) -> Motion {
        if self.form & TRAVERSE != 0 { Motion::Traverse } else { Motion::Feed }
    }

    /// Whether the block itself says the code of its motion.
    #[inline(always)]
    pub fn says_motion(&self) -> bool {
        self.form & SAID != 0
    }

    /// Whether it states a feed, the next one of [`LineTable::feeds`].
    #[inline(always)]
    pub fn has_feed(&self) -> bool {
        self.form & FEED != 0
    }

    /// Whether another one says the same line; of the feeds that they state nothing is stated.
    #[inline(always)]
    pub fn says_the_same(&self, other: &Row) -> bool {
        self.mantissas == other.mantissas && (self.form ^ other.form) & SAME == 0
    }

    /// Its block number.
    #[inline(always)]
    pub fn number(&self) -> Option<u32> {
        (self.number != UNNUMBERED).then_some(self.number)
    }

    /// Its place.
    #[inline(always)]
    pub fn span(&self) -> Span {
        Span::new(self.start, self.start + (self.form >> LENGTH))
    }

    /// Puts a word in, of at most eight digits after the point.
    #[inline(always)]
    pub fn set_word(&mut self, axis: usize, mantissa: i32, scale: u8, point: bool) {
        debug_assert!(scale < 16);
        self.mantissas[axis] = mantissa;
        self.form |= (NAMED | u32::from(point) << 4 | u32::from(scale)) << (BITS * axis);
    }

    /// Has it go at the active feed, or in rapid.
    #[inline(always)]
    pub fn set_motion(&mut self, feed: bool) {
        self.form |= if feed { 0 } else { TRAVERSE };
    }

    /// Has its block say by a code how it goes, or not.
    #[inline(always)]
    pub fn set_said(&mut self, said: bool) {
        self.form |= if said { SAID } else { 0 };
    }

    /// Puts it at a place; `false` where its block is too long.
    #[inline(always)]
    #[must_use]
    pub fn set_span(&mut self, span: Span) -> bool {
        let length = span.end - span.start;
        self.start = span.start;
        self.form |= (length & (u32::MAX >> LENGTH)) << LENGTH;
        length <= u32::MAX >> LENGTH
    }

    /// Gives it a block number; `false` where it is none of a row.
    #[inline(always)]
    #[must_use]
    pub fn set_number(&mut self, number: u32) -> bool {
        self.number = number;
        number != UNNUMBERED
    }

    /// Appends its statements: its line by words of this unit and distance mode, after the feed that it states.
    #[inline]
    pub fn unpack(
        &self,
        unit: Unit,
        distance: Fact<Distance>,
        feed: Option<&StatedFeed>,
        to: &mut Vec<Stmt>,
    ) {
        let mut number = self.number();
        if let Some((feed, span)) = feed {
            let op = Op::SetFeedRate(Expr::Num(*feed));
            to.push(Stmt { number: number.take(), ..Stmt::new(*span, op) });
        }
        // A statement is large: it goes to its place empty, and is filled there.
        let empty = Move { said: self.says_motion(), ..Move::default() };
        let op = match self.motion() {
            Motion::Traverse => Op::StraightTraverse(empty),
            Motion::Feed | Motion::Arc(_) | Motion::Cycle => Op::StraightFeed(empty),
        };
        to.push(Stmt { number, joined: feed.is_some(), ..Stmt::new(self.span(), op) });
        let Some(Op::StraightFeed(line) | Op::StraightTraverse(line)) =
            to.last_mut().map(|stmt| &mut stmt.op)
        else {
            return;
        };
        for (axis, word) in line.to.axes[..AXES_OF_ROW].iter_mut().enumerate() {
            if let Some(num) = self.word(axis, unit) {
                *word = Some(Coord { value: Expr::Num(num), distance });
            }
        }
    }
}

/// Lines one after the other, whose words count from zero in one unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LineTable {
    unit: Unit,
    rows: Vec<Row>,
    feeds: Vec<StatedFeed>,
}

impl LineTable {
    /// Whether it has no row.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Empties it, and keeps its memory.
    pub fn clear(&mut self) {
        self.rows.clear();
        self.feeds.clear();
    }

    /// The unit of its words: millimetres or inches.
    pub fn unit(&self) -> Unit {
        self.unit
    }

    /// Its rows.
    #[inline(always)]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The feeds that its rows state, in their order, with the places of their words.
    pub fn feeds(&self) -> &[StatedFeed] {
        &self.feeds
    }

    /// Whether it can take a line by words of this unit and distance mode.
    #[inline(always)]
    pub fn takes(&self, unit: Unit, distance: Fact<Distance>) -> bool {
        distance == Fact::Known(Distance::Absolute)
            && if self.rows.is_empty() { matches!(unit, Unit::Mm | Unit::Inch) } else { unit == self.unit }
    }

    /// Adds a line in a unit that it takes: `fill` fills an empty row, and the feed that its block states before it. Gives
    /// what that gives; where it is `None`, nothing is added.
    #[inline(always)]
    pub fn push_by<T>(
        &mut self,
        unit: Unit,
        fill: impl FnOnce(&mut Row, &mut Option<StatedFeed>) -> Option<T>,
    ) -> Option<T> {
        self.rows.push(Row::default());
        let mut feed = None;
        let filled = self.rows.last_mut().and_then(|row| fill(row, &mut feed));
        if filled.is_none() {
            self.rows.pop();
            return None;
        }
        self.unit = unit;
        if let (Some(feed), Some(row)) = (feed, self.rows.last_mut()) {
            row.form |= FEED;
            self.feeds.push(feed);
        }
        filled
    }

    /// Adds the statements of a block, if they are a line that a row can hold; `false`, and then nothing was done, if not.
    pub fn push_block(&mut self, block: &[Stmt]) -> bool {
        let Some((row, unit, feed)) = row_of(block) else { return false };
        let takes = self.takes(unit, Fact::Known(Distance::Absolute));
        takes && self.push_by(unit, |to, stated| Some((*to, *stated) = (row, feed))).is_some()
    }

    /// How many statements they are, and how many blocks.
    pub fn counts(&self) -> (usize, usize) {
        (self.rows.len() + self.feeds.len(), self.rows.len())
    }

    /// What passes ask of all of them at once.
    pub fn lines(&self) -> Lines {
        Lines { axes: self.rows.iter().fold(0, |axes, row| axes | u16::from(row.axes())) }
    }

    /// Whether two texts say the same lines and feeds.
    pub fn says_the_same(&self, other: &LineTable) -> bool {
        let same_row = |(a, b): (&Row, &Row)| a.says_the_same(b);
        let same_feed = |(a, b): (&StatedFeed, &StatedFeed)| {
            (a.0.mantissa, a.0.scale, a.0.unit) == (b.0.mantissa, b.0.scale, b.0.unit)
        };
        self.unit == other.unit
            && self.rows.len() == other.rows.len()
            && self.feeds.len() == other.feeds.len()
            && self.rows.iter().zip(&other.rows).all(same_row)
            && self.feeds.iter().zip(&other.feeds).all(same_feed)
    }

    /// Appends the statements of all rows.
    pub fn unpack(&self, to: &mut Vec<Stmt>) {
        let mut feeds = self.feeds.iter();
        for row in &self.rows {
            let feed = if row.has_feed() { feeds.next() } else { None };
            self.unpack_row(row, feed, to);
        }
    }

    /// Appends the statements of a row, with the feed that it states.
    pub fn unpack_row(&self, row: &Row, feed: Option<&StatedFeed>, to: &mut Vec<Stmt>) {
        row.unpack(self.unit, Fact::Known(Distance::Absolute), feed, to);
    }

    /// Statements that stand for all of them before somebody who changes none: the first line of each kind, the last one
    /// that names each axis or states a feed, and the last ones of all. Each is one of the table's, in its order, so that
    /// every kind of statement is met, and what the table leaves active and the way on which it ends are left.
    pub fn stand_in(&self) -> Vec<Stmt> {
        let (mut kinds, mut met) = (0u64, 0u8);
        let mut stands: Vec<usize> = Vec::new();
        for (at, row) in self.rows.iter().enumerate() {
            let kind = 1 << (u32::from(row.axes()) | (row.form >> 18 & 7) << 3);
            if kinds & kind == 0 {
                kinds |= kind;
                stands.push(at);
            }
        }
        let all = self.rows.iter().fold(0, |all, row| all | named(row));
        let tail = self.rows.len().saturating_sub(TAIL);
        for (at, row) in self.rows.iter().enumerate().rev() {
            let new = named(row) & !met != 0;
            if at >= tail || new {
                stands.push(at);
            }
            met |= named(row);
            if at < tail && met == all {
                break;
            }
        }
        stands.sort_unstable();
        stands.dedup();
        self.statements_of(&stands)
    }

    /// The statements of some rows, by their places in order.
    fn statements_of(&self, places: &[usize]) -> Vec<Stmt> {
        let mut stmts = Vec::with_capacity(2 * places.len());
        let (mut places, mut feeds) = (places.iter().peekable(), self.feeds.iter());
        for (at, row) in self.rows.iter().enumerate() {
            let feed = if row.has_feed() { feeds.next() } else { None };
            if places.next_if_eq(&&at).is_some() {
                self.unpack_row(row, feed, &mut stmts);
            }
        }
        stmts
    }
}

/// The axes that a row names, and whether it states a feed, a bit each.
fn named(row: &Row) -> u8 {
    row.axes() | u8::from(row.has_feed()) << AXES_OF_ROW
}

/// A line of one or two statements as a row, with its unit and its feed.
fn row_of(block: &[Stmt]) -> Option<(Row, Unit, Option<StatedFeed>)> {
    let (stmt, feed) = match block {
        [stmt] if !stmt.joined => (stmt, None),
        [feed, stmt] if !feed.joined && stmt.joined && stmt.number.is_none() => {
            let Op::SetFeedRate(Expr::Num(num)) = feed.op else { return None };
            (stmt, Some((num, feed.span)))
        }
        _ => return None,
    };
    let (to, at_feed) = match &stmt.op {
        Op::StraightFeed(to) => (to, true),
        Op::StraightTraverse(to) => (to, false),
        _ => return None,
    };
    let plain = |stmt: &Stmt| stmt.skip.is_none() && stmt.comment.is_none();
    let (linear, rotary) = to.to.axes.split_at(AXES_OF_ROW);
    if !block.iter().all(plain) || rotary.iter().any(Option::is_some) {
        return None;
    }
    let (mut row, mut unit) = (Row::default(), None);
    row.set_motion(at_feed);
    row.set_said(to.said);
    for (axis, word) in linear.iter().enumerate() {
        let Some(word) = word else { continue };
        let num = word.value.literal()?;
        let one_unit = *unit.get_or_insert(num.unit) == num.unit;
        if !one_unit || word.distance != Fact::Known(Distance::Absolute) || num.scale > 8 {
            return None;
        }
        row.set_word(axis, i32::try_from(num.mantissa).ok()?, num.scale, num.point);
    }
    let number = block.first()?.number;
    let placed = row.set_span(stmt.span) && number.is_none_or(|number| row.set_number(number));
    placed.then_some((row, unit?, feed))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(mantissa: i64, scale: u8) -> Num {
        Num { mantissa, scale, point: true, unit: Unit::Mm }
    }

    fn line(words: [Option<Num>; 3], feed: bool, at: u32) -> Stmt {
        let mut to = Move { said: at.is_multiple_of(3), ..Move::default() };
        for (axis, word) in to.to.axes.iter_mut().zip(words) {
            let distance = Fact::Known(Distance::Absolute);
            *axis = word.map(|num| Coord { value: Expr::Num(num), distance });
        }
        let op = if feed { Op::StraightFeed(to) } else { Op::StraightTraverse(to) };
        Stmt::new(Span::new(10 * at, 10 * at + 8), op)
    }

    /// Blocks of many kinds, by numbers from a simple generator.
    fn blocks(mut seed: u64) -> Vec<Vec<Stmt>> {
        let mut next = move |below: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) % below
        };
        let mut block = |at| {
            let named = 1 + next(7);
            let words = [0, 1, 2].map(|axis| {
                let value = next(20_000) as i64 - 10_000;
                (named >> axis & 1 == 1).then(|| number(value, next(5) as u8))
            });
            let mut move_ = line(words, next(5) > 0, at);
            if next(6) > 0 {
                move_.number = (next(2) == 0).then_some(at);
                return vec![move_];
            }
            let feed = Op::SetFeedRate(Expr::Num(number(100 * next(9) as i64, 0)));
            let span = Span::new(10 * at + 6, 10 * at + 8);
            let feed = Stmt { number: Some(at), ..Stmt::new(span, feed) };
            vec![feed, Stmt { joined: true, ..move_ }]
        };
        (0..40).map(&mut block).collect()
    }

    fn table(blocks: &[Vec<Stmt>]) -> LineTable {
        let mut table = LineTable::default();
        for block in blocks {
            assert!(table.push_block(block), "{block:?}");
        }
        table
    }

    #[test]
    fn rows_hold_all_that_their_statements_say() {
        for seed in 0..50 {
            let blocks = blocks(seed);
            let (table, mut unpacked) = (table(&blocks), Vec::new());
            table.unpack(&mut unpacked);
            assert_eq!(unpacked, blocks.concat());
            assert_eq!(table.counts(), (unpacked.len(), blocks.len()));
            assert_eq!(Some(table.lines()), Lines::from_statements(&unpacked));
        }
    }

    #[test]
    fn a_row_is_of_24_bytes() {
        assert_eq!(size_of::<Row>(), 24);
    }

    #[test]
    fn what_is_no_plain_line_is_no_row() {
        let plain = || line([Some(number(5, 1)), None, None], true, 3);
        let with = |change: &dyn Fn(&mut Stmt)| {
            let mut stmt = plain();
            change(&mut stmt);
            stmt
        };
        let word = |change: &dyn Fn(&mut Coord)| {
            with(&|stmt| {
                let Op::StraightFeed(to) = &mut stmt.op else { panic!("a line") };
                to.to.axes[0].iter_mut().for_each(change);
            })
        };
        for other in [
            with(&|stmt| stmt.skip = Some(1)),
            with(&|stmt| stmt.joined = true),
            with(&|stmt| stmt.comment = Some(Box::new("a remark".into()))),
            with(&|stmt| stmt.number = Some(u32::MAX)),
            with(&|stmt| stmt.span.end = 5_000),
            with(&|stmt| stmt.op = Op::Blank),
            word(&|word| word.distance = Fact::Entry),
            word(&|word| word.value = Expr::Num(Num { unit: Unit::Entry, ..number(5, 1) })),
            word(&|word| word.value = Expr::Num(number(1 << 40, 1))),
            word(&|word| word.value = Expr::Num(number(1, 9))),
            line([None; 3], true, 3),
        ] {
            let mut table = LineTable::default();
            assert!(!table.push_block(std::slice::from_ref(&other)), "{other:?}");
            assert!(table.is_empty());
        }
        let mut inches = table(&[vec![plain()]]);
        let inch = word(&|word| word.value = Expr::Num(Num { unit: Unit::Inch, ..number(5, 1) }));
        assert!(!inches.push_block(&[inch]), "one unit for all");
    }

    /// The point and the code that a text writes are not what it says; all else is.
    #[test]
    fn texts_say_the_same_or_not() {
        let base = blocks(7);
        let same = table(&base);
        let mut otherwise = base.clone();
        for stmt in otherwise.iter_mut().flatten() {
            if let Op::StraightFeed(to) | Op::StraightTraverse(to) = &mut stmt.op {
                to.said = !to.said;
            }
            (stmt.span, stmt.number) = (Span::new(stmt.span.start + 7, stmt.span.end + 9), None);
        }
        assert!(same.says_the_same(&table(&otherwise)));
        for at in 0..base.len() {
            for change in 0..4 {
                let mut other = base.clone();
                let stmt = other[at].last_mut().expect("a block");
                let (Op::StraightFeed(to) | Op::StraightTraverse(to)) = &mut stmt.op else {
                    panic!("a line")
                };
                let word = to.to.axes.iter_mut().flatten().last().expect("a word");
                let Expr::Num(num) = &mut word.value else { panic!("a number") };
                match change {
                    0 => num.mantissa += 1,
                    1 => num.scale += 1,
                    2 => {
                        let to = to.clone();
                        stmt.op = match stmt.op {
                            Op::StraightFeed(_) => Op::StraightTraverse(to),
                            _ => Op::StraightFeed(to),
                        }
                    }
                    _ => {
                        other.remove(at);
                    }
                }
                assert!(!same.says_the_same(&table(&other)), "{at} {change}");
            }
        }
        let fed = base.iter().position(|block| block.len() == 2).expect("a feed");
        let mut other = base.clone();
        other[fed][0].op = Op::SetFeedRate(Expr::Num(number(12_345, 0)));
        assert!(!same.says_the_same(&table(&other)));
    }

    /// What is left active, and the kinds that are met, are those of all statements.
    #[test]
    fn a_few_statements_stand_for_all() {
        for seed in 0..50 {
            let blocks = blocks(seed);
            let (table, all) = (table(&blocks), blocks.concat());
            let stand = table.stand_in();
            assert!(stand.iter().all(|stmt| all.contains(stmt)));
            assert!(stand.ends_with(&all[all.len() - TAIL..]));
            assert_eq!(stand.first(), all.first());
            let last = |stmts: &[Stmt], axis: usize| {
                stmts.iter().rev().find_map(|stmt| match &stmt.op {
                    Op::StraightFeed(to) | Op::StraightTraverse(to) => to.to.axes[axis].clone(),
                    _ => None,
                })
            };
            for axis in 0..3 {
                assert_eq!(last(&stand, axis), last(&all, axis));
            }
            let feed = |stmts: &[Stmt]| {
                stmts.iter().rev().find(|stmt| matches!(stmt.op, Op::SetFeedRate(_))).cloned()
            };
            assert_eq!(feed(&stand), feed(&all));
            assert_eq!(Lines::from_statements(&stand), Lines::from_statements(&all));
        }
    }
}
