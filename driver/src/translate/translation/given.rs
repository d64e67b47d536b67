//! Facts that hold without a word of the program: those of the source's control that the target's has not, and those
//! that the output leaves to its own control.

use ncc_ir::canon::Modes;
use ncc_ir::program::{Op, Stmt};

use super::Translation;
use crate::verify_run::fixed;

impl Translation<'_> {
    /// Makes statements of facts that always hold for the source's control, and not for the
    /// target's, as soon as the program relies on them. (A target with a safe start states them there.)
    pub(in crate::translate) fn state_given(&mut self, stmts: &mut Vec<Stmt>) {
        if !self.job.to.dialect.safe_start.is_empty() || self.job.to.dialect.can.everything {
            return;
        }
        let always = fixed(self.job.from.dialect).without(&fixed(self.job.to.dialect));
        let relied = self.batch.assumed;
        let at =
            stmts.iter().position(|s| !matches!(s.op, Op::Comment(_) | Op::Blank)).unwrap_or(stmts.len());
        let Some(span) = stmts.get(at).map(|s| s.span) else { return };
        let mut new = Vec::new();
        if let (Some(d), Some(_), None) = (always.distance, relied.distance, self.given.distance) {
            self.given.distance = Some(d);
            new.push(Stmt::new(span, Op::SetDistanceMode(d)));
        }
        if let (Some(u), Some(_), None) = (always.units, relied.units, self.given.units) {
            self.given.units = Some(u);
            new.push(Stmt::new(span, Op::UseLengthUnits(u)));
        }
        if let (Some(p), Some(_), None) = (always.plane, relied.plane, self.given.plane) {
            self.given.plane = Some(p);
            new.push(Stmt::new(span, Op::SelectPlane(p)));
        }
        stmts.splice(at..at, new);
    }

    /// Assumed facts that the output does not state itself, in the target machine's numbers, and what
    /// was taken for granted of the target.
    pub(in crate::translate) fn inherited(&self, assumed: &Modes) -> Modes {
        let there = self.renumbering.modes(assumed);
        let facts = there.without(&self.writer.stated()).without(&self.given);
        let taken = self.legaliser.taken();
        Modes {
            work_offset: taken.work_offset.or(facts.work_offset),
            no_origin_shift: taken.no_origin_shift.or(facts.no_origin_shift),
            ..facts
        }
    }
}
