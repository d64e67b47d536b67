//! `tapped-holes`: threads that are cut by spindle-synchronised moves, one in and one out, as tapping cycles.
//!
//! For targets that have such a cycle and no such moves. The tool stands where the thread begins; it goes in along the
//! axis of the plane, may dwell, has the spindle turned round, and retracts to where it began, or to where it stood before
//! a rapid took it there. Dwells and turns of the spindle among them are the cycle's.
//!
//! Left as they are, and refused later: a thread with anything else among its blocks or with one under block skip, with
//! another feed on the way out, along several axes, or where the tool is is not known; dwells and turns of which the
//! target's cycle makes others. In and out in one block is `threads`'.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::{CYCLE, THREAD};
use crate::support::walk::Walk;
use crate::support::write::at;
use crate::target::Target;
use ncc_ir::canon::{Axis, Fact, Plane, ReturnLevel, Spindle, Turn};
use ncc_ir::caps::CycleForm;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::cycle::{Approach, Cycle, CycleKind, Tap};
use ncc_ir::program::{Move, Op, Pitch, Point, Stmt, Synchronised};

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "tapped-holes",
    about: "puts the two halves of a tapped hole together",
    alone: None,
    step: Step::at(
        Moment::Wording,
        |l, p| p.needs(THREAD) && p.stmts.iter().any(|stmt| is_half(stmt, &l.target)),
        |l, p| {
            fold_tapped_holes(p.stmts, &mut p.start.clone(), &l.target);
            p.needs |= l.lacks & CYCLE;
        },
    ),
    program: &[],
    parametric: None,
};

/// A thread among statements.
#[derive(Debug)]
struct Thread {
    /// How many statements it takes.
    length: usize,
    tap: Tap,
    plane: Plane,
    /// Where it begins, where its bottom is, and where the way out ends, along the plane's axis.
    start: Nanos,
    bottom: Nanos,
    end: Nanos,
}

/// Whether a statement is the way into a thread, or out of it, and the target has a cycle for it and no such move.
pub(crate) fn is_half(stmt: &Stmt, target: &Target) -> bool {
    let Op::SynchronisedFeed(m) = &stmt.op else { return false };
    let threads = target.caps.moves.threads;
    let says = match (m.chuck, m.turn) {
        (true, _) => threads.chuck,
        (false, Some(_)) => threads.turned || threads.back,
        (false, None) => true,
    };
    !says && !threads.any && !m.back && form(m.chuck, target).is_some()
}

/// How the target's cycle for such a thread is stated.
fn form(chuck: bool, target: &Target) -> Option<CycleForm> {
    let name = if chuck { "tap" } else { "tap-rigid" };
    target.caps.holes.cycles.iter().find(|cap| cap.kind == name).map(|cap| cap.form)
}

/// Writes them as cycles.
pub(crate) fn fold_tapped_holes(body: &mut Vec<Stmt>, walk: &mut Walk, target: &Target) {
    let old = std::mem::take(body);
    let mut rest = &old[..];
    while let Some(stmt) = rest.first() {
        walk.enter(stmt.skip);
        // A rapid to where the thread begins is the cycle's, where the way out returns to before it.
        let before = if leads_down(stmt, walk) { said(&rest[1..]) + 1 } else { 0 };
        let mut there = walk.clone();
        rest[..before].iter().for_each(|stmt| there.step(stmt));
        let thread = rest.get(before).filter(|stmt| is_half(stmt, target));
        let thread = thread.and_then(|_| thread_of(&rest[before..], &there, target));
        let level = |thread: &Thread| walk.at.position[thread.plane.axes().2 as usize];
        let Some(thread) = thread.filter(|thread| level(thread) == Some(thread.end)) else {
            walk.step(stmt);
            body.push(stmt.clone());
            rest = &rest[1..];
            continue;
        };
        let (own, behind) = rest.split_at(before + thread.length);
        let cycle = [
            Op::StartCycle(Box::new(cycle_of(&thread, walk, target))),
            Op::Hole(Move::default()),
            Op::EndCycle,
        ];
        let from = body.len();
        let (ahead, thread) = own.split_at(before);
        let remark = |stmt: &&Stmt| matches!(stmt.op, Op::Comment(_) | Op::Blank);
        let kept = ahead.iter().filter(|stmt| is_said(&stmt.op)).chain(thread.iter().filter(remark));
        body.extend(kept.cloned());
        for (place, op) in cycle.into_iter().enumerate() {
            let mut one = Stmt::new(own[before].span, op);
            one.joined = place == 1;
            body.push(one);
        }
        // Their comments stand after the cycle.
        for stmt in own.iter().filter(|stmt| !is_said(&stmt.op)) {
            if let Some(comment) = &stmt.comment {
                body.push(Stmt::new(stmt.span, Op::Comment((**comment).clone())));
            }
        }
        body[from..].iter().for_each(|stmt| walk.step(stmt));
        rest = behind;
    }
}

/// How many statements from here on say nothing that moves.
fn said(rest: &[Stmt]) -> usize {
    rest.iter().take_while(|stmt| is_said(&stmt.op)).count()
}

fn is_said(op: &Op) -> bool {
    matches!(op, Op::SetFeedRate(_) | Op::Comment(_) | Op::Blank)
}

/// Whether a statement is a rapid down along the plane's axis alone.
fn leads_down(stmt: &Stmt, walk: &Walk) -> bool {
    let Op::StraightTraverse(m) = &stmt.op else { return false };
    let level = walk.at.modes.plane.and_then(|plane| {
        let normal = plane.axes().2;
        let from = walk.at.position[normal as usize]?;
        Some(along(&m.to, normal, walk, from)? < from)
    });
    stmt.skip.is_none() && level == Some(true)
}

/// Where a point is that supports this axis alone.
fn along(to: &Point, axis: Axis, walk: &Walk, from: Nanos) -> Option<Nanos> {
    let only = Axis::ALL.into_iter().all(|other| (other == axis) == to.get(other).is_some());
    if only { walk.at.resolve(to.get(axis)?, Some(from)) } else { None }
}

/// The thread that begins with the first of these statements.
fn thread_of(stmts: &[Stmt], walk: &Walk, target: &Target) -> Option<Thread> {
    let plane = walk.at.modes.plane?;
    let normal = plane.axes().2;
    let start = walk.at.position[normal as usize]?;
    let way_in = half(stmts.first()?)?;
    let bottom = along(&way_in.to, normal, walk, start).filter(|bottom| *bottom < start)?;
    let turn = match (way_in.turn, walk.at.spindle) {
        (Some(turn), _) => turn,
        (None, Some(Spindle::Clockwise)) => Turn::Clockwise,
        (None, Some(Spindle::Counterclockwise)) => Turn::Counterclockwise,
        (None, Some(Spindle::Stopped) | None) => return None,
    };
    let mut now = turn.spindle();
    let mut dwells: [Option<Expr>; 2] = [None, None];
    let mut length = 1;
    let way_out = loop {
        let stmt = stmts.get(length).filter(|stmt| stmt.skip.is_none())?;
        length += 1;
        match &stmt.op {
            Op::Comment(_) | Op::Blank => {}
            Op::SetFeedRate(feed) if feed.literal().is_some() && feed.literal() == walk.at.feed => {}
            Op::Dwell(seconds) => {
                let dwell = &mut dwells[usize::from(now != turn.spindle())];
                if dwell.replace(seconds.clone()).is_some() {
                    return None;
                }
            }
            Op::StartSpindleClockwise if way_in.chuck => now = Spindle::Clockwise,
            Op::StartSpindleCounterclockwise if way_in.chuck => now = Spindle::Counterclockwise,
            _ => break half(stmt)?,
        }
    };
    let back = way_in.turn.map(Turn::back);
    let turned = !way_in.chuck || now == turn.back().spindle();
    if (way_out.chuck, way_out.turn, &way_out.pitch) != (way_in.chuck, back, &way_in.pitch) || !turned {
        return None;
    }
    let end = along(&way_out.to, normal, walk, bottom).filter(|end| *end >= start)?;
    let [dwell, back] = dwells;
    let after = if way_in.chuck { now } else { Spindle::Stopped };
    let (chuck, pitch) = (way_in.chuck, way_in.pitch.clone());
    let mut tap = Tap { turn, pitch, chuck, dwell, back, settle: None, after, to_level: end > start };
    let form = form(chuck, target)?;
    for (index, stmt) in stmts.iter().enumerate().skip(length) {
        if says(form, &tap) {
            break;
        }
        length = index + 1;
        match &stmt.op {
            _ if stmt.skip.is_some() => return None,
            Op::Dwell(seconds) if tap.settle.is_none() && tap.after == after => {
                tap.settle = Some(seconds.clone());
            }
            Op::StartSpindleClockwise if chuck => tap.after = Spindle::Clockwise,
            Op::StartSpindleCounterclockwise if chuck => tap.after = Spindle::Counterclockwise,
            _ => return None,
        }
    }
    says(form, &tap).then_some(Thread { length, tap, plane, start, bottom, end })
}

/// One way of a thread.
fn half(stmt: &Stmt) -> Option<&Synchronised> {
    match &stmt.op {
        Op::SynchronisedFeed(m) if stmt.skip.is_none() && !m.back => Some(m),
        _ => None,
    }
}

/// Whether the target's cycle dwells and turns so. The pitch is `taps`'.
fn says(form: CycleForm, tap: &Tap) -> bool {
    let pitch = match form {
        CycleForm::Control(_) => Pitch::Feed,
        CycleForm::Any | CycleForm::Stated => tap.pitch.clone(),
    };
    form.says(&CycleKind::Tap(Box::new(Tap { pitch, ..tap.clone() })))
}

fn cycle_of(thread: &Thread, walk: &Walk, target: &Target) -> Cycle {
    let normal = thread.plane.axes().2;
    let level = if thread.end > thread.start { ReturnLevel::Initial } else { ReturnLevel::Retract };
    Cycle {
        kind: CycleKind::Tap(Box::new(thread.tap.clone())),
        plane: Fact::Known(thread.plane),
        retract: at(thread.start, normal, walk.unit()),
        depth: at(thread.bottom, normal, walk.unit()),
        return_level: Fact::Known(level),
        return_plane: None,
        reference: None,
        approach: target.caps.holes.approach.unwrap_or(Approach::PlaneFirst),
        feed: None,
    }
}
