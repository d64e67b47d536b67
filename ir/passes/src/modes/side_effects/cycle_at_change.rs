//! A canned cycle that is active at a tool change, for a target that takes Z to machine zero there; and at the end of the
//! program, where frames are cancelled in words.
//!
//! ```text
//! G81 X10. Z-5. R3.        G81 X10. Z-5. R3.
//! T2 M06              →    G80
//! G80                      T2 M06          the control refuses the change while the cycle is active
//! G00 X0.                  G80
//!                          G00 X0.
//! ```
//!
//! Holes of the same cycle after the change are refused: their initial level is one that the target does not keep.
//! Not here: a cycle that is active in the caller of a subprogram.

use crate::modes::side_effects::SideEffects;
use crate::modes::side_effects::insert::{insert, insertion};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::HolesLack;
use ncc_ir::program::kinds::{flow, moves};
use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;

/// What is known of the cycle.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cycle {
    /// It may be active in the source.
    active: bool,
    /// The tool change before which this pass has cancelled it, while it is active in the source.
    cancelled: Option<Span>,
}

impl Cycle {
    /// Whether further statements must be looked at.
    pub(super) fn is_busy(self) -> bool {
        self.cancelled.is_some()
    }

    /// What a statement leaves active.
    pub(super) fn note(&mut self, stmt: &Stmt) {
        let sure = stmt.skip.is_none();
        match &stmt.op {
            Op::StartCycle(_) => {
                self.active = true;
                self.cancelled.take_if(|_| sure);
            }
            Op::EndCycle | moves!() if sure => *self = Cycle::default(),
            _ => {}
        }
    }
}

impl SideEffects {
    /// Cancels the cycle before a tool change.
    pub(super) fn cancel_cycle(&mut self, stmt: &mut Stmt, made: &mut Vec<Stmt>) {
        let behaviour = Behaviour::ZAtChange;
        if !self.cycle.active || self.source.does(behaviour) || !self.target.does(behaviour) {
            return;
        }
        self.cycle.cancelled = Some(stmt.span);
        let end = Stmt { skip: stmt.skip, ..Stmt::new(stmt.span, Op::EndCycle) };
        let at = insertion(made, stmt);
        insert(made, stmt, at, vec![end]);
    }

    /// Writes frames before the end of the program. No control has to take them while a cycle is active.
    pub(super) fn insert_after_cycle(&self, stmt: &mut Stmt, made: &mut Vec<Stmt>, mut new: Vec<Stmt>) {
        if self.cycle.active && !new.is_empty() {
            new.insert(0, Stmt { skip: stmt.skip, ..Stmt::new(stmt.span, Op::EndCycle) });
        }
        let at = insertion(made, stmt);
        insert(made, stmt, at, new);
    }

    /// Refuses a statement that needs the cycle which was cancelled before the tool change.
    pub(super) fn needs_cycle(&mut self, op: &Op, diags: &mut Vec<Diagnostic>) {
        let needs = matches!(op, Op::Hole(_) | Op::Pattern(_) | Op::Position(_) | Op::Control(_) | flow!());
        if let Some(at) = self.cycle.cancelled.take_if(|_| needs) {
            diags.push(Diagnostic::new(Fault::lacks(HolesLack::ActiveOverToolChange), at));
        }
    }
}
