//! What is noted of a program: what it depends on, what its cycles take from the control, and what was found in it.

use ncc_dialects::{BREAK_LIFT, PECK_CLEARANCE};
use ncc_ir::canon::{AXES, Distance, Modes, PathMode};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::program::cycle::{Clearance, CycleKind};
use ncc_ir::program::{Coord, Op, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::ValueUnexecuted;
use ncc_machines::reading::Told;
use ncc_time::{Act, Place};

use super::{Drive, MOST_HELD, Said, Tip};
use crate::job::parameters::parameter;
use crate::machines::pair::Answer;
use crate::time::modes::{Followed, Length};

impl<'d> Drive<'d> {
    /// Notes a block of a contour, and contours that the tool centre is not followed along.
    pub(super) fn note_contour(&mut self, span: Span, place: Place, said: &Said) {
        self.course.follows_centre |= self.exec.follows_centre();
        let known = self.course.as_programmed.len();
        let new = self.exec.as_programmed().get(known..).unwrap_or_default();
        self.course.as_programmed.extend(new.iter().map(|left| (place.line, left.fault.clone())));
        if self.held.len() >= MOST_HELD {
            self.held.pop_front();
        }
        self.held.push_back((span, place, said.clone()));
    }

    /// Passes on what is active behind a statement, where the sink wants to know.
    pub(super) fn follow(&mut self, stmt: &Stmt, text: &[u8]) {
        let Some(followed) = &mut self.followed else { return };
        followed.step(stmt, &self.exec);
        self.sink.active(self.blocks.number_of(text, stmt.span.start).unwrap_or(0), followed);
    }

    /// Passes on the same for a line that makes the event of the one before.
    pub(super) fn follow_along(&mut self, line: u32) {
        let Some(followed) = &mut self.followed else { return };
        followed.pass();
        self.sink.active(line, followed);
    }

    /// Takes facts for granted that the program relies on.
    pub(super) fn follow_assumed(&mut self, facts: Modes) {
        if let Some(followed) = &mut self.followed {
            followed.assume(facts);
        }
    }

    /// How many blocks have been executed, where that is followed.
    pub(super) fn executed(&self) -> u64 {
        self.followed.as_ref().map_or(0, Followed::executed)
    }

    /// Notes what a move depends on: whether it goes anywhere too.
    pub(super) fn moves(&mut self, act: &Act) {
        if act.event.kind.moves().is_none() {
            return;
        }
        self.moved = true;
        match act.event.state.path {
            None => self.course.corners.unsaid = true,
            Some(PathMode::ExactStop | PathMode::ExactPath | PathMode::Distance) => {}
            Some(_) => self.course.corners.open |= act.event.state.within[..2] == [0; 2],
        }
        for (moved, (from, to)) in self.course.moved.iter_mut().zip(act.from.iter().zip(&act.event.end)) {
            *moved |= from != to;
        }
        let length = match self.exec.length_edge() {
            Some((tool, edge)) => Length::Edge(tool, edge),
            None => Length::Entry(self.exec.length_entry().unwrap_or(0)),
        };
        let depends = (self.exec.offset_in_force(), length);
        if self.depends != Some(depends) {
            self.depends = Some(depends);
            self.course.offsets.insert(depends.0);
            self.course.lengths.insert(depends.1);
        }
    }

    /// What the words of a statement say of where the tip is.
    pub(super) fn tip_of(&mut self, op: &Op) -> Tip {
        let to = match op {
            Op::StraightTraverse(to) | Op::StraightFeed(to) | Op::Position(to) | Op::Hole(to) => Some(&to.to),
            Op::SynchronisedFeed(to) => Some(&to.to),
            Op::ArcFeed(arc) => Some(&arc.to),
            Op::ArcForm(arc) => Some(&arc.to),
            // Of a point by its distance and angle it is not asked where its pole is.
            _ => None,
        };
        let distance = self.exec.distance();
        let stated = |word: &Option<Coord>| {
            word.as_ref().is_some_and(|word| word.distance.or(distance) == Distance::Absolute)
        };
        let stated = to.map_or([false; AXES], |to| to.axes.each_ref().map(stated));
        Tip { of_machine: self.goes_to_machine(op), stated, ..Tip::default() }
    }

    /// Which of X, Y and Z a statement brings to a place of the machine.
    pub(super) fn goes_to_machine(&mut self, op: &Op) -> [bool; 3] {
        match op.unwrapped() {
            Op::UseMachineCoordinates { .. } => {
                self.of_machine = true;
                [false; 3]
            }
            Op::GoToReference(reference) => [0, 1, 2].map(|axis| reference.axes[axis]),
            // Where a control goes for a change.
            Op::ChangeTool => [true; 3],
            Op::StraightTraverse(to) | Op::StraightFeed(to) | Op::Position(to) => {
                let by_machine = std::mem::take(&mut self.of_machine);
                [0, 1, 2].map(|axis| by_machine && to.to.axes[axis].is_some())
            }
            _ => [false; 3],
        }
    }

    /// Looks through statements for what is to be reported, or known before they are executed.
    pub(super) fn look(&mut self, stmts: &[Stmt]) {
        for stmt in stmts {
            self.course.skip_levels |= stmt.skip.map_or(0, |level| 1 << level);
            let says = !matches!(stmt.op, Op::Blank | Op::Comment(_));
            self.course.blocks += u64::from(!stmt.joined && says);
            match &stmt.op {
                Op::ProgramStop | Op::OptionalProgramStop => self.course.stops = true,
                Op::OrientToolAxis(_) => self.course.turns_onto_planes = true,
                Op::UseToolCentrePoint(on) => self.course.tip |= on,
                Op::UseMachineCoordinates { .. } | Op::GoToReference(_) => self.course.in_machine = true,
                Op::StartCutterRadiusCompensation { .. } => self.course.compensates = true,
                Op::StartCycle(cycle) => self.parameters(&cycle.kind, stmt.span),
                _ => {}
            }
        }
    }

    /// Takes the control's own parameters of a cycle from the dictionary.
    pub(super) fn parameters(&mut self, kind: &CycleKind, span: Span) {
        let (option, drill) = match kind {
            CycleKind::DrillPeck { clearance: Clearance::Parameter, .. } => (PECK_CLEARANCE, true),
            CycleKind::DrillBreak { lift: Clearance::Parameter, .. } => (BREAK_LIFT, false),
            CycleKind::Drill
            | CycleKind::DrillDwell { .. }
            | CycleKind::DrillPeck { .. }
            | CycleKind::DrillBreak { .. }
            | CycleKind::Bore { .. }
            | CycleKind::Tap(_)
            | CycleKind::FineBore(_)
            | CycleKind::BoreStop(_) => return,
        };
        let said = parameter(self.plan.job, option).and_then(|value| value.nanos(false));
        match said.or(self.plan.parameters[usize::from(!drill)]) {
            Some(nanos) => {
                if drill {
                    self.exec.set_peck_clearance(nanos);
                } else {
                    self.exec.set_break_lift(nanos);
                }
                let length = (nanos as f64 / 1e9).to_string().into();
                let fact = match drill {
                    true => ControlFact::PeckClearance { length },
                    false => ControlFact::BreakLift { length },
                };
                self.take(Diagnostic::new(Fault::AssumedFact { fact }, span));
            }
            None => {
                let what = match drill {
                    true => ValueUnexecuted::PeckClearanceUnknown,
                    false => ValueUnexecuted::BreakLiftUnknown,
                };
                self.take(Diagnostic::new(Fault::not_executed(what), span));
            }
        }
    }

    pub(super) fn take_diagnostics(&mut self) {
        for diagnostic in std::mem::take(&mut self.batch.diagnostics) {
            self.take(diagnostic);
        }
    }

    /// Takes what was found. An assumption that the machine's profile settles is none.
    pub(super) fn take(&mut self, mut diagnostic: Diagnostic) {
        let job = self.plan.job;
        match job.machines.answer(&diagnostic.fault, Told::Reader, &job.from, &job.to) {
            Answer::Open => {}
            Answer::Settled => return,
            Answer::Denied(denied) => diagnostic.fault = denied,
        }
        self.errors += usize::from(diagnostic.fault.gravity() == Gravity::Error);
        self.course.diagnostics.push(diagnostic);
    }
}
