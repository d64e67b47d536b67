//! Bodies of branches and loops: how they are opened, closed and left.

use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Expr, partial_expr};
use ncc_ir::program::{Control, Op, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unsupported::FlowUnsupported;

use crate::batch::Batch;
use crate::word::lower::Lower;
use crate::word::o_code::o_state::{OpenStructure, StructureKind};
use crate::word::o_code::statements::{label_text, spelled};
use crate::word::text::token::FlowWord;

impl Lower {
    pub(super) fn open_body(&mut self, label: &str, kind: StructureKind, block: Span, out: &mut Batch) {
        if self.o.labels.iter().any(|other| **other == *label) {
            let fault = Fault::NotSupported {
                code: format!("{} {}", label_text(label), kind.word()).into(),
                what: FlowUnsupported::OLabelTwice.into(),
            };
            self.fault(fault, block, out);
        }
        if self.within_too_many(label, &kind, block, out) {
            return;
        }
        self.o.labels.push(label.into());
        if let StructureKind::Do = kind {
            self.o.does.get_or_insert(block);
            self.check_break(block, out);
        }
        if let StructureKind::Repeat(_) = kind {
            self.o.repeats.get_or_insert(block);
            self.check_continue(block, out);
        }
        let (number, given, paths) = (self.now.number, self.o.given.clone(), self.paths_at_head());
        let (label, at, turned) = (label.into(), None, false);
        self.o.open.push(OpenStructure { label, kind, at, block, number, given, paths, turned });
        self.body_begins(paths, block, out);
    }

    /// Takes what was opened last, with its body.
    pub(super) fn close_body(&mut self, out: &mut Batch) -> Option<(OpenStructure, Vec<Stmt>)> {
        self.leave_motion(None, out);
        let open = self.o.open.pop()?;
        let stmts = self.target(out);
        let at = open.at.unwrap_or(stmts.len());
        let mut body = stmts.split_off(at.min(stmts.len()));
        if let Some(first) = body.first_mut() {
            first.joined = false;
        }
        Some((open, body))
    }

    /// The statement of a structure stands where its head does.
    pub(super) fn closed(&mut self, mut open: OpenStructure, control: Control, out: &mut Batch) {
        self.body_ends(&mut open.paths);
        let at = open.at.unwrap_or(usize::MAX);
        self.now.mark = self.now.mark.min(at).min(self.target(out).len());
        self.now.number = open.number;
        self.o.given = open.given;
        self.push(open.block, Op::Control(Box::new(control)), out);
        self.separate(out);
        self.merge_bodies(open.paths, open.block, out);
    }

    /// `break` and `continue`.
    pub(super) fn leave(&mut self, label: &str, word: FlowWord, span: Span, out: &mut Batch) {
        let mut loops =
            self.o.open.iter().rev().filter(|open| !matches!(open.kind, StructureKind::If { .. }));
        let inner = loops.next();
        let what = match inner {
            // What is passed over after a `continue` is looked through for the loop's label, and a `break` with it
            // is taken for one that is made (interp_o_word.cc); a `while` goes on all the same.
            Some(OpenStructure { kind: StructureKind::Do, label: own, turned: true, .. })
                if **own == *label && word == FlowWord::Break =>
            {
                Some(FlowUnsupported::BreakAfterContinue)
            }
            Some(OpenStructure { kind: StructureKind::While(_) | StructureKind::Do, label: own, .. })
                if **own == *label =>
            {
                None
            }
            Some(OpenStructure { kind: StructureKind::While(_) | StructureKind::Do, .. })
                if loops.any(|open| *open.label == *label) =>
            {
                Some(FlowUnsupported::BreakOuter)
            }
            Some(OpenStructure { kind: StructureKind::Repeat(_), .. }) => Some(FlowUnsupported::BreakRepeat),
            _ => Some(FlowUnsupported::BreakNoLoop),
        };
        if let Some(what) = what {
            let code = format!("{} {}", label_text(label), spelled(word)).into();
            return self.fault(Fault::NotSupported { code, what: what.into() }, span, out);
        }
        let in_while = matches!(inner, Some(OpenStructure { kind: StructureKind::While(_), .. }));
        if word == FlowWord::Break && in_while {
            self.o.left.get_or_insert(span);
            self.check_break(span, out);
        }
        let is_loop = |open: &&mut OpenStructure| *open.label == *label;
        if let (FlowWord::Continue, Some(open)) = (word, self.o.open.iter_mut().rev().find(is_loop)) {
            open.turned = true;
            if matches!(open.kind, StructureKind::Do) {
                self.o.turned.get_or_insert(span);
                self.check_continue(span, out);
            }
        }
        self.leave_motion(None, out);
        self.leaves_loop();
        let op = if word == FlowWord::Break { Op::Leave } else { Op::NextTurn };
        self.push(span, op, out);
    }

    /// A break of `while` leaves its mark set, by which the next loop of `do` is left after its first turn
    /// (interp_o_word.cc, `doing_break`).
    fn check_break(&mut self, at: Span, out: &mut Batch) {
        if self.o.left.is_some() && self.o.does.is_some() {
            let what = FlowUnsupported::DoAfterBreak.into();
            self.fault(Fault::NotSupported { code: "O".into(), what }, at, out);
        }
    }

    /// A continue of `do` leaves its mark set as well, by which the next loop of `repeat` is begun again at its end
    /// (run: a `repeat [3]` made six turns).
    fn check_continue(&mut self, at: Span, out: &mut Batch) {
        if self.o.turned.is_some() && self.o.repeats.is_some() {
            let what = FlowUnsupported::RepeatAfterContinue.into();
            self.fault(Fault::NotSupported { code: "O".into(), what }, at, out);
        }
    }

    /// The next branch of an IF, with its condition if it has one; whether there is such an IF.
    pub(super) fn next_branch(
        &mut self,
        label: &str,
        next: Option<Expr>,
        span: Span,
        out: &mut Batch,
    ) -> bool {
        let fits =
            self.o.open.last().is_some_and(|o| {
                *o.label == *label && matches!(o.kind, StructureKind::If { now: Some(_), .. })
            });
        if !fits {
            return false;
        }
        let Some((mut open, body)) = self.close_body(out) else { return true };
        if let StructureKind::If { before, now } = &mut open.kind {
            before.extend(now.take().map(|condition| (condition, body)));
            *now = next;
            if now.as_ref().is_some_and(partial_expr::may_fail) {
                // The control works it out and stops, whatever held before.
                out.report(Fault::AssumedFact { fact: ControlFact::ElseIf }, span);
            }
        }
        open.at = None;
        self.o.given = open.given.clone();
        self.next_body(open, span, out);
        true
    }

    /// The end of what was opened last; whether it is the end of that.
    pub(super) fn end_body(&mut self, label: &str, word: FlowWord, out: &mut Batch) -> bool {
        let fits = self.o.open.last().is_some_and(|open| {
            let kind = matches!(
                (&open.kind, word),
                (StructureKind::If { .. }, FlowWord::EndIf)
                    | (StructureKind::While(_), FlowWord::EndWhile)
                    | (StructureKind::Repeat(_), FlowWord::EndRepeat)
            );
            kind && *open.label == *label
        });
        if !fits {
            return false;
        }
        let Some((mut open, body)) = self.close_body(out) else { return true };
        let control = match open.close() {
            StructureKind::While(condition) => Control::While { condition, body },
            StructureKind::Repeat(times) => Control::Repeat { times, body },
            StructureKind::If { before, now } => match decision_of(before, now, body, open.block) {
                Some(control) => control,
                None => return true,
            },
            StructureKind::Do | StructureKind::Sub(_) => return true,
        };
        self.closed(open, control, out);
        true
    }
}

/// Branches one within the other.
fn decision_of(
    before: Vec<(Expr, Vec<Stmt>)>,
    now: Option<Expr>,
    body: Vec<Stmt>,
    block: Span,
) -> Option<Control> {
    let (mut otherwise, mut all) = (Vec::new(), before);
    match now {
        Some(condition) => all.push((condition, body)),
        None => otherwise = body,
    }
    let mut found = None;
    for (condition, then) in all.into_iter().rev() {
        if let Some(inner) = found.take() {
            otherwise = vec![Stmt::new(block, Op::Control(Box::new(inner)))];
        }
        found = Some(Control::If { condition, then, otherwise: std::mem::take(&mut otherwise) });
    }
    found
}
