//! `feed-unit`: feeds are written in the unit of length in force.
//!
//! For targets whose feed counts what their lengths count. To inches a feed is rounded to one digit
//! more than a length in millimetres has.

use super::walk::Walk;
use super::write::{exact, rounded};
use super::{Target, each_body};
use crate::canon::Units;
use crate::cycle::CycleKind;
use crate::diag::Diagnostic;
use crate::expr::Expr;
use crate::num::{Num, Unit};
use crate::program::{Op, Program, Stmt};
use crate::track::Tracker;

/// Writes them in the unit in force.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, _: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| over(body, walk, target));
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
