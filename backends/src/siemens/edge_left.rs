//! Subprograms after which an edge is active that the program did not ask for: a tool change makes edge 1 active, and
//! the program may state its length only after the call.
//!
//! `T3 M06` in a subprogram, then `M99`, then `Z20.` in its caller: the length of T3 would count at `Z20.`, where the
//! source moves by the length as it was before.
//!
//! Not here: what is written at the move (`tool`).

use std::collections::{BTreeSet, HashMap};

use ncc_ir::program::{Control, Op, Procedure, Stmt, Text};

/// Names of the subprograms that may return with such an edge active.
pub(super) fn leave_edge(procedures: &[Procedure]) -> BTreeSet<Text> {
    let mut leave = BTreeSet::new();
    loop {
        let before = leave.len();
        for procedure in procedures.iter().skip(1) {
            if may_leave(procedure, &leave) {
                leave.insert(procedure.name.clone());
            }
        }
        if leave.len() == before {
            return leave;
        }
    }
}

/// Follows one procedure.
struct Course<'c> {
    leave: &'c BTreeSet<Text>,
    /// Whether an edge waits at a label, by a jump to it.
    labels: HashMap<Text, bool>,
    /// An edge waits at a return.
    returned: bool,
    /// An edge waits where the innermost loop is left, or its next turn begins, from within.
    left: bool,
}

fn may_leave(procedure: &Procedure, leave: &BTreeSet<Text>) -> bool {
    let mut course = Course { leave, labels: HashMap::new(), returned: false, left: false };
    loop {
        let labels = course.labels.clone();
        let ended = course.edge_after(&procedure.body, Some(false));
        if course.returned || ended == Some(true) {
            return true;
        }
        if course.labels == labels {
            return false;
        }
    }
}

impl Course<'_> {
    /// Whether an edge waits after the statements; `None` where no path comes there.
    fn edge_after(&mut self, stmts: &[Stmt], mut waits: Option<bool>) -> Option<bool> {
        for stmt in stmts {
            let sure = stmt.skip.is_none();
            let before = waits;
            let op = &stmt.op;
            if matches!(op, Op::ChangeTool) {
                waits = waits.map(|_| true);
            } else if op.calls_length() {
                waits = waits.map(|_| false);
            } else if let Op::Call(call) = op {
                waits = waits.map(|waits| waits || self.leave.contains(&call.name));
            } else if let Op::Goto(label) = op {
                *self.labels.entry(label.clone()).or_default() |= waits == Some(true);
                waits = None;
            } else if let Op::Label(label) = op {
                waits = either(waits, self.labels.get(label).copied());
            } else if let Op::Control(control) = op {
                waits = self.control(control, waits);
            } else if matches!(op, Op::Leave | Op::NextTurn) {
                self.left |= waits == Some(true);
                waits = None;
            } else if matches!(op, Op::Return) {
                self.returned |= waits == Some(true);
                waits = None;
            } else if matches!(op, Op::ProgramEnd | Op::BeginAgain | Op::Alarm(_)) {
                waits = None;
            }
            if !sure {
                waits = either(before, waits);
            }
        }
        waits
    }

    fn control(&mut self, control: &Control, waits: Option<bool>) -> Option<bool> {
        if let Control::If { then, otherwise, .. } = control {
            let first = self.edge_after(then, waits);
            return either(first, self.edge_after(otherwise, waits));
        }
        let outer = std::mem::replace(&mut self.left, false);
        let mut all = waits;
        for body in control.bodies() {
            let once = self.edge_after(body, waits);
            let once = either(once, self.left.then_some(true));
            let twice = self.edge_after(body, either(waits, once));
            all = either(all, either(once, twice));
        }
        all = either(all, self.left.then_some(true));
        self.left = outer;
        all
    }
}

/// Where two paths join.
fn either(a: Option<bool>, b: Option<bool>) -> Option<bool> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a || b),
        (one, other) => one.or(other),
    }
}
