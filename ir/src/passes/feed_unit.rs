//! `feed-unit`: feeds are written in the unit of length in force.
//!
//! Likewise a feed is said again before the first cut after a change of units, for targets of which
//! it is not known what a feed said before means then, and behind a code of what the feed counts, for targets
//! on which such a code ends the feed even where it counts that already. Refused is a feed that would have to be said
//! again and is not known.
//!
//! For targets whose feed counts what their lengths count. To inches a feed is rounded to one digit
//! more than a length in millimetres has.

use super::walk::Walk;
use super::write::{exact, rebuild, rounded};
use super::{Target, each_body};
use crate::canon::{FeedMode, Motion, Units};
use crate::cycle::CycleKind;
use crate::diag::{Diagnostic, Fault};
use crate::expr::Expr;
use crate::num::{Num, Unit};
use crate::program::{Op, Program, Stmt};
use crate::track::Tracker;

/// Feed in force, and whether the units have changed since it was said, or a code has ended it.
#[derive(Clone, Debug, Default)]
pub(super) struct State {
    feed: Option<Num>,
    stale: bool,
    ended: bool,
}

impl State {
    /// Whether a feed waits to be said again.
    pub(super) fn is_busy(&self) -> bool {
        self.stale || self.ended
    }

    /// Notes the feed of a statement.
    #[inline]
    pub(super) fn note(&mut self, op: &Op) {
        let feed = match op {
            Op::SetFeedRate(feed) => feed,
            Op::StartCycle(cycle) => match &cycle.feed {
                Some(feed) => feed,
                None => return,
            },
            _ => return,
        };
        self.feed = feed.literal();
        (self.stale, self.ended) = (false, false);
    }
}

/// Says feeds again after a change of units, and behind codes that end them.
pub(super) fn again(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut State,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    rebuild(body, |mut stmt, made| {
        walk.enter(stmt.skip);
        let cuts = match stmt.op.unwrapped() {
            Op::StraightFeed(_) | Op::SynchronisedFeed(_) | Op::ArcFeed(_) | Op::ArcForm(_) => true,
            Op::Position(_) => walk.at.modes.motion == Some(Motion::Feed),
            Op::StartCycle(cycle) => cycle.feed.is_none(),
            _ => false,
        };
        let again = state.stale || state.ended;
        if cuts && state.ended && (state.feed.is_none() || walk.at.modes.units.is_none()) {
            let what = "a feed that is not known here and holds behind a code of what it counts";
            diags.push(Diagnostic::new(Fault::CannotSay { what: what.into() }, stmt.span));
            state.ended = false;
        }
        if let (true, true, Some(feed), Some(units)) = (cuts, again, state.feed, walk.at.modes.units) {
            let feed = in_unit(feed, units, target).unwrap_or(feed);
            let mut said = Stmt::new(stmt.span, Op::SetFeedRate(feed.into()));
            (said.number, said.skip, said.joined) = (stmt.number.take(), stmt.skip, stmt.joined);
            stmt.joined = true;
            // In a block that may be skipped it is said for that block alone.
            let skipped = stmt.skip.is_some();
            (state.stale, state.ended) = (state.stale && skipped, state.ended && skipped);
            made.push(said);
        }
        if let Op::UseLengthUnits(units) = &stmt.op {
            state.stale |= state.feed.is_some() && walk.at.modes.units != Some(*units);
        }
        if let (Op::SetFeedMode(mode), true) = (&stmt.op, target.caps.feed_ends_with_mode) {
            // Another mode ends it on every control.
            let other = walk.at.modes.feed_mode.is_some_and(|now| now != *mode);
            state.ended = !other && *mode != FeedMode::InverseTime && walk.at.fed;
            if other {
                state.feed = None;
            }
        }
        state.note(&stmt.op);
        walk.step(&stmt);
        made.push(stmt);
    });
}

/// Writes them in the unit in force.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        over(body, &mut walk.clone(), target);
        again(body, walk, &mut State::default(), target, diags);
    });
}

/// The same for one body.
pub(super) fn over(body: &mut [Stmt], walk: &mut Walk, target: &Target) {
    for stmt in body {
        walk.enter(stmt.skip);
        let units = walk.at.modes.units;
        let mut mend = |feed: &mut Expr| {
            if let (Some(units), Some(num)) = (units, feed.literal())
                && let Some(num) = in_unit(num, units, target)
            {
                *feed = num.into();
            }
        };
        match &mut stmt.op {
            Op::SetFeedRate(feed) => mend(feed),
            Op::StartCycle(cycle) => {
                cycle.feed.iter_mut().for_each(&mut mend);
                if let CycleKind::Bore { feed_out: Some(feed), .. } = &mut cycle.kind {
                    mend(feed);
                }
            }
            _ => {}
        }
        walk.step(stmt);
    }
}

/// Whether a statement says a feed in another unit than `units`.
pub(super) fn differs(op: &Op, units: Option<Units>) -> bool {
    let other = |feed: &Expr| match (feed.literal().map(|n| n.unit), units) {
        (Some(Unit::Mm), units) => units != Some(Units::Mm),
        (Some(Unit::Inch), units) => units != Some(Units::Inch),
        _ => false,
    };
    match op {
        Op::SetFeedRate(feed) => other(feed),
        Op::StartCycle(cycle) => cycle.feed.as_ref().is_some_and(other),
        _ => false,
    }
}

fn in_unit(num: Num, units: Units, target: &Target) -> Option<Num> {
    let nanos = num.nanos(false)?;
    match (num.unit, units) {
        (Unit::Mm, Units::Inch) => Some(rounded(nanos, target.decimals_in(Unit::Inch), Unit::Inch)),
        (Unit::Inch, Units::Mm) => Some(exact(nanos, Unit::Mm)),
        _ => None,
    }
}
