//! Statements as what they do to a drill: aside, up or down by rapid, a cut, a dwell.

use crate::support::write::{as_absolute, at, is_absolute};
use ncc_ir::canon::{Axis, FeedMode, Plane, Units};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::program::{Coord, Op, Point, Stmt};
use ncc_ir::track::Tracker;

/// What a move or dwell does.
#[derive(Clone, Debug)]
pub(super) enum Act {
    /// Rapid in the plane; the words say where.
    Aside(Point),
    /// Rapid along the drilling axis.
    Rapid(Coord, Nanos),
    /// Cut along the drilling axis, at a feed.
    Cut(Coord, Nanos, Option<Num>),
    /// Dwell, and for how long.
    Dwell(Expr, Nanos),
}

/// Reads acts from statements.
#[derive(Clone, Debug)]
pub(super) struct Acts<'s> {
    stmts: &'s [Stmt],
    /// How many statements have been read.
    pub(super) read: usize,
    /// Tool position after them.
    pub(super) at: Tracker,
    /// The active feed after them.
    pub(super) feed: Option<Num>,
    /// Whether a feed has been stated.
    pub(super) feed_said: bool,
    plane: Plane,
}

impl<'s> Acts<'s> {
    pub(super) fn new(stmts: &'s [Stmt], at: Tracker, feed: Option<Num>, plane: Plane) -> Acts<'s> {
        Acts { stmts, read: 0, at, feed, feed_said: false, plane }
    }

    /// Level of the drilling axis.
    pub(super) fn level(&self) -> Option<Nanos> {
        self.at.position[self.plane.axes().2 as usize]
    }

    /// The next act. `None` if there is something that no hole is made of; what stood before it has
    /// been read then.
    pub(super) fn next(&mut self) -> Option<Act> {
        loop {
            let stmt = self.stmts.get(self.read)?;
            if stmt.skip.is_some() || self.at.raw || self.at.probing || self.at.detour {
                return None;
            }
            let act = match &stmt.op {
                Op::StraightTraverse(m) => Some(self.moved(&m.to, false)?),
                Op::StraightFeed(m) => Some(self.moved(&m.to, true)?),
                Op::Dwell(seconds) => {
                    Some(Some(Act::Dwell(seconds.literal()?.trimmed().into(), self.at.nanos(seconds)?)))
                }
                Op::SetFeedRate(feed) => {
                    self.feed = Some(feed.literal()?.trimmed());
                    self.feed_said = true;
                    None
                }
                Op::Comment(_) | Op::Blank => None,
                _ if self.changes_nothing(&stmt.op) => None,
                _ => return None,
            };
            self.at.apply(&stmt.op);
            self.read += 1;
            if let Some(Some(act)) = act {
                return Some(act);
            }
        }
    }

    /// Whether a setting is active already.
    fn changes_nothing(&self, op: &Op) -> bool {
        let modes = &self.at.modes;
        match op {
            Op::SetDistanceMode(distance) => modes.distance == Some(*distance),
            Op::UseLengthUnits(units) => modes.units == Some(*units),
            Op::SelectPlane(plane) => modes.plane == Some(*plane),
            Op::SetFeedMode(mode) => modes.feed_mode == Some(*mode) && *mode == FeedMode::PerMinute,
            _ => false,
        }
    }

    /// What a straight move does; `Some(None)` if it goes nowhere, `None` if no hole has such a move.
    #[allow(clippy::option_option)]
    fn moved(&self, to: &Point, feed: bool) -> Option<Option<Act>> {
        let target = self.at.target(to);
        let (first, second, normal) = self.plane.axes();
        let mut aside = Point::default();
        let mut along = None;
        for axis in Axis::ALL {
            let Some(word) = to.get(axis) else { continue };
            let nanos = target[axis as usize]?;
            if self.at.position[axis as usize] == Some(nanos) {
                continue;
            }
            let word = self.absolute(word, axis, nanos);
            if axis == normal {
                along = Some((word, nanos));
            } else if axis == first || axis == second {
                aside.set(axis, word);
            } else {
                return None;
            }
        }
        match (along, aside.is_empty(), feed) {
            (None, true, _) => Some(None),
            (Some((word, nanos)), true, false) => Some(Some(Act::Rapid(word, nanos))),
            (Some((word, nanos)), true, true) => Some(Some(Act::Cut(word, nanos, self.feed))),
            (None, false, false) => Some(Some(Act::Aside(aside))),
            (None, false, true) | (Some(_), false, _) => None,
        }
    }

    /// A word from program zero, as it is written if it is so.
    fn absolute(&self, word: &Coord, axis: Axis, nanos: Nanos) -> Coord {
        if is_absolute(word, self.at.modes.distance) {
            let mut word = as_absolute(word);
            if let Expr::Num(n) = &mut word.value {
                *n = n.trimmed();
            }
            return word;
        }
        at(nanos, axis, self.unit())
    }

    /// The unit in which lengths are written.
    pub(super) fn unit(&self) -> Unit {
        match self.at.modes.units {
            Some(Units::Inch) => Unit::Inch,
            Some(Units::Mm) | None => Unit::Mm,
        }
    }

    /// A word for where an axis stands.
    pub(super) fn here(&self, axis: Axis) -> Option<Coord> {
        Some(at(self.at.position[axis as usize]?, axis, self.unit()))
    }
}
