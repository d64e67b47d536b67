//! Structures of the control: how they begin, branch and end.

use ncc_ir::computed::computed_code::computed_code;
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::{Expr, Node, Target as Into, Var};
use ncc_ir::program::{Control, Op, Stmt};
use ncc_ir::unsupported::FlowUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::siemens::lower::{Head, Lower};
use crate::siemens::program::open_structures::{Closes, OpenStructure, StructureKind};
use crate::siemens::text::tree::{Expr as Tree, Place};
use crate::siemens::values::formula::{may_be_one, reads, several};

impl Lower {
    /// A structure begins: its head has been read.
    pub(super) fn open(&mut self, what: StructureKind, head: &Head, src: Source, out: &mut Batch) {
        out.whole = true;
        self.now.heading = true;
        if self.skipped() {
            self.not_supported(what.word(), FlowUnsupported::HeadSkipped, head.span, out);
        }
        let most = self.settings.dialect.formula.loops;
        if self.flow.open.len() >= most.into() {
            self.not_supported(what.word(), FlowUnsupported::TooDeep { most: most.into() }, head.span, out);
        }
        let scaled = self.state.scaled;
        if !matches!(what, StructureKind::If { .. }) {
            self.lose(head.span, src, out);
            self.state.scaled = scaled;
        } else {
            self.no_idle_tap(head.span, src, out);
            self.no_stale_offset(head.span, out);
            self.repeated_blocks.use_all();
            self.forget_texts();
        }
        let number = self.take_number();
        let comment = self.take_comment(head, src);
        let at = self.target(out).len();
        let found = self.in_place();
        self.flow.open.push(OpenStructure { what, at, head: head.span, number, comment, found, scaled });
    }

    /// `IF condition`
    pub(in crate::siemens) fn begin_if(
        &mut self,
        condition: &Tree,
        head: &Head,
        src: Source,
        out: &mut Batch,
    ) {
        // A head that is refused has its end all the same.
        let condition = self.condition(condition, src, out).unwrap_or(Expr::int(0));
        self.settle(head.span, out);
        self.leave_motion_before(head.span, out);
        let other = Box::new((self.state.clone(), self.moved));
        self.open(StructureKind::If { condition, then: None, other }, head, src, out);
    }

    /// `LOOP`
    pub(in crate::siemens) fn begin_loop(&mut self, head: &Head, src: Source, out: &mut Batch) {
        self.open(StructureKind::Loop, head, src, out);
    }

    /// `REPEAT`
    pub(in crate::siemens) fn begin_repeat(&mut self, head: &Head, src: Source, out: &mut Batch) {
        self.open(StructureKind::Until, head, src, out);
    }

    /// `WHILE condition`
    pub(in crate::siemens) fn begin_while(
        &mut self,
        condition: &Tree,
        head: &Head,
        src: Source,
        out: &mut Batch,
    ) {
        let condition = self.condition(condition, src, out).unwrap_or(Expr::int(0));
        self.open(StructureKind::While(condition), head, src, out);
    }

    /// `FOR counter = from TO to`
    pub(in crate::siemens) fn begin_for(
        &mut self,
        counter: &Place,
        from: &Tree,
        to: &Tree,
        head: &Head,
        src: Source,
        out: &mut Batch,
    ) {
        let from = self.formula(from, src, out);
        let to = self.formula(to, src, out);
        let variable = match self.read(counter, src, out).map(|typed| typed.expr) {
            Some(Expr::Node(node)) => match *node {
                Node::Var(variable) => Some(variable),
                _ => None,
            },
            _ => None,
        };
        if let Some(variable) = &variable {
            self.is_free_to_change(&variable.name(), counter.span, out);
        }
        let what = match (variable, from, to) {
            (Some(variable), Some(from), Some(to)) => {
                // A counter that is no whole number is rounded to one.
                let from = self.whole_number(from, head.span, out);
                StructureKind::For { variable, from, to: to.expr }
            }
            _ => {
                if !self.now.failed {
                    self.not_supported("FOR", FlowUnsupported::Counter, counter.span, out);
                }
                StructureKind::Loop
            }
        };
        self.open(what, head, src, out);
        if let Some(open) = self.flow.open.last_mut()
            && self.now.failed
        {
            // Its end is that of a FOR in any case.
            let nothing = Var::Local("".into());
            open.what = StructureKind::For { variable: nothing, from: Expr::int(0), to: Expr::int(0) };
        }
    }

    /// `ELSE`
    pub(in crate::siemens) fn otherwise(&mut self, head: &Head, src: Source, out: &mut Batch) {
        self.now.heading = true;
        self.no_stale_offset(head.span, out);
        self.no_idle_tap(head.span, src, out);
        self.leave_motion_before(head.span, out);
        let at = self.flow.open.last().map(|open| open.at);
        let stmts = self.target(out);
        let body = at.map(|at| stmts.split_off(at.min(stmts.len()))).unwrap_or_default();
        let skipped = self.skipped();
        let state = (self.state.clone(), self.moved);
        let found = self.in_place();
        match self.flow.open.last_mut() {
            Some(OpenStructure {
                what: StructureKind::If { then: then @ None, other, .. },
                found: before,
                ..
            }) if !skipped => {
                *then = Some(body);
                let begin = std::mem::replace(&mut **other, state);
                let same = *before == found;
                self.now.mark = self.now.mark.min(at.unwrap_or_default());
                (self.state, self.moved) = begin;
                self.forget_texts();
                if !same {
                    let what = FlowUnsupported::BranchModal;
                    self.not_supported("ELSE", what, head.span, out);
                }
            }
            _ => {
                self.target(out).extend(body);
                self.not_supported("ELSE", FlowUnsupported::ElseAlone, head.span, out);
            }
        }
    }

    /// The end of a structure; `condition` is that of `UNTIL`.
    pub(in crate::siemens) fn close_structure(
        &mut self,
        closes: Closes,
        condition: Option<&Tree>,
        head: &Head,
        src: Source,
        out: &mut Batch,
    ) {
        self.now.heading = true;
        let fits = self.flow.open.last().is_some_and(|open| open.what.closed_by() == closes);
        if !fits {
            let what = match self.flow.open.last() {
                Some(open) => FlowUnsupported::EndWithin { open: open.what.word().into() },
                None => FlowUnsupported::EndOfNothing,
            };
            return self.not_supported(closes.word(), what, head.span, out);
        }
        if self.skipped() {
            self.not_supported(closes.word(), FlowUnsupported::EndSkipped, head.span, out);
        }
        self.no_idle_tap(head.span, src, out);
        let stale = std::mem::take(&mut self.stale);
        self.leave_motion_before(head.span, out);
        let condition = condition.map(|c| self.condition(c, src, out).unwrap_or(Expr::int(1)));
        let Some(OpenStructure { what, at, head: begin, number, comment, found, scaled }) =
            self.flow.open.pop()
        else {
            return;
        };
        if found != self.in_place() {
            let what = FlowUnsupported::LoopModal;
            self.not_supported(closes.word(), what, head.span, out);
        }
        let stmts = self.target(out);
        let mut body = stmts.split_off(at.min(stmts.len()));
        if let Some(first) = body.first_mut() {
            first.joined = false;
        }
        // Tables that a loop only fills count after it, when the active offset is activated again.
        let fills =
            stale && matches!(what, StructureKind::While(_) | StructureKind::For { .. }) && only_sets(&body);
        self.stale = stale && !fills;
        self.no_stale_offset(head.span, out);
        self.now.mark = self.now.mark.min(at);
        self.forget_texts();
        let is_if = matches!(what, StructureKind::If { .. });
        let control = match what {
            StructureKind::If { condition, then, other } => {
                let (state, moved) = *other;
                let one = self.state.modes.motion;
                self.state.join(&state);
                if self.state.modes.motion.value().is_none() {
                    self.motion_goes_on(&[one, state.modes.motion], out);
                }
                if self.moved != moved {
                    self.moved = None;
                }
                self.stand.forget();
                match then {
                    None => Control::If { condition, then: body, otherwise: Vec::new() },
                    Some(mut then) => {
                        if let Some(first) = then.first_mut() {
                            first.joined = false;
                        }
                        Control::If { condition, then, otherwise: body }
                    }
                }
            }
            StructureKind::Loop => Control::Loop { body },
            StructureKind::While(condition) => Control::While { condition, body },
            StructureKind::Until => Control::Until { body, condition: condition.unwrap_or(Expr::int(1)) },
            StructureKind::For { variable, from, to } => {
                if may_change(&body, &to) {
                    let what = FlowUnsupported::EndValue;
                    self.not_supported("FOR", what, begin, out);
                }
                Control::For { variable, from, to, step: Expr::int(1), body }
            }
        };
        let mut stmt = Stmt::new(begin, Op::Control(Box::new(control)));
        stmt.number = number;
        stmt.comment = comment;
        self.target(out).push(stmt);
        self.apart();
        if !is_if {
            let same = self.state.scaled == scaled;
            self.lose(head.span, src, out);
            if same {
                self.state.scaled = scaled;
            } else if let Some(at) = self.flow.relied.filter(|at| at.start > begin.start)
                && self.only_scaled.rely(Some(false), at) != Some(scaled.value().unwrap_or(false))
            {
                self.fault(Fault::EntryFactNeeded { fact: ModeName::Units }, at, out);
            }
        }
        self.stale |= fills;
        if self.flow.open.is_empty() {
            self.flow.relied = None;
        }
    }
}

/// Whether statements may give another value to what an expression reads.
fn may_change(body: &[Stmt], expr: &Expr) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Assign(to, _) => {
            let name = match to {
                Into::Var(var) => var.name(),
                Into::Element(element) => several(&element.of),
            };
            let mut found = false;
            reads(expr, &mut |read| found |= may_be_one(read, &name));
            found
        }
        // R parameters are any program's.
        Op::Call(_) => {
            let mut found = false;
            reads(expr, &mut |read| found |= may_be_one(read, crate::siemens::values::formula::ANY_R));
            found
        }
        Op::Control(control) => {
            let mut found = false;
            if let Control::For { variable, .. } = &**control {
                reads(expr, &mut |read| found |= may_be_one(read, &variable.name()));
            }
            found || control.bodies().any(|body| may_change(body, expr))
        }
        _ => false,
    })
}

/// Whether a body does nothing but set variables and values of tables.
fn only_sets(body: &[Stmt]) -> bool {
    body.iter().all(|stmt| match &stmt.op {
        Op::Assign(..) | Op::SetData(_) | Op::Comment(_) | Op::Blank => true,
        Op::Control(control) => computed_code(control).is_some_and(|code| {
            code.codes.iter().all(|(_, op)| matches!(op, Op::SetData(_) | Op::Assign(..)))
        }),
        _ => false,
    })
}
