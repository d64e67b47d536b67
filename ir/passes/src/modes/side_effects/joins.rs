//! The length of the tool where paths join: after a branch, and at the start of a loop that runs again.
//!
//! ```text
//! G53 G0 Z0                      G53 G0 Z0
//! IF … GOTO 10                   IF … GOTO 10
//! Z10            →               G43 H1 Z10     for a control that cancels the length at the first block
//! GOTO 20                        GOTO 20
//! N10 Z20                        N10 G43 H1 Z20
//! N20                            N20
//! ```
//!
//! Not here: what a place of the machine does to the length (`side_effects`).

use std::collections::{BTreeMap, BTreeSet};

use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::Axis;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Control, Op, Procedure, Reference, Stmt, Text};
use ncc_ir::source::Span;

use crate::modes::side_effects::kinds::commands_z;
use crate::modes::side_effects::{LengthNext, SideEffects};

/// The length of the tool where paths join.
#[derive(Clone, Debug)]
pub(super) struct Length {
    /// What activates it; `None` is none.
    pub(super) op: Option<Op>,
    /// Whether it is known.
    pub(super) known: bool,
    /// What it needs before the next move of Z.
    pub(super) next: Option<LengthNext>,
}

/// How a body leaves the length of the tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tail {
    /// As it was.
    Unchanged,
    /// At a place of the machine, before any further move of Z.
    AtPlace(Behaviour, Span),
    /// Activated again, or Z has moved with it.
    Settled,
}

/// Procedures that end at a place of the machine along Z: by what they went there, and whether the length is that of
/// the caller.
pub(super) type LeftAtPlace = BTreeMap<Text, (Behaviour, bool)>;

/// Procedures that leave the length of their caller active.
pub(super) type KeepsLength = BTreeSet<Text>;

/// Finds the procedures that leave the length of their caller active, and call nothing that might change it.
pub(super) fn keeps_length(procedures: &[Procedure]) -> KeepsLength {
    let keeps = |procedure: &&Procedure| !procedure.body.iter().any(|stmt| sets_length(&stmt.op));
    procedures.iter().filter(keeps).map(|procedure| procedure.name.clone()).collect()
}

/// Finds the procedures that end at a place of the machine along Z.
pub(super) fn left_at_place(procedures: &[Procedure]) -> LeftAtPlace {
    let ends = |procedure: &Procedure| match tail_of(&procedure.body) {
        Tail::AtPlace(behaviour, _) => {
            Some((behaviour, !procedure.body.iter().any(|stmt| sets_length(&stmt.op))))
        }
        Tail::Unchanged | Tail::Settled => None,
    };
    procedures.iter().filter_map(|procedure| Some((procedure.name.clone(), ends(procedure)?))).collect()
}

impl SideEffects {
    /// The length after the call of a procedure that ends at a place of the machine; `length` is that before it.
    pub(super) fn after_call(&mut self, stmt: &Stmt, length: (Option<Op>, bool)) {
        let Op::Call(call) = &stmt.op else { return };
        if self.keeps_length.contains(&call.name) {
            (self.length, self.length_known) = length.clone();
        }
        let Some((behaviour, keeps)) = self.left_at_place.get(&call.name).copied() else { return };
        if keeps && stmt.skip.is_none() {
            (self.length, self.length_known) = length;
        }
        self.length_next = self.length_after(behaviour, stmt.span);
    }

    /// The length of the tool at the start of each body of a control structure. A loop may begin again after a place of
    /// the machine.
    pub(super) fn length_into(&self, control: &Control, span: Span) -> Length {
        let keeps = !control.bodies().any(|body| body.iter().any(|stmt| calls_up_length(&stmt.op)));
        let mut length = Length {
            op: self.length.clone().filter(|_| keeps),
            known: self.length_known && keeps,
            next: self.length_next.clone(),
        };
        if let (false, Tail::AtPlace(behaviour, at)) = (matches!(control, Control::If { .. }), tail(control))
        {
            let mut inside = self.clone();
            inside.take_length(&length);
            length.next = either(inside.length_after(behaviour, at), length.next.take(), &length, span);
        }
        length
    }

    pub(super) fn take_length(&mut self, length: &Length) {
        (self.length, self.length_known) = (length.op.clone(), length.known);
        self.length_next.clone_from(&length.next);
    }
}

/// What the length needs where two paths join. To call the same length up again does no harm on either.
pub(super) fn either(
    one: Option<LengthNext>,
    other: Option<LengthNext>,
    length: &Length,
    span: Span,
) -> Option<LengthNext> {
    use LengthNext::{Ask, Lost, Say};
    match (one, other) {
        (None, None) => None,
        (Some(ask @ Ask(..)), _) | (_, Some(ask @ Ask(..))) => Some(ask),
        (Some(lost @ Lost(_)), _) | (_, Some(lost @ Lost(_))) => Some(lost),
        (Some(Say(one)), Some(Say(other))) if one == other => Some(Say(one)),
        (Some(Say(op)), None) | (None, Some(Say(op))) if length.known && length.op.as_ref() == Some(&op) => {
            Some(Say(op))
        }
        (Some(Say(_)), _) | (_, Some(Say(_))) => Some(Lost(span)),
    }
}

/// Labels, by their places, after which a length is activated before Z moves by one: what the length needs there, nothing
/// asks for.
pub(super) fn unread_at_labels(body: &[Stmt]) -> BTreeSet<u32> {
    let (mut found, mut reads) = (BTreeSet::new(), true);
    for stmt in body.iter().rev() {
        let home = |to: &Reference| to.axes[Axis::Z as usize] && to.via.get(Axis::Z).is_none();
        match &stmt.op {
            Op::Label(_) if !reads => drop(found.insert(stmt.span.start)),
            Op::Label(_) => {}
            Op::ProgramEnd if stmt.skip.is_none() => reads = false,
            Op::UseToolLengthOffset(_) | Op::UseToolEdge { .. } | Op::UseToolLength(_)
                if stmt.skip.is_none() =>
            {
                reads = false;
            }
            Op::GoToReference(to) if stmt.skip.is_none() && home(to) => reads = false,
            op => reads |= commands_z(op) || matches!(op, flow!()),
        }
    }
    found
}

/// Whether a statement calls a length up, or may.
fn calls_up_length(op: &Op) -> bool {
    match op {
        Op::Control(control) => {
            control.bodies().any(|body| body.iter().any(|stmt| calls_up_length(&stmt.op)))
        }
        Op::UseToolLengthOffset(_) | Op::UseToolEdge { .. } | Op::UseToolLength(_) | Op::ChangeTool => true,
        op => matches!(op, flow!()),
    }
}

/// Whether a statement of a procedure calls a length up, or may by what it calls.
fn sets_length(op: &Op) -> bool {
    match op {
        Op::Control(control) => control.bodies().any(|body| body.iter().any(|stmt| sets_length(&stmt.op))),
        Op::Call(_) => true,
        op => !matches!(op, flow!()) && calls_up_length(op),
    }
}

/// How a control structure leaves the length of the tool.
fn tail(control: &Control) -> Tail {
    let mut ends = control.bodies().map(|body| tail_of(body));
    let first = ends.next().unwrap_or(Tail::Unchanged);
    match (first, ends.next(), matches!(control, Control::If { .. })) {
        (Tail::AtPlace(behaviour, at), _, _) | (_, Some(Tail::AtPlace(behaviour, at)), _) => {
            Tail::AtPlace(behaviour, at)
        }
        (Tail::Settled, Some(Tail::Settled), true) => Tail::Settled,
        _ => Tail::Unchanged,
    }
}

fn tail_of(body: &[Stmt]) -> Tail {
    let (mut left, mut machine) = (Tail::Unchanged, false);
    for stmt in body {
        let in_machine = std::mem::replace(&mut machine, matches!(stmt.op, Op::UseMachineCoordinates { .. }));
        left = match &stmt.op {
            Op::Control(control) => match tail(control) {
                Tail::Unchanged => left,
                other => other,
            },
            Op::GoToReference(to) if to.axes[Axis::Z as usize] && to.via.get(Axis::Z).is_none() => {
                Tail::AtPlace(Behaviour::LengthAfterReturn, stmt.span)
            }
            Op::StraightTraverse(_) if in_machine && commands_z(&stmt.op) => {
                Tail::AtPlace(Behaviour::LengthAfterMachineMove, stmt.span)
            }
            // The end of a procedure.
            Op::Return => left,
            op if stmt.skip.is_none() && (commands_z(op) || calls_up_length(op)) => Tail::Settled,
            _ => left,
        };
    }
    left
}

/// The operation that starts the spindle of a program, if there is but one.
pub(super) fn only_sense(procedures: &[Procedure]) -> Option<Op> {
    fn find(body: &[Stmt], found: &mut Vec<Op>) {
        for stmt in body {
            let starts = matches!(stmt.op, Op::StartSpindleClockwise | Op::StartSpindleCounterclockwise);
            if starts && !found.contains(&stmt.op) {
                found.push(stmt.op.clone());
            }
            if let Op::Control(control) = &stmt.op {
                control.bodies().for_each(|body| find(body, found));
            }
        }
    }
    let mut found = Vec::new();
    procedures.iter().for_each(|procedure| find(&procedure.body, &mut found));
    found.pop().filter(|_| found.is_empty())
}
