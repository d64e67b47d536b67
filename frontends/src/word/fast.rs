//! The short way for plain moves: a block of at most a block number, X, Y and Z while every fact
//! that it depends on is settled. Nearly every block of a long program is one.
//!
//! It gives what the long way gives; a test holds both to the same result. Whatever is not settled,
//! or not plain, is left to the long way.

use ncc_dialects::Quantity;
use ncc_ir::canon::{Axis, Distance, Fact, Motion};
use ncc_ir::expr::Expr;
use ncc_ir::num::{Num, Unit};
use ncc_ir::program::{Coord, Move, Op, Stmt};
use ncc_ir::source::Span;

use super::block::{Value, Word};
use super::facts::{InForce, Know};
use super::lower::Lower;
use super::number::unit_of;
use crate::Batch;

/// What a plain move needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fast {
    pub(crate) unit: Unit,
    pub(crate) distance: Fact<Distance>,
    pub(crate) feed: bool,
    /// Letter of the block number.
    pub(crate) number: u8,
    /// Whether a number means the same with and without a point.
    pub(crate) bare: bool,
}

impl Lower {
    /// Finds out whether plain moves can go the short way from here.
    pub(super) fn refresh(&mut self) {
        self.fast = self.settled();
    }

    fn settled(&self) -> Option<Fast> {
        let linear =
            |axis: Axis| self.axis_row(axis).is_some_and(|r| r.quantity == Quantity::Length && r.sure);
        let axes = linear(Axis::X) && linear(Axis::Y) && linear(Axis::Z);
        let state = &self.state;
        let feed = match state.motion {
            Know::Said(Motion::Traverse) | Know::Taken(Motion::Traverse) => false,
            Know::Said(Motion::Feed) | Know::Taken(Motion::Feed) => true,
            _ => return None,
        };
        let open = self.assume
            && (state.distance == Know::Unsaid
                || state.units == Know::Unsaid
                || state.work_offset == Know::Unsaid
                || state.no_shift == Know::Unsaid
                || state.length_offset == Know::Unsaid);
        let no_feed = feed && (state.feed == Know::Unsaid || state.cycle_feed.is_some());
        if !axes || open || no_feed || state.after_cycle || state.cycle != InForce::None || self.ended {
            return None;
        }
        Some(Fast {
            unit: unit_of(state.units.fact()),
            distance: state.distance.fact(),
            feed,
            number: self.settings.dialect.block.number.map_or(0, |c| c as u8),
            bare: false,
        })
    }

    /// Lowers a plain move; `false` if it is not one, and then nothing was done.
    #[inline]
    pub(super) fn fast_move(&mut self, words: &[Word], out: &mut Batch) -> bool {
        match self.fast {
            Some(fast) => plain_move(fast, words, self.target(out)),
            None => false,
        }
    }
}

/// Lowers a plain move into `stmts`; `false` if it is not one, and then nothing was done.
#[inline]
pub(crate) fn plain_move(fast: Fast, words: &[Word], stmts: &mut Vec<Stmt>) -> bool {
    let Some((first, last)) = words.first().zip(words.last()) else {
        return false;
    };
    let span = Span::new(first.span.start, last.span.end);
    let mut number = None;
    let mut axes = words;
    if first.letter == fast.number {
        let Value::Number(digits) = first.value else {
            return false;
        };
        if digits.point || digits.mantissa < 0 {
            return false;
        }
        let Ok(n) = u32::try_from(digits.mantissa) else {
            return false;
        };
        number = Some(n);
        axes = &words[1..];
    }
    if axes.is_empty() || axes.len() > 3 {
        return false;
    }
    let mut seen = 0u8;
    for word in axes {
        let place = word.letter.wrapping_sub(b'X');
        let Value::Number(digits) = word.value else {
            return false;
        };
        let plain =
            digits.point && digits.scale <= 8 || (fast.bare || digits.mantissa == 0) && digits.scale == 0;
        let large = digits.mantissa.unsigned_abs() >= 10_000_000;
        if place > 2 || !plain || large || seen >> place & 1 == 1 {
            return false;
        }
        seen |= 1 << place;
    }
    // A statement is large: it goes to its place empty, and is filled there.
    let empty = Move::default();
    let op = if fast.feed { Op::StraightFeed(empty) } else { Op::StraightTraverse(empty) };
    stmts.push(Stmt { span, number, skip: None, joined: false, comment: None, op });
    let Some(Op::StraightFeed(Move { to, .. }) | Op::StraightTraverse(Move { to, .. })) =
        stmts.last_mut().map(|stmt| &mut stmt.op)
    else {
        return false;
    };
    for word in axes {
        if let Value::Number(digits) = word.value {
            to.axes[usize::from(word.letter - b'X')] = Some(Coord {
                value: Expr::Num(Num {
                    mantissa: digits.mantissa,
                    scale: digits.scale,
                    point: digits.point,
                    unit: fast.unit,
                }),
                distance: fast.distance,
            });
        }
    }
    true
}
