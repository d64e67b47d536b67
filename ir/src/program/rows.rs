//! Rows of a table one after the other, with the feeds that they state.
//!
//! ```text
//! two programs in pieces of 16 KiB:   rows 1 to 700 | 701 to 1400    and 1 to 650 | 651 to 1310
//! what both say next:                 rows 651 to 700 of the first piece of one, 651 to 700 of the second of the other
//! ```
//!
//! Not here: what a row is (`line_table`).

use crate::canon::{Distance, Fact};
use crate::expr::num::Unit;
use crate::program::Stmt;
use crate::program::line_table::{LineTable, Row, StatedFeed};

/// Rows of a table.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'t> {
    /// The unit of their words.
    pub unit: Unit,
    rows: &'t [Row],
    feeds: &'t [StatedFeed],
}

impl<'t> Rows<'t> {
    /// All of a table.
    pub fn of(table: &'t LineTable) -> Rows<'t> {
        Rows { unit: table.unit(), rows: table.rows(), feeds: table.feeds() }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The first `many`, or all, and those after them.
    pub fn split(self, many: usize) -> (Rows<'t>, Rows<'t>) {
        let (rows, behind) = self.rows.split_at(many.min(self.rows.len()));
        let feeds = rows.iter().filter(|row| row.has_feed()).count();
        let (feeds, feeds_behind) = self.feeds.split_at(feeds.min(self.feeds.len()));
        (Rows { rows, feeds, ..self }, Rows { rows: behind, feeds: feeds_behind, ..self })
    }

    /// Each with the feed that it states.
    pub fn each(self) -> impl Iterator<Item = (&'t Row, Option<&'t StatedFeed>)> {
        let mut feeds = self.feeds.iter();
        self.rows.iter().map(move |row| (row, if row.has_feed() { feeds.next() } else { None }))
    }

    /// How many from the first one on another text says as well.
    pub fn said_by(self, other: Rows) -> usize {
        if self.unit != other.unit {
            return 0;
        }
        let same_feed = |a: Option<&StatedFeed>, b: Option<&StatedFeed>| match (a, b) {
            (None, None) => true,
            (Some((a, _)), Some((b, _))) => (a.mantissa, a.scale, a.unit) == (b.mantissa, b.scale, b.unit),
            (None, Some(_)) | (Some(_), None) => false,
        };
        let same = |((a, fed), (b, fed_there)): &((&Row, _), (&Row, _))| {
            a.says_the_same(b) && same_feed(*fed, *fed_there)
        };
        self.each().zip(other.each()).take_while(same).count()
    }

    /// Appends their statements.
    pub fn unpack(self, to: &mut Vec<Stmt>) {
        for (row, feed) in self.each() {
            row.unpack(self.unit, Fact::Known(Distance::Absolute), feed, to);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Expr;
    use crate::expr::num::Num;
    use crate::program::{Coord, Move, Op, Point};
    use crate::source::Span;

    fn number(mantissa: i64) -> Num {
        Num { mantissa, scale: 3, point: true, unit: Unit::Mm }
    }

    /// Blocks along X, some with a feed before it.
    fn table(blocks: &[(i64, Option<i64>)]) -> LineTable {
        let mut table = LineTable::default();
        for (at, (x, feed)) in blocks.iter().enumerate() {
            let span = Span::new(10 * at as u32, 10 * at as u32 + 9);
            let mut to = Move { to: Point { axes: Default::default() }, said: false };
            let distance = Fact::Known(Distance::Absolute);
            to.to.axes[0] = Some(Coord { value: Expr::Num(number(*x)), distance });
            let fed = feed.map(|feed| Stmt::new(span, Op::SetFeedRate(Expr::Num(number(feed)))));
            let line = Stmt { joined: feed.is_some(), ..Stmt::new(span, Op::StraightFeed(to)) };
            assert!(table.push_block(&fed.into_iter().chain([line]).collect::<Vec<Stmt>>()));
        }
        table
    }

    #[test]
    fn parts_have_the_feeds_of_their_rows() {
        let table = table(&[(1, None), (2, Some(7)), (3, None), (4, Some(8)), (5, None)]);
        let mut all = Vec::new();
        table.unpack(&mut all);
        for many in 0..7 {
            let (before, behind) = Rows::of(&table).split(many);
            let mut stmts = Vec::new();
            before.unpack(&mut stmts);
            behind.unpack(&mut stmts);
            assert_eq!((before.len(), stmts), (many.min(5), all.clone()));
        }
    }

    #[test]
    fn rows_are_the_same_up_to_one_that_is_not() {
        let blocks = [(1, None), (2, Some(7)), (3, None), (4, Some(8)), (5, None)];
        let one = table(&blocks);
        assert_eq!(Rows::of(&one).said_by(Rows::of(&table(&blocks))), 5);
        assert_eq!(Rows::of(&one).said_by(Rows::of(&table(&blocks[..3]))), 3);
        for at in 0..blocks.len() {
            let (x, feed) = blocks[at];
            for other in [(x + 1, feed), (x, feed.map_or(Some(9), |_| None)), (x, feed.map(|feed| feed + 1))]
            {
                let mut others = blocks;
                others[at] = other;
                let same = if other == blocks[at] { 5 } else { at };
                assert_eq!(Rows::of(&one).said_by(Rows::of(&table(&others))), same, "{others:?}");
            }
        }
    }
}
