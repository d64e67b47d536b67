//! `expand-calls`: subprograms are written out where they are called.
//!
//! What a subprogram takes from its caller (motion or cycle in force, distance mode, plane, units)
//! becomes what this caller has in force.

use std::collections::{BTreeSet, HashMap, HashSet};

use crate::support::walk::Walk;
use crate::support::write::Rebuild;
use crate::{MOST_STATEMENTS, Target};
use ncc_ir::canon::{Fact, Motion};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Unit;
use ncc_ir::program::cycle::{Clearance, CycleKind, First, Pattern};
use ncc_ir::program::kinds::{conduct, flow, miscellaneous, modes, tooling, variables};
use ncc_ir::program::{
    Call, Centre, Coord, Data, FrameStep, Op, Pitch, Point, PoleWords, Procedure, Program, Shape, Slot, Stmt,
    Text, ToolLength,
};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// Writes the subprograms out; only the main procedure is left.
pub fn run(program: &mut Program, _: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    over(program, &mut Walk::new(entry.clone()), diags);
}

/// The same, with a walk that stands before the main procedure.
pub(crate) fn over(program: &mut Program, walk: &mut Walk, diags: &mut Vec<Diagnostic>) {
    let names = program.procedures.iter().skip(1).map(|sub| sub.name.clone()).collect();
    some(program, walk, &names, diags);
}

/// Writes out those subprograms that are named, wherever they are called; the others stay.
pub(crate) fn some(
    program: &mut Program,
    walk: &mut Walk,
    names: &BTreeSet<Text>,
    diags: &mut Vec<Diagnostic>,
) {
    let procedures = std::mem::take(&mut program.procedures);
    let subs = procedures.iter().skip(1).map(|p| (&*p.name, p)).collect();
    let kept = procedures.iter().skip(1).map(|p| &*p.name).filter(|name| !names.contains(*name)).collect();
    for (at, procedure) in procedures.iter().enumerate() {
        if at > 0 && names.contains(&procedure.name) {
            continue;
        }
        let mut inliner = Inliner {
            subs: &subs,
            kept: &kept,
            stack: Vec::new(),
            calls: 0,
            walk: if at == 0 { std::mem::take(walk) } else { Walk::new(Tracker::unknown()) },
            diags,
            full: false,
        };
        let mut made = Rebuild::new(procedure.body.len());
        inliner.body(&procedure.body, None, &mut made);
        if at == 0 {
            *walk = inliner.walk;
        }
        program.procedures.push(Procedure { body: made.out, ..procedure.clone() });
    }
}

struct Inliner<'a> {
    subs: &'a HashMap<&'a str, &'a Procedure>,
    /// Those that are not written out.
    kept: &'a HashSet<&'a str>,
    stack: Vec<&'a str>,
    /// Calls written out so far.
    calls: usize,
    walk: Walk,
    diags: &'a mut Vec<Diagnostic>,
    /// There is no room for more.
    full: bool,
}

impl<'a> Inliner<'a> {
    /// Writes a body out; `skip` is the level under which it was called.
    fn body(&mut self, body: &'a [Stmt], skip: Option<u8>, made: &mut Rebuild) {
        let called = !self.stack.is_empty();
        for stmt in body {
            let mut stmt = stmt.clone();
            if called {
                stmt.number = None;
                if let Err(fault) = also_skipped(&mut stmt, skip) {
                    self.diags.push(Diagnostic::new(fault, stmt.span));
                }
            }
            self.walk.enter(stmt.skip);
            match &mut stmt.op {
                Op::Call(call) if !self.kept.contains(&*call.name) => {
                    let call = std::mem::replace(
                        &mut **call,
                        Call { name: "".into(), times: 0, arguments: Vec::new(), shared: false },
                    );
                    let (span, skip) = (stmt.span, stmt.skip);
                    made.leave_out(stmt);
                    self.call(&call, span, skip, made);
                }
                Op::Return if called => {
                    if stmt.skip != skip {
                        let what = "a return that can be skipped, written out".into();
                        self.diags.push(Diagnostic::new(Fault::CannotSay { what }, stmt.span));
                    }
                    made.leave_out(stmt);
                    return;
                }
                Op::Control(control) => {
                    for body in control.bodies_mut() {
                        self.nested(body);
                    }
                    self.walk.step(&stmt);
                    made.push(stmt);
                }
                Op::Goto(_) | Op::Label(_) if called => {
                    let what = "a subprogram with jumps, written out".into();
                    self.diags.push(Diagnostic::new(Fault::CannotSay { what }, stmt.span));
                    made.leave_out(stmt);
                }
                op => {
                    settle(op, &self.walk.at);
                    self.walk.step(&stmt);
                    made.push(stmt);
                }
            }
            if self.full {
                return;
            }
        }
    }

    /// A body that is not run straight through: what holds at its start is not known.
    fn nested(&mut self, body: &mut Vec<Stmt>) {
        let before = std::mem::take(&mut self.walk);
        let input = std::mem::take(body);
        let mut made = Rebuild::new(input.len());
        for stmt in input {
            if let Op::Call(call) = &stmt.op
                && !self.kept.contains(&*call.name)
            {
                let (call, span, skip) = ((**call).clone(), stmt.span, stmt.skip);
                self.walk.enter(skip);
                made.leave_out(stmt);
                self.call(&call, span, skip, &mut made);
            } else {
                self.walk.step(&stmt);
                made.push(stmt);
            }
        }
        *body = made.out;
        self.walk = before;
    }

    fn call(&mut self, call: &Call, span: Span, skip: Option<u8>, made: &mut Rebuild) {
        let Some((name, sub)) = self.subs.get_key_value(&*call.name).map(|(n, p)| (*n, *p)) else {
            return self.refuse(Fault::CallUnknown { name: call.name.clone() }, span);
        };
        if self.stack.contains(&name) {
            return self.refuse(Fault::CallRecursive { name: call.name.clone() }, span);
        }
        if !sub.parameters.is_empty() || !call.arguments.is_empty() {
            return self.refuse(Fault::MacroLanguage { what: "a call with arguments".into() }, span);
        }
        let fault = Fault::CallExpanded { name: call.name.clone(), times: call.times };
        self.diags.push(Diagnostic::new(fault, span));
        self.stack.push(name);
        for _ in 0..call.times {
            self.calls += 1;
            self.body(&sub.body, skip, made);
            if made.out.len().max(self.calls) > MOST_STATEMENTS && !self.full {
                self.full = true;
                let what = "calls that are too long to be written out".into();
                self.refuse(Fault::CannotSay { what }, span);
            }
            if self.full {
                break;
            }
        }
        self.stack.pop();
    }

    fn refuse(&mut self, fault: Fault, span: Span) {
        self.diags.push(Diagnostic::new(fault, span));
    }
}

/// Puts a statement under a further skip level.
pub(crate) fn also_skipped(stmt: &mut Stmt, skip: Option<u8>) -> Result<(), Fault> {
    match (stmt.skip, skip) {
        (Some(a), Some(b)) if a != b => {
            Err(Fault::CannotSay { what: "a block under two block-skip levels".into() })
        }
        _ => {
            stmt.skip = stmt.skip.or(skip);
            Ok(())
        }
    }
}

/// Replaces what a statement takes from its caller by what is in force.
pub(crate) fn settle(op: &mut Op, here: &Tracker) {
    if let Op::Position(m) = op {
        let m = std::mem::take(m);
        *op = match here.modes.motion {
            Some(Motion::Traverse) => Op::StraightTraverse(m),
            Some(Motion::Feed) => Op::StraightFeed(m),
            Some(Motion::Cycle) => Op::Hole(m),
            Some(Motion::Arc(_)) | None => Op::Position(m),
        };
    }
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) | Op::Hole(m) => {
            settle_point(&mut m.to, here);
        }
        Op::SynchronisedFeed(m) => {
            settle_point(&mut m.to, here);
            if let Pitch::Stated(pitch) = &mut m.pitch {
                settle_expr(pitch, here);
            }
        }
        Op::ArcFeed(arc) => {
            settle_fact(&mut arc.plane, here.modes.plane);
            settle_point(&mut arc.to, here);
            match &mut arc.centre {
                Centre::Point { words, .. } => words.iter_mut().flatten().for_each(|w| settle_expr(w, here)),
                Centre::Radius(radius) => settle_expr(radius, here),
            }
        }
        Op::Polar(polar) => {
            settle_fact(&mut polar.plane, here.modes.plane);
            for word in [&mut polar.radius, &mut polar.angle].into_iter().flatten() {
                settle_coord(word, here);
            }
            settle(&mut polar.op, here);
        }
        Op::SetPole(set) => {
            settle_fact(&mut set.plane, here.modes.plane);
            match &mut set.at {
                PoleWords::Along(words) => words.iter_mut().flatten().for_each(|w| settle_expr(w, here)),
                PoleWords::Polar { radius, .. } => settle_expr(radius, here),
            }
        }
        Op::StartCycle(cycle) => {
            settle_fact(&mut cycle.plane, here.modes.plane);
            settle_fact(&mut cycle.return_level, here.modes.return_level);
            settle_coord(&mut cycle.retract, here);
            settle_coord(&mut cycle.depth, here);
            cycle.reference.iter_mut().chain(&mut cycle.return_plane).for_each(|c| settle_coord(c, here));
            cycle.feed.iter_mut().for_each(|f| settle_expr(f, here));
            settle_kind(&mut cycle.kind, here);
        }
        Op::Pattern(pattern) => settle_pattern(pattern, here),
        Op::ArcForm(arc) => {
            settle_fact(&mut arc.plane, here.modes.plane);
            settle_point(&mut arc.to, here);
            match &mut arc.shape {
                Shape::AngleAbout { centre, .. } | Shape::Mixed { centre, .. } => {
                    centre.iter_mut().flatten().for_each(|c| settle_coord(c, here));
                }
                Shape::Through(via) => settle_point(via, here),
                Shape::Angle { .. } | Shape::Tangent => {}
            }
        }
        Op::SetFrame(frame) => match &mut frame.step {
            FrameStep::Translate(words) => words.iter_mut().flatten().for_each(|w| settle_expr(w, here)),
            FrameStep::Rotate { plane, .. } => settle_fact(plane, here.modes.plane),
            FrameStep::Scale(_) | FrameStep::Mirror(_) => {}
        },
        Op::SetSlot(slot) => match &mut **slot {
            Slot::Shift { axes, .. } => axes.iter_mut().flatten().for_each(|w| settle_expr(w, here)),
            Slot::Rotation { plane, centre, angle } => {
                settle_fact(plane, here.modes.plane);
                centre.iter_mut().flatten().for_each(|w| settle_expr(w, here));
                settle_coord(angle, here);
            }
            Slot::Scale { centre: words, .. } | Slot::Mirror(words) => {
                words.iter_mut().flatten().for_each(|w| settle_expr(w, here));
            }
            Slot::Tilt(tilt) => tilt.origin.iter_mut().flatten().for_each(|w| settle_expr(w, here)),
            Slot::NoMirror(_) => {}
        },
        Op::SetPosition(axes) => axes.iter_mut().flatten().for_each(|w| settle_expr(w, here)),
        Op::SetFeedRate(feed) => settle_expr(feed, here),
        Op::GoToReference(reference) => settle_point(&mut reference.via, here),
        Op::SetData(data) => match &mut **data {
            Data::Offset { words, .. } | Data::Measured { words, .. } => {
                words.iter_mut().flatten().for_each(|w| settle_expr(w, here))
            }
            Data::Tool { value, .. } => settle_expr(value, here),
            Data::Position(_) | Data::ToolInSpindle(_) => {}
        },
        Op::SetOriginOffsets(_)
        | Op::ClearFrame(_)
        | Op::UseToolCentrePoint(_)
        | Op::UseOriginShift(_)
        | Op::OrientToolAxis(_)
        | Op::Probe(_)
        | Op::Detour(_)
        | Op::UseMachineCoordinates { .. }
        | Op::EndCycle
        | Op::ProgramEnd
        | Op::BeginAgain
        | variables!()
        | miscellaneous!()
        | modes!()
        | flow!() => {}
        tooling!() => {
            if let Op::UseToolLength(length) = op {
                match &mut **length {
                    ToolLength::Value(value) | ToolLength::Added(value) => settle_expr(value, here),
                    ToolLength::Offsets { words, .. } => {
                        words.iter_mut().flatten().for_each(|word| settle_expr(word, here));
                    }
                    ToolLength::AddedEntry(_) => {}
                }
            }
        }
        conduct!() => {
            if let Op::Corner { size, .. } = op {
                settle_expr(size, here);
            }
        }
    }
}

/// The lengths of a kind of cycle.
fn settle_kind(kind: &mut CycleKind, here: &Tracker) {
    match kind {
        CycleKind::DrillPeck { peck, first, less, clearance, .. }
        | CycleKind::DrillBreak { peck, first, less, lift: clearance, .. } => {
            settle_expr(peck, here);
            first.iter_mut().chain(less).for_each(|f| settle_expr(f, here));
            if let Clearance::Stated(clearance) = clearance {
                settle_expr(clearance, here);
            }
        }
        CycleKind::Bore { feed_out, .. } => {
            feed_out.iter_mut().for_each(|f| settle_expr(f, here));
        }
        kind @ (CycleKind::Tap(_) | CycleKind::FineBore(_)) => {
            let settled: Result<(), std::convert::Infallible> = kind.each_length(|e| {
                settle_expr(e, here);
                Ok(())
            });
            settled.unwrap_or_else(|never| match never {});
        }
        CycleKind::Drill | CycleKind::DrillDwell { .. } | CycleKind::BoreStop(_) => {}
    }
}

/// The words of a pattern of holes.
fn settle_pattern(pattern: &mut Pattern, here: &Tracker) {
    match pattern {
        Pattern::Circle { centre, first, .. } => {
            centre.iter_mut().flatten().for_each(|c| settle_coord(c, here));
            match first {
                First::At(first) => first.iter_mut().for_each(|c| settle_coord(c, here)),
                First::Polar { radius, .. } => settle_expr(radius, here),
            }
        }
        Pattern::Line { start, offset, pitch, .. } => {
            start.iter_mut().flatten().for_each(|c| settle_coord(c, here));
            settle_expr(offset, here);
            settle_expr(pitch, here);
        }
        Pattern::List(points) => points.iter_mut().for_each(|p| settle_point(p, here)),
        Pattern::Grid { start, columns, rows, .. } => {
            start.iter_mut().flatten().for_each(|c| settle_coord(c, here));
            settle_expr(&mut columns.pitch, here);
            settle_expr(&mut rows.pitch, here);
        }
    }
}

fn settle_fact<T: Copy>(fact: &mut Fact<T>, in_force: Option<T>) {
    if let (Fact::Entry, Some(value)) = (&fact, in_force) {
        *fact = Fact::Known(value);
    }
}

pub(crate) fn settle_point(to: &mut Point, here: &Tracker) {
    to.axes.iter_mut().flatten().for_each(|c| settle_coord(c, here));
}

fn settle_coord(coord: &mut Coord, here: &Tracker) {
    settle_fact(&mut coord.distance, here.modes.distance);
    settle_expr(&mut coord.value, here);
}

fn settle_expr(value: &mut Expr, here: &Tracker) {
    match value {
        Expr::Num(n) if n.unit == Unit::Entry => match here.modes.units {
            Some(ncc_ir::canon::Units::Mm) => n.unit = Unit::Mm,
            Some(ncc_ir::canon::Units::Inch) => n.unit = Unit::Inch,
            None => {}
        },
        Expr::Num(_) => {}
        Expr::Node(_) => value.parts_mut().for_each(|part| settle_expr(part, here)),
    }
}
