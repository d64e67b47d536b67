//! `drop-redundant`: statements that change nothing are left out.
//!
//! That is: a setting that the program itself has activated before (units, distance mode, plane,
//! feed mode, return level, work offset), a feed or speed that is active, the end of a cycle where
//! a move has ended it, a rapid to where the tool is, and words of straight moves for axes that
//! stand there already.
//!
//! Left alone: blocks that may be skipped, and whatever may differ because of them; remarks, labels,
//! numbers of blocks that stay; spindle, coolant and tools, which an operator may have switched at a
//! stop; words that a waiting length offset needs. What was only assumed at the start counts
//! as unsaid.

use crate::fold::fold_cycles::feed;
use crate::pass::Pass;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::rebuild;
use crate::target::Target;
use ncc_ir::canon::{Axis, FeedMode, Modes, Motion};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::Num;
use ncc_ir::program::kinds::{flow, moves};
use ncc_ir::program::{FrameSlot, Move, Op, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass =
    Pass::named("drop-redundant", "leaves out statements that change nothing", Some(run));

/// Leaves out what changes nothing.
pub fn run(program: &mut Program, _: &Target, entry: &Tracker, _: &mut Vec<Diagnostic>) {
    each_body(program, entry, drop_statements);
}

/// The same for one body.
pub(crate) fn drop_statements(body: &mut Vec<Stmt>, walk: &mut Walk) {
    // What the program itself has said.
    let start = Tracker { modes: Modes::default(), ..walk.at.clone() };
    let mut said = Walk::new(start);
    let (mut feed, mut speed) = (None, None);
    // Whether a move has surely ended any cycle.
    let mut moved = false;
    rebuild(body, |mut stmt, made| {
        walk.enter(stmt.skip);
        said.enter(stmt.skip);
        let needless = stmt.skip.is_none()
            && match &stmt.op {
                // A time counts for one move.
                Op::SetFeedRate(_) if walk.at.modes.feed_mode == Some(FeedMode::InverseTime) => false,
                Op::SetFeedRate(rate) => feed.is_some() && rate.literal().map(Num::trimmed) == feed,
                Op::SetSpindleSpeed(s) => speed.is_some() && s.literal().map(Num::trimmed) == speed,
                Op::EndCycle => moved && walk.at.cycle.is_none() && !walk.at.cycle_in_doubt,
                Op::StraightTraverse(m) => {
                    walk.at.modes.motion == Some(Motion::Traverse) && goes_nowhere(walk, m)
                }
                other => is_in_force(&said.at, other),
            };
        if !needless && stmt.skip.is_none() {
            shorten(walk, &mut stmt);
        }
        walk.step(&stmt);
        said.step(&stmt);
        feed = feed::after(&stmt, feed).map(Num::trimmed);
        speed = speed_after(&stmt, speed);
        moved = moved_after(&stmt, moved);
        if needless { made.leave_out(stmt) } else { made.push(stmt) }
    });
}

/// Whether a setting is active already.
fn is_in_force(at: &Tracker, op: &Op) -> bool {
    let modes = &at.modes;
    match op {
        Op::UseLengthUnits(units) => modes.units == Some(*units),
        Op::SetDistanceMode(distance) => modes.distance == Some(*distance),
        Op::SelectPlane(plane) => modes.plane == Some(*plane),
        Op::SetFeedMode(mode) => modes.feed_mode == Some(*mode),
        Op::SetReturnLevel(level) => modes.return_level == Some(*level),
        Op::SetOriginOffsets(offset) => modes.work_offset == Some(*offset),
        Op::ClearFrame(FrameSlot::Shift) => at.none_suspended && modes.no_origin_shift == Some(true),
        _ => false,
    }
}

/// Whether a rapid surely goes nowhere, and does nothing else either.
fn goes_nowhere(walk: &Walk, m: &Move) -> bool {
    let free = !walk.at.compensated
        && walk.at.cycle.is_none()
        && !walk.at.cycle_in_doubt
        && !walk.at.raw
        && !walk.at.detour
        && !walk.waiting;
    free && Axis::ALL.into_iter().all(|axis| m.to.get(axis).is_none() || stands(walk, m, axis))
}

/// Whether an axis stands where its word puts it.
fn stands(walk: &Walk, m: &Move, axis: Axis) -> bool {
    let now = walk.at.position[axis as usize];
    m.to.get(axis).is_some_and(|word| now.is_some() && walk.at.resolve(word, now) == now)
}

/// Leaves words out for axes that stand there already; at least one stays.
fn shorten(walk: &Walk, stmt: &mut Stmt) {
    let (Op::StraightTraverse(m) | Op::StraightFeed(m)) = &mut stmt.op else { return };
    // Under compensation a control looks at what the words name.
    if walk.at.raw || walk.at.probing || walk.at.detour || walk.at.compensated {
        return;
    }
    let needed = |axis: &Axis| *axis == Axis::Z && walk.waiting;
    let needless: Vec<Axis> =
        Axis::ALL.into_iter().filter(|axis| stands(walk, m, *axis) && !needed(axis)).collect();
    let words = m.to.axes.iter().flatten().count();
    // An incremental word of no way says that nothing is meant to move; it goes as well.
    let keep = usize::from(needless.len() == words);
    for axis in needless.into_iter().skip(keep) {
        m.to.axes[axis as usize] = None;
    }
}

/// Speed active, as far as the program says it.
fn speed_after(stmt: &Stmt, before: Option<Num>) -> Option<Num> {
    let now = match &stmt.op {
        Op::SetSpindleSpeed(speed) => speed.literal().map(Num::trimmed),
        Op::ChangeTool | Op::SetSpindleMode(_) | Op::ProgramStop | Op::OptionalProgramStop | flow!() => None,
        _ => before,
    };
    if stmt.skip.is_some() && now != before { None } else { now }
}

/// Whether a move has surely ended any cycle before.
fn moved_after(stmt: &Stmt, before: bool) -> bool {
    match stmt.op.unwrapped() {
        Op::EndCycle | moves!() => before || stmt.skip.is_none(),
        Op::Call(_)
        | Op::RepeatBlocks(_)
        | Op::Control(_)
        | Op::Goto(_)
        | Op::Label(_)
        | Op::Leave
        | Op::NextTurn => false,
        _ => before,
    }
}
