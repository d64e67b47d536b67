//! The length of the tool before the next move of Z, after a place of the machine.

use super::kinds::{commands_z, is_zero};
use super::{LengthNext, SideEffects};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::Axis;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::lack::LengthsLack;
use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;

impl SideEffects {
    /// The length of the tool before a statement that moves Z, and after one that goes to a place of the machine.
    pub(super) fn length_before(
        &mut self,
        stmt: &mut Stmt,
        made: &mut Vec<Stmt>,
        diags: &mut Vec<Diagnostic>,
    ) {
        if let Op::GoToReference(to) = &mut stmt.op
            && to.axes[Axis::Z as usize]
            && to.via.get(Axis::Z).is_none()
            && !to.keeps_length
        {
            let next = self.length_after(Behaviour::LengthAfterReturn, stmt.span);
            let asked = matches!(next, Some(LengthNext::Ask(..)));
            let returns = !self.source.does(Behaviour::LengthAfterReturn);
            to.keeps_length = returns && (asked || !self.source.is_open(Behaviour::LengthAfterReturn));
            self.length_next = next;
            return;
        }
        let in_machine = self.machine && matches!(&stmt.op, Op::StraightTraverse(_));
        if in_machine && commands_z(&stmt.op) {
            self.length_next = self.length_after(Behaviour::LengthAfterMachineMove, stmt.span);
            return;
        }
        if matches!(stmt.op, Op::UseToolLengthOffset(_) | Op::UseToolEdge { .. } | Op::UseToolLength(_)) {
            // A block that is skipped calls nothing up.
            self.length_next = self.length_next.take().filter(|_| stmt.skip.is_some());
            (self.length, self.length_known) = (Some(stmt.op.clone()), stmt.skip.is_none());
            return;
        }
        if !commands_z(&stmt.op) || matches!(stmt.op, Op::GoToReference(_)) {
            return;
        }
        let next = self.length_next.take();
        if stmt.skip.is_some() {
            self.length_next.clone_from(&next);
        }
        match next {
            None => {}
            Some(LengthNext::Say(op)) => {
                let mut at = made.len();
                if stmt.joined {
                    at = (0..made.len()).rev().find(|at| !made[*at].joined).unwrap_or(0);
                }
                let mut said = Stmt::new(stmt.span, op);
                // It takes effect in the block that moves Z: there most controls have it.
                if let Some(first) = made.get_mut(at).or(Some(&mut *stmt)) {
                    said.number = first.number.take();
                    said.skip = first.skip;
                    first.joined = true;
                }
                made.insert(at, said);
            }
            Some(LengthNext::Ask(behaviour, at)) => {
                diags.push(Diagnostic::new(Fault::MustBeStated { behaviour }, at));
            }
            Some(LengthNext::Lost(at)) => {
                diags.push(Diagnostic::new(Fault::lacks(LengthsLack::NotStatedAgain), at));
            }
        }
    }

    /// What the length needs after a place of the machine along Z.
    pub(super) fn length_after(&self, behaviour: Behaviour, at: Span) -> Option<LengthNext> {
        let none = matches!(&self.length, Some(Op::UseToolLengthOffset(entry)) if is_zero(entry))
            || self.length.is_none() && self.length_known;
        let (source, target) = (self.source.get(behaviour), self.target.get(behaviour));
        let open = [self.source.is_open(behaviour), self.target.is_open(behaviour)];
        if none || open == [false, false] && source == target || open == [true, true] {
            return None;
        }
        if open[0] {
            return Some(LengthNext::Ask(behaviour, at));
        }
        Some(match (source, &self.length) {
            (0, Some(op)) if self.length_known => LengthNext::Say(op.clone()),
            (0, _) => LengthNext::Lost(at),
            (_, _) => LengthNext::Say(Op::UseToolLengthOffset(Expr::int(0))),
        })
    }
}
